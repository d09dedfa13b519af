/* The lines of `orzo check` about walls that move, of either model. */
#pragma once

#include "scene/scene.h"

#include <stdio.h>

/* Stroke, frequency and acceleration of shaken walls; rate of turning ones, of drums with their Froude
 * number. */
void oz_inspect_motion_print(FILE *file, const OzScene *scene);
