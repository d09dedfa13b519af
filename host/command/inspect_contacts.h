/* The lines of `orzo check` about contacts of rods. */
#pragma once

#include "model/grains.h"

#include <stdio.h>

/* Of two grains and of a grain at each wall: stiffness, damping, steps, restitution, stability.
 * Walls in a row of which the same is to be said are printed once. */
OzStatus oz_inspect_contacts_print(FILE *file, const OzScene *scene, const OzGrains *grains);
