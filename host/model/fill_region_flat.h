/* Where trigrains are put at random: what the scene's container leaves free, filled from below. */
#pragma once

#include "base/random.h"
#include "model/triangle_set.h"
#include "scene/scene.h"

#include <stdbool.h>

typedef struct OzFillRegionFlat {
    const OzWall *container; /* borrowed: the hopper or drum, else the vessel, else the floor that
                                comes first in the scene; NULL: none                        */
    const OzTriangleSet *walls; /* borrowed: of every wall                                     */
    int wall_count;
    double low[2], high[2]; /* m, the box that is drawn from                               */
} OzFillRegionFlat;

/* A region of at least area (m^2) and room for circles of radius reach (m). Without a container: on
 * the segments when there are any, else a square about the origin. */
OzFillRegionFlat oz_fill_region_flat_make(const OzScene *scene, const OzTriangleSet *walls,
                                          double area, double reach);

/* Makes the region a tenth higher. False for a drum, which has no room above. */
bool oz_fill_region_flat_raise(OzFillRegionFlat *fill_region);

/* A point of the box. */
void oz_fill_region_flat_draw(const OzFillRegionFlat *fill_region, OzRandom *random,
                              double point[2]);

/* True when a circle lies inside the container and touches no wall. */
bool oz_fill_region_flat_holds(const OzFillRegionFlat *fill_region, const double centre[2],
                               double radius);
