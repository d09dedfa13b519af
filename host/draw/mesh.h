/* Coloured triangles and lines in view coordinates, gathered on the host. */
#pragma once

#include "draw/camera.h"

#include <stddef.h>

/* A corner of a coloured triangle, in view coordinates. */
typedef struct OzCorner {
    float place[3], rgba[4];
    float across[2]; /* pixels: from a line's middle, and half its width; else far from an edge */
} OzCorner;

/* Triangles, three corners each. status remembers that memory ran out. */
typedef struct OzMesh {
    OzCorner *corners;
    size_t count, capacity;
    OzStatus status;
} OzMesh;

void oz_mesh_clear(OzMesh *mesh); /* empties it for the next picture, keeping its memory */
void oz_mesh_free(OzMesh *mesh);  /* zeroed is fine */

void oz_mesh_corner(OzMesh *mesh, const double view[3], const float rgba[4]);

/* Corners in order around; the first pair has one colour, the second another. */
void oz_mesh_quad(OzMesh *mesh, double view[4][3], const float first_rgba[4],
                  const float second_rgba[4]);

/* A line between two points of the world, m, as wide as that many pixels, turned towards the eye.
 */
void oz_mesh_line(OzMesh *mesh, const OzCamera *camera, const double from[3], const double to[3],
                  double width, const float rgba[4]);
