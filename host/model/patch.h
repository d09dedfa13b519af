/* The triangles that one body is made of, or its disc, in the body's own frame: what shapes and
 * walls are before they become pieces. */
#pragma once

#include "base/status.h"

#include <stdbool.h>

typedef struct OzPatch {
    int vertex_count, triangle_count, joint_count, outline_count;
    double *vertex; /* 2 x vertex_count: m, x y                                             */
    int *triangle;  /* 3 x triangle_count: vertices, counter-clockwise after joining        */
    int *joint;     /* 2 x joint_count: triangles that share an edge, the lower one first;
                       ordered by the first, then by the second                             */
    int *outline;   /* 2 x outline_count: triangle and its edge 0..2 that no other shares   */
    double area;    /* m^2                                                                  */
    double reach;   /* m, from the origin to the farthest point                             */
    double radius;  /* m, of a disc about the origin, which has no triangles; else 0        */
} OzPatch;

/* Room for vertices and triangles, zeroed; the caller fills them in and frees with oz_patch_free.
 */
OzStatus oz_patch_create(OzPatch *patch, int vertex_count, int triangle_count);
void oz_patch_free(OzPatch *patch); /* a zeroed patch is fine */

/* A disc needs no more than this. */
void oz_patch_set_disc(OzPatch *patch, double radius);

/* Turns all triangles counter-clockwise, finds joints, outline, area and reach. */
OzStatus oz_patch_join(OzPatch *patch);

/* Moves the origin to the centre of mass. */
void oz_patch_centre(OzPatch *patch);

/* A copy of its own. */
OzStatus oz_patch_copy(OzPatch *copy, const OzPatch *patch);

/* A triangle's corners (x y) and area, m^2. */
void oz_patch_corners(const OzPatch *patch, int triangle, double corners[6]);
double oz_patch_area(const OzPatch *patch, int triangle);

/* The centres' distance of two joined triangles, m: a beam's length. */
double oz_patch_joint_length(const OzPatch *patch, int joint);
