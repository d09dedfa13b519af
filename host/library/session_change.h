/* Changing the scene of a session that has started. */
#pragma once

#include "library/session.h"

/* One setting ("key=value", or "-key", which takes the key out) over the running scene. On failure
 * nothing has changed, unless the device failed while it took the change. */
OzStatus oz_session_change_set(OzSession *session, char *setting);
