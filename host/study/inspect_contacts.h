/* The lines of `orzo check` about contacts of rods. */
#ifndef OZ_STUDY_INSPECT_CONTACTS_H
#define OZ_STUDY_INSPECT_CONTACTS_H

#include "model/grains.h"

#include <stdio.h>

/* Of two grains and of a grain at each wall: stiffness, damping, steps, restitution, stability.
 * Walls in a row of which the same is to be said are printed once. */
OzStatus oz_inspect_contacts_print(FILE *file, const OzScene *scene, const OzGrains *grains);

#endif
