/* Printing a range. */
#include "command/inspect_range.h"

#include "scene/boundary.h"

#include <math.h>
#include <string.h>

void oz_inspect_range_print(FILE *file, const char *name, double low, double high, const char *unit)
{
    char from[32], to[32];
    snprintf(from, sizeof from, "%.6g", low);
    snprintf(to, sizeof to, "%.6g", high);
    bool same = strcmp(from, to) == 0;
    fprintf(file, "  %-16s %s%s%s %s\n", name, from, same ? "" : " ... ", same ? "" : to, unit);
}

void oz_inspect_range_print_all(FILE *file, const char *name, const double *values,
                                const double *radius, int64_t count, const char *unit)
{
    double low = INFINITY, high = -INFINITY;
    for (int64_t i = 0; i < count; i++) {
        if (!radius || radius[i] == 0) {
            low = fmin(low, values[i]);
            high = fmax(high, values[i]);
        }
    }
    if (high >= low) {
        oz_inspect_range_print(file, name, low, high, unit);
    }
}

void oz_inspect_range_print_cell(FILE *file, const OzScene *scene, double volume)
{
    const OzBoundary *cell = &scene->boundary;
    double all = 1;
    const char *separator = " ";
    fprintf(file, "cell              ");
    for (int k = 0; k < 3; k++) {
        double period = oz_boundary_period(cell, k);
        all *= period;
        if (period > 0) {
            fprintf(file, "%s%.6g m along %c", separator, period, 'x' + k);
            separator = ", ";
        }
    }
    fputc('\n', file);
    if (all > 0) {
        fprintf(file, "  filled           %.4g\n", volume / all);
    }
    if (cell->shear_rate != 0) {
        double time = 1 / fabs(cell->shear_rate);
        fprintf(file, "  shear            by 1 in %.4g s, %.0f steps\n", time, time / scene->step);
    }
}

void oz_inspect_range_print_places(FILE *file, const double *places, int64_t count, bool is_flat)
{
    static const char *const names[] = {"x", "y", "z"};
    for (int k = 0; k < (is_flat ? 2 : 3) && count > 0; k++) {
        double low = INFINITY, high = -INFINITY;
        for (int64_t i = 0; i < count; i++) {
            low = fmin(low, places[3 * i + k]);
            high = fmax(high, places[3 * i + k]);
        }
        oz_inspect_range_print(file, names[k], low, high, "m (centres, as placed)");
    }
}
