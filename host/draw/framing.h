/* What a scene's pictures show: chosen once from its walls and its bed. */
#ifndef OZ_DRAW_FRAMING_H
#define OZ_DRAW_FRAMING_H

#include "draw/renderer.h"

/* oz_renderer_look's work. */
OzLook oz_framing_look(const OzScene *scene, const OzSnapshot *snapshot);

/* The smallest of 1, 2, 5 times a power of ten that is at least x (x > 0). */
double oz_framing_round_up(double x);

#endif
