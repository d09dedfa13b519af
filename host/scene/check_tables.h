/* Checks of what scene/tables.h has. */
#pragma once

#include "scene/scene_types.h"
#include "scene/tree.h"

/* The most cells of a field, about 0.7 kB each. */
#define OZ_CHECK_CELLS_MAX 1000000

/* Adds faults for fields whose cells are too many or are nowhere, or whose width does not fit
 * grains or a periodic cell. */
void oz_check_tables_fields(const OzScene *scene, OzNode *root, OzFaults *faults);
