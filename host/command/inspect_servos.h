/* `orzo check` of walls that hold a pressure. */
#pragma once

#include "model/grains.h"
#include "scene/scene.h"

#include <stdio.h>

/* Two lines a piston: what drives it, mass, dashpot, and what these come to. */
void oz_inspect_servos_print(FILE *file, const OzScene *scene, const OzGrains *grains);
