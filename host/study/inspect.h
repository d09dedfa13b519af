/* `orzo check`: what follows from a scene before it is run. */
#ifndef OZ_STUDY_INSPECT_H
#define OZ_STUDY_INSPECT_H

#include "cli.h"

#include <stdio.h>

/* Prints to file: grains, walls, contacts with predicted restitution and stability margin, kernel switches,
 * what is left out, device memory. */
OzStatus oz_inspect_scene(const OzOptions *options, FILE *file);

#endif
