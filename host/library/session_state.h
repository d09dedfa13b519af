/* A session in a file, and a session of a file. */
#pragma once

#include "library/session.h"

/* All that later steps and columns depend on, of a session that has started. */
OzStatus oz_session_state_write(OzSession *session, const char *path);

/* Reads what was written there: *text receives the scene, which the caller frees, *state what the
 * session shall begin with (its `loaded`). */
OzStatus oz_session_state_read(OzState **state, char **text, const char *path);

/* Builds it and takes up what was read. */
OzStatus oz_session_state_take(OzSession *session);
