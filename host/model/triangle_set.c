/* Triangles of one body. Edges are matched by sorting, so that walls of many teeth stay cheap. */
#include "model/triangle_set.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double PI = 3.14159265358979323846;

OzStatus oz_triangle_set_create(OzTriangleSet *triangle_set, int vertex_count, int triangle_count)
{
    OzStatus status = OZ_OK;
    *triangle_set = (OzTriangleSet){.vertex_count = vertex_count, .triangle_count = triangle_count};
    OZ_TRY(OZ_NEW(&triangle_set->vertex, 2 * (size_t)vertex_count));
    OZ_TRY(OZ_NEW(&triangle_set->triangle, 3 * (size_t)triangle_count));
done:
    if (status != OZ_OK) {
        oz_triangle_set_free(triangle_set);
    }
    return status;
}

void oz_triangle_set_free(OzTriangleSet *triangle_set)
{
    free(triangle_set->vertex);
    free(triangle_set->triangle);
    free(triangle_set->joint);
    free(triangle_set->outline);
    *triangle_set = (OzTriangleSet){0};
}

void oz_triangle_set_set_disc(OzTriangleSet *triangle_set, double radius)
{
    *triangle_set =
        (OzTriangleSet){.area = PI * radius * radius, .reach = radius, .radius = radius};
}

void oz_triangle_set_corners(const OzTriangleSet *triangle_set, int triangle, double corners[6])
{
    for (int c = 0; c < 3; c++) {
        memcpy(corners + 2 * c, triangle_set->vertex + 2 * triangle_set->triangle[3 * triangle + c],
               2 * sizeof(double));
    }
}

/* > 0 counter-clockwise. */
static double signed_area(const OzTriangleSet *triangle_set, int triangle)
{
    double c[6];
    oz_triangle_set_corners(triangle_set, triangle, c);
    return 0.5 * ((c[2] - c[0]) * (c[5] - c[1]) - (c[4] - c[0]) * (c[3] - c[1]));
}

double oz_triangle_set_area(const OzTriangleSet *triangle_set, int triangle)
{
    return fabs(signed_area(triangle_set, triangle));
}

static void centre_of(const OzTriangleSet *triangle_set, int triangle, double centre[2])
{
    double c[6];
    oz_triangle_set_corners(triangle_set, triangle, c);
    centre[0] = (c[0] + c[2] + c[4]) / 3;
    centre[1] = (c[1] + c[3] + c[5]) / 3;
}

double oz_triangle_set_joint_length(const OzTriangleSet *triangle_set, int joint)
{
    double a[2], b[2];
    centre_of(triangle_set, triangle_set->joint[2 * joint], a);
    centre_of(triangle_set, triangle_set->joint[2 * joint + 1], b);
    return hypot(b[0] - a[0], b[1] - a[1]);
}

static void measure(OzTriangleSet *triangle_set)
{
    triangle_set->area = triangle_set->reach = 0;
    for (int t = 0; t < triangle_set->triangle_count; t++) {
        triangle_set->area += oz_triangle_set_area(triangle_set, t);
    }
    for (int v = 0; v < triangle_set->vertex_count; v++) {
        triangle_set->reach = fmax(triangle_set->reach, hypot(triangle_set->vertex[2 * v],
                                                              triangle_set->vertex[2 * v + 1]));
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

static void turn_triangles(OzTriangleSet *triangle_set)
{
    for (int t = 0; t < triangle_set->triangle_count; t++) {
        int *corner = triangle_set->triangle + 3 * t, second = corner[1];
        if (signed_area(triangle_set, t) < 0) {
            corner[1] = corner[2];
            corner[2] = second;
        }
    }
}

static void list_edges(const OzTriangleSet *triangle_set, Edge *edges)
{
    for (int i = 0; i < 3 * triangle_set->triangle_count; i++) {
        int t = i / 3, side = i % 3;
        int a = triangle_set->triangle[i], b = triangle_set->triangle[3 * t + (side + 1) % 3];
        edges[i] = (Edge){a < b ? a : b, a < b ? b : a, t, side};
    }
}

/* Equal neighbours in the sorted list share an edge; an edge alone lies outside. */
static void match_edges(OzTriangleSet *triangle_set, const Edge *edges, int count)
{
    for (int i = 0; i < count; i++) {
        const Edge *edge = &edges[i], *next = edge + 1;
        if (i + 1 < count && edge->low == next->low && edge->high == next->high) {
            int *joint = triangle_set->joint + 2 * triangle_set->joint_count++;
            joint[0] = edge->triangle;
            joint[1] = next->triangle;
            i++;
        } else {
            int *outline = triangle_set->outline + 2 * triangle_set->outline_count++;
            outline[0] = edge->triangle;
            outline[1] = edge->side;
        }
    }
}

OzStatus oz_triangle_set_join(OzTriangleSet *triangle_set)
{
    OzStatus status = OZ_OK;
    Edge *edges = NULL;
    int count = 3 * triangle_set->triangle_count;
    OZ_TRY(OZ_NEW(&edges, count));
    OZ_TRY(OZ_NEW(&triangle_set->joint, 2 * (size_t)count));
    OZ_TRY(OZ_NEW(&triangle_set->outline, 2 * (size_t)count));
    turn_triangles(triangle_set);
    list_edges(triangle_set, edges);
    qsort(edges, (size_t)count, sizeof *edges, compare_edges);
    match_edges(triangle_set, edges, count);
    qsort(triangle_set->joint, (size_t)triangle_set->joint_count, 2 * sizeof(int), compare_pairs);
    qsort(triangle_set->outline, (size_t)triangle_set->outline_count, 2 * sizeof(int),
          compare_pairs);
    measure(triangle_set);
done:
    free(edges);
    return status;
}

void oz_triangle_set_centre(OzTriangleSet *triangle_set)
{
    double sum[2] = {0, 0}, centre[2];
    for (int t = 0; t < triangle_set->triangle_count; t++) {
        centre_of(triangle_set, t, centre);
        sum[0] += oz_triangle_set_area(triangle_set, t) * centre[0] / triangle_set->area;
        sum[1] += oz_triangle_set_area(triangle_set, t) * centre[1] / triangle_set->area;
    }
    for (int v = 0; v < triangle_set->vertex_count; v++) {
        triangle_set->vertex[2 * v] -= sum[0];
        triangle_set->vertex[2 * v + 1] -= sum[1];
    }
    measure(triangle_set);
}

OzStatus oz_triangle_set_copy(OzTriangleSet *copy, const OzTriangleSet *triangle_set)
{
    OzStatus status = OZ_OK;
    OzTriangleSet made = *triangle_set;
    made.vertex = NULL;
    made.triangle = made.joint = made.outline = NULL;
    OZ_TRY(OZ_NEW(&made.vertex, 2 * (size_t)triangle_set->vertex_count));
    OZ_TRY(OZ_NEW(&made.triangle, 3 * (size_t)triangle_set->triangle_count));
    OZ_TRY(OZ_NEW(&made.joint, 2 * (size_t)triangle_set->joint_count));
    OZ_TRY(OZ_NEW(&made.outline, 2 * (size_t)triangle_set->outline_count));
    if (triangle_set->triangle_count) {
        memcpy(made.vertex, triangle_set->vertex,
               2 * (size_t)triangle_set->vertex_count * sizeof(double));
        memcpy(made.triangle, triangle_set->triangle,
               3 * (size_t)triangle_set->triangle_count * sizeof(int));
        memcpy(made.joint, triangle_set->joint,
               2 * (size_t)triangle_set->joint_count * sizeof(int));
        memcpy(made.outline, triangle_set->outline,
               2 * (size_t)triangle_set->outline_count * sizeof(int));
    }
    *copy = made;
    made = (OzTriangleSet){0};
done:
    oz_triangle_set_free(&made);
    return status;
}
