/* Coarse-grained fields of one moment after Goldhirsch (Granular Matter 12 (2010), 239-252): what
 * grains and contacts have of mass, momentum and stress, spread over cells (observe/coarse_grid.h).
 *
 * A grain's mass, momentum and momentum flux are at its centre, so that they and the stress fulfil
 * the balance of momentum to rounding, whatever the width; its volume is where its body is
 * (observe/coarse_body.h). The contact stress of a grain is the sum over its contacts of force
 * times branch, from its centre to the contact point, spread along that branch (Goldhirsch's line
 * integral), at walls, too (Weinhart, Thornton, Luding & Bokhove, Granular Matter 14 (2012), 289),
 * where the force of walls on grains is a density beside it, at the contact point. So
 * divergence(stress) = density (gravity - acceleration) + wall force, stresses positive where they
 * press. The fabric is the sum over grains of volume times that over contacts of n n (Luding, Int.
 * J. Solids Struct. 41 (2004), 5821): its trace is the volume fraction times contacts per grain. */
#pragma once

#include "observe/coarse_body.h"
#include "observe/coarse_grid.h"

/* THE list of what is added up in a cell, of 1/m^3 each: X(NAME, numbers). Symmetric tensors are
 * xx, yy, zz, xy, yz, xz; the contact stress is xx, xy, xz, yx, ... zz, of which the first letter
 * is the force's. What is a grain's, at its centre, is together. */
#define OZ_COARSE_WORDS(X)                                                                         \
    X(VOLUME, 1)    /* m^3                                            */                           \
    X(MASS, 1)      /* kg                                             */                           \
    X(MOMENTUM, 3)  /* kg m/s                                         */                           \
    X(FLUX, 6)      /* J, mass times velocity times velocity          */                           \
    X(FABRIC, 6)    /* m^3                                            */                           \
    X(SHAFT, 1)     /* kg, of grains that have one                    */                           \
    X(DIRECTION, 6) /* kg, of these: mass times axis times axis       */                           \
    X(CONTACT, 9)   /* J, force times branch                          */                           \
    X(WALL, 3)      /* N, of walls on grains                          */

enum {
#define OZ_COARSE_AT(NAME, numbers)                                                                \
    OZ_COARSE_##NAME, OZ_COARSE_##NAME##_END = OZ_COARSE_##NAME + (numbers)-1,
    OZ_COARSE_WORDS(OZ_COARSE_AT)
#undef OZ_COARSE_AT
        OZ_COARSE_COUNT
};

/* Zeroed is empty. Frees with oz_coarse_sums_free. */
typedef struct OzCoarseSums {
    double *cell;      /* OZ_COARSE_COUNT of each cell, x fastest; owned */
    int64_t cells;     /* how many there are                             */
    double *volume;    /* of each cell, m^3 per m^3, before it is in its place: thus it is in the
                          cache;    owned */
    double *fabric;    /* 6 of each grain: sum of n n; owned */
    double per_volume; /* 1/m^3, of a cell */
    OzCoarseShares shares[3];
    OzCoarsePoints points;
} OzCoarseSums;

OzStatus oz_coarse_sums_create(OzCoarseSums *sums, const OzCoarseGrid *grid, int64_t grains);
void oz_coarse_sums_free(OzCoarseSums *sums);

/* Fills cells anew with a snapshot that has its contacts, in the order of ids. The line integral is
 * by Gauss' rule of three points in pieces of half a width at most: right to 1e-4 of what the cell
 * that gets most gets of one contact, and exact in the sum over cells. */
OzStatus oz_coarse_sums_fill(OzCoarseSums *sums, const OzCoarseGrid *grid,
                             const OzSnapshot *snapshot);
