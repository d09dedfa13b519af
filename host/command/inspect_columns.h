/* Which columns of series.csv a scene with grains leaves empty in every row, and why. */
#pragma once

#include "model/grains.h"

#include <stdio.h>

/* Prints "density, density_all: no level floor; tap: no wall moves up and down", or
 * "none". Columns that a scene does not have at all (of the other model, of a ledger not asked for)
 * are not named, nor those that fill only when something happens (the size of the last avalanche).
 */
void oz_inspect_columns_print(FILE *file, const OzScene *scene, const OzGrains *grains);
