/* The triangles that one body is made of, or its disc, in the body's own frame: what shapes and
 * walls are before they become elements. */
#pragma once

#include "base/status.h"

#include <stdbool.h>

typedef struct OzTriangleSet {
    int vertex_count, triangle_count, joint_count, outline_count;
    double *vertex; /* 2 x vertex_count: m, x y                                             */
    int *triangle;  /* 3 x triangle_count: vertices, counter-clockwise after joining        */
    int *joint;     /* 2 x joint_count: triangles that share an edge, the lower one first;
                       ordered by the first, then by the second                             */
    int *outline;   /* 2 x outline_count: triangle and its edge 0..2 that no other shares   */
    double area;    /* m^2                                                                  */
    double reach;   /* m, from the origin to the farthest point                             */
    double radius;  /* m, of a disc about the origin, which has no triangles; else 0        */
} OzTriangleSet;

/* Room for vertices and triangles, zeroed; the caller fills them in and frees with
 * oz_triangle_set_free.
 */
OzStatus oz_triangle_set_create(OzTriangleSet *triangle_set, int vertex_count, int triangle_count);
void oz_triangle_set_free(OzTriangleSet *triangle_set); /* a zeroed triangle set is fine */

/* A disc needs no more than this. */
void oz_triangle_set_set_disc(OzTriangleSet *triangle_set, double radius);

/* Turns all triangles counter-clockwise, finds joints, outline, area and reach. */
OzStatus oz_triangle_set_join(OzTriangleSet *triangle_set);

/* Moves the origin to the centre of mass. */
void oz_triangle_set_centre(OzTriangleSet *triangle_set);

/* A copy of its own. */
OzStatus oz_triangle_set_copy(OzTriangleSet *copy, const OzTriangleSet *triangle_set);

/* A triangle's corners (x y) and area, m^2. */
void oz_triangle_set_corners(const OzTriangleSet *triangle_set, int triangle, double corners[6]);
double oz_triangle_set_area(const OzTriangleSet *triangle_set, int triangle);

/* The centres' distance of two joined triangles, m: a beam's length. */
double oz_triangle_set_joint_length(const OzTriangleSet *triangle_set, int joint);
