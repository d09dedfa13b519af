/* Points and polygons that are gathered for a .vtp file, each polygon with its owner's number. */
#pragma once

#include "model/snapshot.h"

/* Zeroed is empty; frees with oz_surface_free. */
typedef struct OzSurface {
    float *points; /* 3 x point_count */
    int64_t point_count, point_capacity;
    int64_t *corners; /* of all polygons, one after the other: numbers of points */
    int64_t corner_count, corner_capacity;
    int64_t *ends;  /* cell_count: corners of all polygons up to this one */
    int64_t *owner; /* cell_count: a grain or a wall                      */
    int64_t cell_count, cell_capacity;
} OzSurface;

/* Adds the triangles and discs (as polygons) of flat grains, as they are now. Fails with
 * OZ_ERR_MEMORY. */
OzStatus oz_surface_add_flat_grains(OzSurface *surface, const OzSnapshot *now);

/* Adds the walls that are there now. Endless ones are cut to what encloses the grains now. */
OzStatus oz_surface_add_walls(OzSurface *surface, const OzSnapshot *now);

void oz_surface_free(OzSurface *surface);
