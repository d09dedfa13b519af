/* Ear clipping (Meisters 1975), the best ear first, then flips of diagonals to the Delaunay
 * triangulation (Lawson 1972). Knows nothing of grains. */
#include "model/triangulation.h"

#include "base/memory.h"
#include "scene/scene.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

/* A corner counts as straight when its triangle has less than this of its edges' squared length:
 * far above rounding, far below what a step could carry. */
#define FLATNESS 1e-9

static double cross(const double *a, const double *b, const double *c)
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
}

static double square(const double *a, const double *b)
{
    return (b[0] - a[0]) * (b[0] - a[0]) + (b[1] - a[1]) * (b[1] - a[1]);
}

static bool within(const double *a, const double *b, const double *p)
{
    return p[0] >= fmin(a[0], b[0]) && p[0] <= fmax(a[0], b[0]) && p[1] >= fmin(a[1], b[1]) &&
           p[1] <= fmax(a[1], b[1]);
}

/* Whether two segments have a point in common. */
static bool meet(const double *a, const double *b, const double *c, const double *d)
{
    double abc = cross(a, b, c), abd = cross(a, b, d), cda = cross(c, d, a), cdb = cross(c, d, b);
    if (((abc > 0 && abd < 0) || (abc < 0 && abd > 0)) &&
        ((cda > 0 && cdb < 0) || (cda < 0 && cdb > 0))) {
        return true;
    }
    return (abc == 0 && within(a, b, c)) || (abd == 0 && within(a, b, d)) ||
           (cda == 0 && within(c, d, a)) || (cdb == 0 && within(c, d, b));
}

static OzStatus check_twins(const double *p, int n, const char *where)
{
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < i; j++) {
            if (square(p + 2 * i, p + 2 * j) == 0) {
                return oz_status_fail(
                    OZ_ERR_INPUT,
                    "%s: corners %d and %d of the grain are the same point (%g, %g); expected each "
                    "once, the first not repeated at the end",
                    where, j, i, p[2 * i], p[2 * i + 1]);
            }
        }
    }
    return OZ_OK;
}

static OzStatus check_corners(const double *p, int n, const char *where)
{
    for (int i = 0; i < n; i++) {
        const double *a = p + 2 * ((i + n - 1) % n), *b = p + 2 * i, *c = p + 2 * ((i + 1) % n);
        if (fabs(cross(a, b, c)) <= FLATNESS * (square(a, b) + square(b, c))) {
            return oz_status_fail(OZ_ERR_INPUT,
                                  "%s: corner %d (%g, %g) of the grain lies on the line of its "
                                  "neighbours; expected it left out",
                                  where, i, b[0], b[1]);
        }
    }
    return OZ_OK;
}

static OzStatus check_edges(const double *p, int n, const char *where)
{
    for (int i = 0; i < n; i++) {
        for (int j = i + 2; j < n; j++) {
            if (i == 0 && j == n - 1) {
                continue;
            }
            if (meet(p + 2 * i, p + 2 * (i + 1), p + 2 * j, p + 2 * ((j + 1) % n))) {
                return oz_status_fail(
                    OZ_ERR_INPUT,
                    "%s: the edges from corner %d and from corner %d of the grain "
                    "meet; expected a simple polygon",
                    where, i, j);
            }
        }
    }
    return OZ_OK;
}

static double polygon_area(const double *p, int n)
{
    double sum = 0;
    for (int i = 0; i < n; i++) {
        const double *a = p + 2 * i, *b = p + 2 * ((i + 1) % n);
        sum += 0.5 * ((a[0] - p[0]) * (b[1] - p[1]) - (b[0] - p[0]) * (a[1] - p[1]));
    }
    return sum;
}

/* The corners not yet clipped, counter-clockwise. */
typedef struct Ring {
    const double *p;
    int *corner;
    int count;
} Ring;

/* How good a triangle is: area over squared edges, which a small least angle makes small. */
static double quality(const double *a, const double *b, const double *c)
{
    return cross(a, b, c) / (square(a, b) + square(b, c) + square(c, a));
}

/* The quality of the ear at place i of the ring, or -1 where there is none. */
static double ear_quality(const Ring *ring, int i)
{
    int n = ring->count, before = (i + n - 1) % n, after = (i + 1) % n;
    const double *a = ring->p + 2 * ring->corner[before], *b = ring->p + 2 * ring->corner[i],
                 *c = ring->p + 2 * ring->corner[after];
    if (cross(a, b, c) <= 0) {
        return -1;
    }
    for (int j = 0; j < n; j++) {
        const double *q = ring->p + 2 * ring->corner[j];
        if (j != before && j != i && j != after && cross(a, b, q) >= 0 && cross(b, c, q) >= 0 &&
            cross(c, a, q) >= 0) {
            return -1;
        }
    }
    return quality(a, b, c);
}

static OzStatus clip_ears(OzTriangleSet *triangle_set, Ring *ring, const char *where)
{
    for (int t = 0; t < triangle_set->triangle_count; t++) {
        int best = 0;
        double most = -1;
        for (int i = 0; i < ring->count; i++) {
            double found = ear_quality(ring, i);
            if (found > most) {
                most = found;
                best = i;
            }
        }
        if (most < 0) {
            return oz_status_fail(OZ_ERR_INPUT,
                                  "%s: the grain's corners are too close to a line to be cut into "
                                  "triangles; expected a plainer polygon",
                                  where);
        }
        int n = ring->count--;
        triangle_set->triangle[3 * t] = ring->corner[(best + n - 1) % n];
        triangle_set->triangle[3 * t + 1] = ring->corner[best];
        triangle_set->triangle[3 * t + 2] = ring->corner[(best + 1) % n];
        for (int i = best; i < ring->count; i++) {
            ring->corner[i] = ring->corner[i + 1];
        }
    }
    return OZ_OK;
}

/* The corner of triangle t that follows `side` places after its first. */
static int corner_at(const OzTriangleSet *triangle_set, int t, int side)
{
    return triangle_set->triangle[3 * t + side % 3];
}

/* Flips the edge `side` of s with t's across, when both have it and the other diagonal is better.
 * Of the two diagonals of a convex quadrilateral the one whose opposite angles sum to less than
 * half a turn is Delaunay's: sin of that sum > 0. */
static bool flip(OzTriangleSet *triangle_set, int s, int t, int side, int across)
{
    int a = corner_at(triangle_set, s, side), b = corner_at(triangle_set, s, side + 1);
    if (corner_at(triangle_set, t, across) != b || corner_at(triangle_set, t, across + 1) != a) {
        return false;
    }
    int c = corner_at(triangle_set, s, side + 2), d = corner_at(triangle_set, t, across + 2);
    const double *A = triangle_set->vertex + 2 * a, *B = triangle_set->vertex + 2 * b,
                 *C = triangle_set->vertex + 2 * c, *D = triangle_set->vertex + 2 * d;
    double cos_c = (A[0] - C[0]) * (B[0] - C[0]) + (A[1] - C[1]) * (B[1] - C[1]);
    double cos_d = (B[0] - D[0]) * (A[0] - D[0]) + (B[1] - D[1]) * (A[1] - D[1]);
    double sin_c = cross(C, A, B), sin_d = cross(D, B, A);
    double scale = square(A, B) * (square(C, D) + square(A, B));
    bool convex = cross(C, A, D) > 0 && cross(D, B, C) > 0;
    /* A circle through all four must not flip for ever. */
    if (!convex || sin_c * cos_d + cos_c * sin_d >= -1e-12 * scale) {
        return false;
    }
    int *first = triangle_set->triangle + 3 * s, *second = triangle_set->triangle + 3 * t;
    first[0] = c, first[1] = a, first[2] = d;
    second[0] = d, second[1] = b, second[2] = c;
    return true;
}

static bool flip_any(OzTriangleSet *triangle_set, int s)
{
    for (int t = s + 1; t < triangle_set->triangle_count; t++) {
        for (int pair = 0; pair < 9; pair++) {
            if (flip(triangle_set, s, t, pair / 3, pair % 3)) {
                return true;
            }
        }
    }
    return false;
}

static void flip_all(OzTriangleSet *triangle_set)
{
    /* Every flip lowers the surface over the paraboloid, so this ends; a bound guards rounding. */
    int left = triangle_set->triangle_count * triangle_set->triangle_count;
    for (int s = 0; s < triangle_set->triangle_count && left > 0; s++) {
        if (flip_any(triangle_set, s)) {
            s = -1;
            left--;
        }
    }
}

static void fill_ring(Ring *ring, OzTriangleSet *triangle_set, const double *corners, bool reversed)
{
    int n = triangle_set->vertex_count;
    for (int i = 0; i < n; i++) {
        int from = reversed ? n - 1 - i : i;
        triangle_set->vertex[2 * i] = corners[2 * from];
        triangle_set->vertex[2 * i + 1] = corners[2 * from + 1];
        ring->corner[i] = i;
    }
    ring->p = triangle_set->vertex;
    ring->count = n;
}

OzStatus oz_triangulation_make(OzTriangleSet *triangle_set, const double *corners, int corner_count,
                               const char *where)
{
    OzStatus status = OZ_OK;
    Ring ring = {0};
    *triangle_set = (OzTriangleSet){0};
    if (corner_count < 3 || corner_count > OZ_CORNERS_MAX) {
        return oz_status_fail(OZ_ERR_INPUT, "%s: a grain of %d corners; expected 3 to %d", where,
                              corner_count, OZ_CORNERS_MAX);
    }
    OZ_TRY(check_twins(corners, corner_count, where));
    OZ_TRY(check_corners(corners, corner_count, where));
    OZ_TRY(check_edges(corners, corner_count, where));
    OZ_TRY(OZ_NEW(&ring.corner, corner_count));
    OZ_TRY(oz_triangle_set_create(triangle_set, corner_count, corner_count - 2));
    fill_ring(&ring, triangle_set, corners, polygon_area(corners, corner_count) < 0);
    OZ_TRY(clip_ears(triangle_set, &ring, where));
    flip_all(triangle_set);
    OZ_TRY(oz_triangle_set_join(triangle_set));
done:
    free(ring.corner);
    if (status != OZ_OK) {
        oz_triangle_set_free(triangle_set);
    }
    return status;
}
