/* Fields from sums. */
#include "observe/coarse_columns.h"

#include <math.h>
#include <string.h>

#define ROW(name, width) {#name, width},
static const OzCoarseColumn COLUMNS[] = {OZ_COARSE_COLUMNS(ROW){NULL, 0}};
#undef ROW

const OzCoarseColumn *oz_coarse_columns_all(void)
{
    return COLUMNS;
}

const char *oz_coarse_columns_part(const OzCoarseColumn *column, int k)
{
    static const char *const vector[] = {"_x", "_y", "_z"};
    static const char *const symmetric[] = {"_xx", "_yy", "_zz", "_xy", "_yz", "_xz"};
    static const char *const tensor[] = {"_xx", "_xy", "_xz", "_yx", "_yy",
                                         "_yz", "_zx", "_zy", "_zz"};
    return column->width == 3   ? vector[k]
           : column->width == 6 ? symmetric[k]
           : column->width == 9 ? tensor[k]
                                : "";
}

/* The flux of momentum without that of the mean velocity; what rounding leaves of nothing is
 * nothing. */
static void find_kinetic(const double *sums, double factor, const double velocity[3],
                         double kinetic[6])
{
    double density = factor * sums[OZ_COARSE_MASS];
    for (int k = 0; k < 3; k++) {
        int a = k == 2 ? 0 : k, b = k == 2 ? 2 : k + 1;
        double flux = factor * sums[OZ_COARSE_FLUX + k];
        kinetic[k] = fmax(flux - density * velocity[k] * velocity[k], 0);
        kinetic[3 + k] =
            factor * sums[OZ_COARSE_FLUX + 3 + k] - density * velocity[a] * velocity[b];
    }
}

void oz_coarse_columns_find(const double *sums, double factor, double numbers[OZ_COARSE_NUMBERS])
{
    double density = factor * sums[OZ_COARSE_MASS], shaft = factor * sums[OZ_COARSE_SHAFT];
    double *kinetic = &numbers[OZ_COARSE_COLUMN_stress_kinetic],
           *velocity = &numbers[OZ_COARSE_COLUMN_velocity];
    for (int k = 0; k < 3; k++) {
        velocity[k] = density > 0 ? sums[OZ_COARSE_MOMENTUM + k] / sums[OZ_COARSE_MASS] : NAN;
        numbers[OZ_COARSE_COLUMN_wall_force + k] = factor * sums[OZ_COARSE_WALL + k];
    }
    for (int k = 0; k < 9; k++) {
        numbers[OZ_COARSE_COLUMN_stress_contact + k] = factor * sums[OZ_COARSE_CONTACT + k];
    }
    for (int k = 0; k < 6; k++) {
        numbers[OZ_COARSE_COLUMN_fabric + k] = factor * sums[OZ_COARSE_FABRIC + k];
        numbers[OZ_COARSE_COLUMN_axis + k] =
            shaft > 0 ? sums[OZ_COARSE_DIRECTION + k] / sums[OZ_COARSE_SHAFT] : NAN;
    }
    memset(kinetic, 0, 6 * sizeof *kinetic);
    if (density > 0) {
        find_kinetic(sums, factor, velocity, kinetic);
    }
    const double *contact = &numbers[OZ_COARSE_COLUMN_stress_contact];
    double trace = kinetic[0] + kinetic[1] + kinetic[2];
    numbers[OZ_COARSE_COLUMN_volume_fraction] = factor * sums[OZ_COARSE_VOLUME];
    numbers[OZ_COARSE_COLUMN_mass_density] = density;
    numbers[OZ_COARSE_COLUMN_temperature] = density > 0 ? trace / (3 * density) : NAN;
    numbers[OZ_COARSE_COLUMN_pressure] = (trace + contact[0] + contact[4] + contact[8]) / 3;
}
