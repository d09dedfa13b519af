/* What tests of grains' outlines share: the area inside one, and shapes given by their corners. */
#ifndef OZ_TESTS_OUTLINES_H
#define OZ_TESTS_OUTLINES_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "model/triangle_set.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

/* Sums of some tens of products. */
#define ROUNDING 1e-13

static inline void close_to(double a, double b)
{
    if (!(fabs(a - b) <= ROUNDING * fabs(b))) {
        fail_msg("%.17g is not %.17g", a, b);
    }
}

/* Area inside the outline alone, and how far its edges, laid end to end, are from closing. */
static inline double outline_area(const OzTriangleSet *triangle_set, double gap[2])
{
    double area = 0, c[6];
    gap[0] = gap[1] = 0;
    for (int k = 0; k < triangle_set->outline_count; k++) {
        oz_triangle_set_corners(triangle_set, triangle_set->outline[2 * k], c);
        int side = triangle_set->outline[2 * k + 1];
        const double *a = c + 2 * side, *b = c + 2 * ((side + 1) % 3);
        area += 0.5 * (a[0] * b[1] - a[1] * b[0]);
        gap[0] += b[0] - a[0];
        gap[1] += b[1] - a[1];
    }
    return area;
}

/* An arrow and an L, as x y of their corners. */
static const double ARROW[] = {0, 0, 4, 2, 0, 4, 1, 2};
static const double ELL[] = {0, 0, 3, 0, 3, 1, 1, 1, 1, 3, 0, 3};

#endif
