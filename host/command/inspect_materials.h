/* The table of `orzo check` about materials of grains and walls. */
#pragma once

#include "model/prediction.h"

#include <stdio.h>

/* What each two do to each other, mixed or of `pairs`, one line each; nothing without materials.
 * Walls of one material are one line, and one that is of none has its own. */
void oz_inspect_materials_print(FILE *file, const OzScene *scene, const OzPrediction *rows,
                                int count);

/* "two grains", "a grain at wall 1"; of several materials "glass and steel", "glass at wall 1". */
void oz_inspect_materials_place(char *text, size_t size, const OzScene *scene,
                                const OzPrediction *row);
