/* How scenes are laid out on a device: slots, regions, list capacities, cells, skins. */
#pragma once

#include "sim/model.h"
#include "sim/rods_fields.h"

/* For rods' row (sim/model.h), of OzSizes, OzParameters and OzSwitches: sizes that a member needs,
 * and its lists' skins and cells; sizes that serve another member too. */
OzStatus oz_sizes_choose(void *sizes, void *parameters, const OzScene *scene,
                         const OzGrains *grains, const void *switches);
void oz_sizes_join(void *sizes, const void *other);

/* For every model: a count as so many whole blocks of `to`; regions, their capacities at first, and
 * steps a launch, for bodies that move in so many slots; cells along `axes` axes that reach farther
 * than any pair, for bodies that take up `size`, m, at the start. Cells are as wide as the longest
 * reach with its skin, so that the neighbouring ones hold all partners (half as wide and two away
 * measured slower, more rows of cells costing more than fewer candidates save). The grid wraps
 * around, so its size is a matter of speed only, as long as no cell is met twice. */
int oz_sizes_up(double count, int to);
void oz_sizes_regions(OzSizesHead *z, const OzSwitchesHead *switches, int slots);
void oz_sizes_cells(OzSizesHead *z, double *inverse_cell, double reach, const double *size,
                    int axes, int64_t bodies);
