/* Where a session comes from: a scene, settings, a state that was written; and its start. */
#pragma once

#include "library/session.h"

/* Reads the scene; text NULL: from the file at path. Frees with oz_session_free, also after a
 * failure. */
OzStatus oz_session_start_open(OzSession *session, const char *path, const char *text);

/* Before its start: the scene again with one setting more ("key=value", "-key"); owned from now
 * on, also on failure, which leaves the scene as it was. */
OzStatus oz_session_start_set(OzSession *session, char *setting);

/* What orzo_start says; does nothing once it is done. What failed may be tried again. */
OzStatus oz_session_start_run(OzSession *session);
