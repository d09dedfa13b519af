/* Edges of triangles, sorted by their ends. */
#include "scene/mesh_edges.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Of the angle by which a fold is seen as one, 25 degrees. */
static const double flat_cosine = 0.906;

/* An edge as seen from one of its triangles: its ends in an order of their own. */
typedef struct Edge {
    double low[3], high[3];
    int turns; /* 1: that triangle goes from low to high, -1: the other way */
    int face;
} Edge;

static int compare_edges(const void *a, const void *b)
{
    return memcmp(a, b, 6 * sizeof(double));
}

/* Whether one corner comes before another, in any fixed order. */
static bool is_before(const double a[3], const double b[3])
{
    for (int k = 0; k < 3; k++) {
        if (a[k] != b[k]) {
            return a[k] < b[k];
        }
    }
    return false;
}

/* The same corner must be the same bits: minus zero is none. */
static void copy_corner(double to[3], const double from[3])
{
    for (int k = 0; k < 3; k++) {
        to[k] = from[k] + 0.0;
    }
}

void oz_mesh_edges_normal(const double corners[9], double normal[3])
{
    double length2 = 0;
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;
        normal[k] = (corners[3 + i] - corners[i]) * (corners[6 + j] - corners[j]) -
                    (corners[3 + j] - corners[j]) * (corners[6 + i] - corners[i]);
        length2 += normal[k] * normal[k];
    }
    for (int k = 0; k < 3; k++) {
        normal[k] /= sqrt(length2);
    }
}

/* Whether triangles that share an edge are to be told apart there: all but two that lie nearly in
 * one plane. */
static bool is_crease(const double *corners, const Edge *edges, size_t count)
{
    double one[3], other[3];
    if (count != 2) {
        return true;
    }
    oz_mesh_edges_normal(corners + 9 * (size_t)edges[0].face, one);
    oz_mesh_edges_normal(corners + 9 * (size_t)edges[1].face, other);
    return one[0] * other[0] + one[1] * other[1] + one[2] * other[2] < flat_cosine;
}

/* Edges are looked at together with all that share them. */
OzStatus oz_mesh_edges_judge(OzMeshEdges *found, const double *corners, int faces)
{
    Edge *edges = NULL;
    size_t count = 3 * (size_t)faces;
    OZ_PASS(OZ_NEW(&found->creases, 6 * count));
    OZ_PASS(OZ_NEW(&edges, count));
    for (size_t e = 0; e < count; e++) {
        const double *face = corners + e / 3 * 9;
        const double *a = face + 3 * (e % 3), *b = face + 3 * ((e + 1) % 3);
        bool turned = is_before(b, a);
        copy_corner(edges[e].low, turned ? b : a);
        copy_corner(edges[e].high, turned ? a : b);
        edges[e].turns = turned ? -1 : 1;
        edges[e].face = (int)(e / 3);
    }
    qsort(edges, count, sizeof *edges, compare_edges);
    found->closed = true;
    for (size_t e = 0; e < count;) {
        size_t same = e;
        int sum = 0;
        while (same < count && compare_edges(&edges[e], &edges[same]) == 0) {
            sum += edges[same++].turns;
        }
        found->closed &= sum == 0;
        if (is_crease(corners, edges + e, same - e)) {
            memcpy(found->creases + 6 * (size_t)found->crease_count++, edges[e].low,
                   6 * sizeof(double));
        }
        e = same;
    }
    free(edges);
    return OZ_OK;
}
