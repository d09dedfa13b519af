/* The cells of coarse-grained fields, and which share of what lies at a point each of them gets.
 *
 * Along each axis what lies at x is spread by Lucy's polynomial (Lucy, Astron. J. 82 (1977), 1013)
 * in one dimension, p(u) = 5/4 (1 + 3 |u|) (1 - |u|)^3 / w of u = (distance from x) / w, |u| < 1:
 * smooth, never negative, of integral 1 and standard deviation w sqrt(2/21) = 0.31 w. A cell has
 * the mean over itself, so that the shares of all cells add up to 1 whatever their size:
 * Goldhirsch's smoothing function is the product of three such polynomials, each smeared over the
 * edge of a cell. An axis of one cell without a range of its own is not looked along: all there is
 * counts in full. */
#pragma once

#include "model/snapshot.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct OzCoarseGrid {
    int64_t cells[3];
    double low[3], high[3]; /* m */
    double width;           /* m */
    double period[3];       /* m, after which space repeats itself; 0: it does not */
    bool is_whole[3];       /* the axis is not looked along                        */
} OzCoarseGrid;

/* What a cell of one axis gets of a point. */
typedef struct OzCoarseShare {
    int64_t cell;
    double share; /* of 1 */
} OzCoarseShare;

/* All that get some; a cell of a short periodic axis may be there twice. */
typedef struct OzCoarseShares {
    OzCoarseShare *of; /* owned */
    int64_t count, capacity;
} OzCoarseShares;

/* All but low and high. */
OzCoarseGrid oz_coarse_grid_make(const OzScene *scene);

/* Fills low and high: ranges as written; those that are not are a periodic cell; the inside of the
 * walls; or, on a side without one, what the grains of this moment take up; and, of an axis that is
 * looked along and not periodic, a width more on either side, so that nothing is lost. */
void oz_coarse_grid_place(OzCoarseGrid *grid, const OzSnapshot *snapshot);

int64_t oz_coarse_grid_count(const OzCoarseGrid *grid);

/* m^3, of one cell. */
double oz_coarse_grid_volume(const OzCoarseGrid *grid);

/* m, the middle of cell i along an axis. */
double oz_coarse_grid_middle(const OzCoarseGrid *grid, int axis, int64_t i);

/* Finds the shares of a point (m, a path that goes on where space repeats itself) along an axis;
 * shares is zeroed or was filled before, and is freed with oz_coarse_grid_free_shares. */
OzStatus oz_coarse_grid_share(const OzCoarseGrid *grid, int axis, double at,
                              OzCoarseShares *shares);

void oz_coarse_grid_free_shares(OzCoarseShares *shares);
