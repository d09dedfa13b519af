/* Pictures of a session. */
#pragma once

#include "library/session.h"

/* width and height of its pictures, pixels. */
void oz_session_draw_size(const OzSession *session, int *width, int *height);

/* Draws its state into width x height x 4 bytes; framed as the first picture since it was changed.
 * From one thread alone. Fails with OZ_ERR_GRAPHICS. */
OzStatus oz_session_draw_picture(OzSession *session, uint8_t *pixels);
