/* What is written on a picture: title, time and tap, captions, scale bar, colour bar. Set on the
 * finished image. */
#pragma once

#include "draw/camera.h"
#include "draw/font.h"

/* Does nothing when camera->font is 0. */
void oz_overlay_draw(const OzFont *font, OzImage *image, const OzSnapshot *snapshot,
                     const OzLook *look, const OzCamera *camera);
