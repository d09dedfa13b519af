/* What the edges of a mesh's triangles say of it. */
#pragma once

#include "base/status.h"

#include <stdbool.h>

typedef struct OzMeshEdges {
    bool closed; /* every edge is shared by two triangles that turn alike, or more pairs of them */
    double *creases; /* six numbers each, both ends of edges that have one triangle, or two that
                        fold there; owned by whoever asked */
    int crease_count;
} OzMeshEdges;

/* Of so many triangles, nine numbers each. */
OzStatus oz_mesh_edges_judge(OzMeshEdges *edges, const double *corners, int count);

/* The unit vector out of a triangle's front. */
void oz_mesh_edges_normal(const double corners[9], double normal[3]);
