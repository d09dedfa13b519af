/* Slices and rings. */
#include "observe/coarse_body.h"

#include "base/memory.h"

#include <math.h>
#include <stdbool.h>

static const double PI = 3.14159265358979323846;

/* Of a radius: a scene's width is a tenth of a diameter at least (scene/check_tables.c), and of
 * grains from a file, which it does not know, more would take too long. */
enum { PIECES_MOST = 10 };

/* A body that is being cut up. */
typedef struct Cut {
    OzCoarsePoints *points;
    double axis[3], aside[2][3]; /* three directions across each other */
    double radius, width;        /* m   */
    double volume;               /* m^3 */
} Cut;

/* Two unit vectors across a third, which turn with it. */
static void find_aside(Cut *cut)
{
    const double *u = cut->axis;
    int k = fabs(u[0]) < fabs(u[1]) ? 0 : 1;
    k = fabs(u[2]) < fabs(u[k]) ? 2 : k;
    double *v = cut->aside[0], *w = cut->aside[1];
    double length = sqrt(1 - u[k] * u[k]);
    for (int c = 0; c < 3; c++) {
        v[c] = ((c == k) - u[k] * u[c]) / length;
    }
    for (int c = 0; c < 3; c++) {
        int d = (c + 1) % 3, e = (c + 2) % 3;
        w[c] = u[d] * v[e] - u[e] * v[d];
    }
}

/* Places of Gauss' rule of two points in `pieces` pieces of 0 to 1, each of the same weight. */
static double gauss_at(int n, int pieces)
{
    const double aside = 0.28867513459481288225; /* 1 / (2 sqrt(3)) */
    return (n / 2 + 0.5 + (n % 2 ? aside : -aside)) / pieces;
}

/* `count` points of this share each, `along` the axis and `out` from it; turned: by half of what
 * they are apart. There is room for them. */
static void add_ring(Cut *cut, double along, double out, int count, bool turned, double share)
{
    double turn = 2 * PI / count, begin = turned ? turn / 2 : 0;
    double x = out * cos(begin), y = out * sin(begin), c = cos(turn), s = sin(turn);
    for (int j = 0; j < count; j++) {
        OzCoarsePoint *point = &cut->points->of[cut->points->count++];
        double turned_x = c * x - s * y;
        point->share = share;
        for (int k = 0; k < 3; k++) {
            point->at[k] = along * cut->axis[k] + x * cut->aside[0][k] + y * cut->aside[1][k];
        }
        y = s * x + c * y;
        x = turned_x;
    }
}

/* A slice `along` from the centre, of this radius; share: of the body. Its rings lie by Gauss' rule
 * in the square of their radius, in which the disc's area is even. */
static OzStatus add_slice(Cut *cut, double along, double radius, double share)
{
    OzCoarsePoints *points = cut->points;
    int pieces = (int)fmin(fmax(ceil(radius / cut->width), 1), PIECES_MOST);
    if (cut->radius < 0.55 * cut->width) { /* one ring has the disc's second moments */
        OZ_PASS(OZ_ROOM(&points->of, &points->capacity, points->count + 5, "points"));
        add_ring(cut, along, radius * sqrt(0.5), 5, false, share / 5);
        return OZ_OK;
    }
    for (int i = 0; i < 2 * pieces; i++) {
        double out = radius * sqrt(gauss_at(i, pieces));
        int count = (int)fmin(fmax(ceil(10 * out / cut->width), 5), 10 * PIECES_MOST);
        OZ_PASS(OZ_ROOM(&points->of, &points->capacity, points->count + count, "points"));
        add_ring(cut, along, out, count, i % 2, share / (2 * pieces * count));
    }
    return OZ_OK;
}

/* From `low` to `high` along the axis, of a body that is round about `middle` there, or, where
 * that is not finite, straight. */
static OzStatus add_part(Cut *cut, double low, double high, double middle)
{
    double per_width = isfinite(middle) ? 1.5 : 1; /* where the radius changes, too */
    int pieces = (int)fmin(ceil(per_width * (high - low) / cut->width), 100 * PIECES_MOST);
    for (int n = 0; n < 2 * pieces; n++) {
        double at = low + (high - low) * gauss_at(n, pieces);
        double off = isfinite(middle) ? at - middle : 0;
        double square = cut->radius * cut->radius - off * off;
        double share = PI * square * (high - low) / (2 * pieces) / cut->volume;
        OZ_PASS(add_slice(cut, at, sqrt(square), share));
    }
    return OZ_OK;
}

OzStatus oz_coarse_body_fill(OzCoarsePoints *points, double diameter, double length,
                             const double axis[3], double width)
{
    double r = 0.5 * diameter, half = 0.5 * length;
    Cut cut = {.points = points,
               .axis = {axis[0], axis[1], axis[2]},
               .radius = r,
               .width = width,
               .volume = PI * r * r * (4 * r / 3 + length)};
    points->count = 0;
    find_aside(&cut);
    OZ_PASS(add_part(&cut, -half - r, -half, -half));
    if (half > 0) {
        OZ_PASS(add_part(&cut, -half, half, INFINITY));
    }
    return add_part(&cut, half, half + r, half);
}
