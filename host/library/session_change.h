/* Changing the scene of a session that has started. */
#pragma once

#include "library/session.h"

/* One setting ("key=value", or "-key", which takes the key out) over the running scene. On failure
 * nothing has changed, unless the device failed while it took the change. */
OzStatus oz_session_change_set(OzSession *session, char *setting);

/* From now on these forces (N) and torques (N m; NULL: none) act on `count` grains, 3 numbers each;
 * grains NULL: on the first ones. Of other grains they stay as they are. The first call builds
 * kernels with room for them. */
OzStatus oz_session_change_push(OzSession *session, const int64_t *grains, int64_t count,
                                const double *force, const double *torque);

/* From now on the wall goes at this speed, m/s along its motion's direction. */
OzStatus oz_session_change_drive(OzSession *session, int wall, double speed);
