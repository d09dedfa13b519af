/* Triangles of one body. Edges are matched by sorting, so that walls of many teeth stay cheap. */
#include "model/patch.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double PI = 3.14159265358979323846;

OzStatus oz_patch_create(OzPatch *patch, int vertex_count, int triangle_count)
{
    OzStatus status = OZ_OK;
    *patch = (OzPatch){.vertex_count = vertex_count, .triangle_count = triangle_count};
    OZ_TRY(OZ_NEW(&patch->vertex, 2 * (size_t)vertex_count));
    OZ_TRY(OZ_NEW(&patch->triangle, 3 * (size_t)triangle_count));
done:
    if (status != OZ_OK) {
        oz_patch_free(patch);
    }
    return status;
}

void oz_patch_free(OzPatch *patch)
{
    free(patch->vertex);
    free(patch->triangle);
    free(patch->joint);
    free(patch->outline);
    *patch = (OzPatch){0};
}

void oz_patch_set_disc(OzPatch *patch, double radius)
{
    *patch = (OzPatch){.area = PI * radius * radius, .reach = radius, .radius = radius};
}

void oz_patch_corners(const OzPatch *patch, int triangle, double corners[6])
{
    for (int c = 0; c < 3; c++) {
        memcpy(corners + 2 * c, patch->vertex + 2 * patch->triangle[3 * triangle + c],
               2 * sizeof(double));
    }
}

/* > 0 counter-clockwise. */
static double signed_area(const OzPatch *patch, int triangle)
{
    double c[6];
    oz_patch_corners(patch, triangle, c);
    return 0.5 * ((c[2] - c[0]) * (c[5] - c[1]) - (c[4] - c[0]) * (c[3] - c[1]));
}

double oz_patch_area(const OzPatch *patch, int triangle)
{
    return fabs(signed_area(patch, triangle));
}

static void centre_of(const OzPatch *patch, int triangle, double centre[2])
{
    double c[6];
    oz_patch_corners(patch, triangle, c);
    centre[0] = (c[0] + c[2] + c[4]) / 3;
    centre[1] = (c[1] + c[3] + c[5]) / 3;
}

double oz_patch_joint_length(const OzPatch *patch, int joint)
{
    double a[2], b[2];
    centre_of(patch, patch->joint[2 * joint], a);
    centre_of(patch, patch->joint[2 * joint + 1], b);
    return hypot(b[0] - a[0], b[1] - a[1]);
}

static void measure(OzPatch *patch)
{
    patch->area = patch->reach = 0;
    for (int t = 0; t < patch->triangle_count; t++) {
        patch->area += oz_patch_area(patch, t);
    }
    for (int v = 0; v < patch->vertex_count; v++) {
        patch->reach = fmax(patch->reach, hypot(patch->vertex[2 * v], patch->vertex[2 * v + 1]));
    }
}

/* One edge of one triangle, its vertices in order of their numbers. */
typedef struct Edge {
    int low, high, triangle, side;
} Edge;

static int compare_edges(const void *left, const void *right)
{
    const Edge *a = left, *b = right;
    return a->low != b->low     ? (a->low > b->low) - (a->low < b->low)
           : a->high != b->high ? (a->high > b->high) - (a->high < b->high)
                                : (a->triangle > b->triangle) - (a->triangle < b->triangle);
}

static int compare_pairs(const void *left, const void *right)
{
    const int *a = left, *b = right;
    return a[0] != b[0] ? (a[0] > b[0]) - (a[0] < b[0]) : (a[1] > b[1]) - (a[1] < b[1]);
}

static void turn_triangles(OzPatch *patch)
{
    for (int t = 0; t < patch->triangle_count; t++) {
        int *corner = patch->triangle + 3 * t, second = corner[1];
        if (signed_area(patch, t) < 0) {
            corner[1] = corner[2];
            corner[2] = second;
        }
    }
}

static void list_edges(const OzPatch *patch, Edge *edges)
{
    for (int i = 0; i < 3 * patch->triangle_count; i++) {
        int t = i / 3, side = i % 3;
        int a = patch->triangle[i], b = patch->triangle[3 * t + (side + 1) % 3];
        edges[i] = (Edge){a < b ? a : b, a < b ? b : a, t, side};
    }
}

/* Equal neighbours in the sorted list share an edge; an edge alone lies outside. */
static void match_edges(OzPatch *patch, const Edge *edges, int count)
{
    for (int i = 0; i < count; i++) {
        const Edge *edge = &edges[i], *next = edge + 1;
        if (i + 1 < count && edge->low == next->low && edge->high == next->high) {
            int *joint = patch->joint + 2 * patch->joint_count++;
            joint[0] = edge->triangle;
            joint[1] = next->triangle;
            i++;
        } else {
            int *outline = patch->outline + 2 * patch->outline_count++;
            outline[0] = edge->triangle;
            outline[1] = edge->side;
        }
    }
}

OzStatus oz_patch_join(OzPatch *patch)
{
    OzStatus status = OZ_OK;
    Edge *edges = NULL;
    int count = 3 * patch->triangle_count;
    OZ_TRY(OZ_NEW(&edges, count));
    OZ_TRY(OZ_NEW(&patch->joint, 2 * (size_t)count));
    OZ_TRY(OZ_NEW(&patch->outline, 2 * (size_t)count));
    turn_triangles(patch);
    list_edges(patch, edges);
    qsort(edges, (size_t)count, sizeof *edges, compare_edges);
    match_edges(patch, edges, count);
    qsort(patch->joint, (size_t)patch->joint_count, 2 * sizeof(int), compare_pairs);
    qsort(patch->outline, (size_t)patch->outline_count, 2 * sizeof(int), compare_pairs);
    measure(patch);
done:
    free(edges);
    return status;
}

void oz_patch_centre(OzPatch *patch)
{
    double sum[2] = {0, 0}, centre[2];
    for (int t = 0; t < patch->triangle_count; t++) {
        centre_of(patch, t, centre);
        sum[0] += oz_patch_area(patch, t) * centre[0] / patch->area;
        sum[1] += oz_patch_area(patch, t) * centre[1] / patch->area;
    }
    for (int v = 0; v < patch->vertex_count; v++) {
        patch->vertex[2 * v] -= sum[0];
        patch->vertex[2 * v + 1] -= sum[1];
    }
    measure(patch);
}

OzStatus oz_patch_copy(OzPatch *copy, const OzPatch *patch)
{
    OzStatus status = OZ_OK;
    OzPatch made = *patch;
    made.vertex = NULL;
    made.triangle = made.joint = made.outline = NULL;
    OZ_TRY(OZ_NEW(&made.vertex, 2 * (size_t)patch->vertex_count));
    OZ_TRY(OZ_NEW(&made.triangle, 3 * (size_t)patch->triangle_count));
    OZ_TRY(OZ_NEW(&made.joint, 2 * (size_t)patch->joint_count));
    OZ_TRY(OZ_NEW(&made.outline, 2 * (size_t)patch->outline_count));
    if (patch->triangle_count) {
        memcpy(made.vertex, patch->vertex, 2 * (size_t)patch->vertex_count * sizeof(double));
        memcpy(made.triangle, patch->triangle, 3 * (size_t)patch->triangle_count * sizeof(int));
        memcpy(made.joint, patch->joint, 2 * (size_t)patch->joint_count * sizeof(int));
        memcpy(made.outline, patch->outline, 2 * (size_t)patch->outline_count * sizeof(int));
    }
    *copy = made;
    made = (OzPatch){0};
done:
    oz_patch_free(&made);
    return status;
}
