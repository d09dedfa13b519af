/* What each wall does to the stable step, for the verdict of `orzo check`. */
#pragma once

#include "model/prediction.h"

#include <stdio.h>

/* A line with the largest stable step of each wall by itself (of a grain that lies at it; by a
 * Hertzian law, of a hit), walls alike together, and beside them that of two grains that meet
 * centrally; the walls at which the scene's own step is too large are said. Nothing without walls.
 * rows: of oz_prediction_rows. */
OzStatus oz_inspect_walls_print(FILE *file, const OzScene *scene, const OzGrains *grains,
                                const OzPrediction *rows);
