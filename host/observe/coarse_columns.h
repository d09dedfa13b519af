/* What is said of a cell: the columns of fields.csv and the arrays of its files for ParaView. */
#pragma once

#include "observe/coarse_sums.h"

#include <stdbool.h>

/* THE list of them: X(name, how many numbers). Their names end as of_columns in coarse_columns.c
 * says: x, y, z; or as the list in coarse_sums.h does. Units: 1, kg/m^3, m/s, m^2/s^2, Pa, Pa, Pa,
 * N/m^3, 1, 1. */
#define OZ_COARSE_COLUMNS(X)                                                                       \
    X(volume_fraction, 1)                                                                          \
    X(mass_density, 1)                                                                             \
    X(velocity, 3)       /* momentum over mass; not a number where there is no mass         */     \
    X(temperature, 1)    /* a third of the mean square of velocities about it               */     \
    X(pressure, 1)       /* a third of the trace of both stresses                           */     \
    X(stress_kinetic, 6) /* of velocities about the mean                                    */     \
    X(stress_contact, 9)                                                                           \
    X(wall_force, 3)                                                                               \
    X(fabric, 6)                                                                                   \
    X(axis, 6) /* mean by mass, of grains with shafts, of axis times axis               */

typedef struct OzCoarseColumn {
    const char *name;
    int width; /* numbers */
} OzCoarseColumn;

enum {
#define OZ_COARSE_COLUMN_AT(name, width)                                                           \
    OZ_COARSE_COLUMN_##name, OZ_COARSE_COLUMN_##name##_end = OZ_COARSE_COLUMN_##name + (width)-1,
    OZ_COARSE_COLUMNS(OZ_COARSE_COLUMN_AT)
#undef OZ_COARSE_COLUMN_AT
        OZ_COARSE_NUMBERS
};

/* The list, ending with a name of NULL. */
const OzCoarseColumn *oz_coarse_columns_all(void);

/* What number k of a column is called behind its name, "_xx"; empty of a single one. */
const char *oz_coarse_columns_part(const OzCoarseColumn *column, int k);

/* The numbers of one cell, from its sums (OZ_COARSE_WORDS) times `factor`. */
void oz_coarse_columns_find(const double *sums, double factor, double numbers[OZ_COARSE_NUMBERS]);
