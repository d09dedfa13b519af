/* The picture of walls that are neither planes nor upright cylinders: a box's edges, a cylinder's
 * rings and staves, which show how it turns; of others level lines (draw/wall_levels.h). */
#pragma once

#include "draw/mesh.h"
#include "model/snapshot.h"

typedef struct OzWallOutline {
    const OzSnapshot *snapshot; /* borrowed, like the camera                            */
    const OzCamera *camera;
    double line_width; /* pixels                                               */
    double low, high;  /* m: walls known by their distance alone have level lines between */
    double reach;      /* m: endless cylinders are drawn so far to either side */
    bool is_cut;       /* what lies before y = cut is left out                 */
    double cut;        /* m                                                    */
} OzWallOutline;

/* Adds the lines of wall w of the scene where it is now: those behind the grains and those before
 * them; a sheet has its own (draw/wall_sheet.h). */
void oz_wall_outline_add(const OzWallOutline *outline, int w, OzMesh *behind, OzMesh *before,
                         const float rgba[4]);

/* Adds the edges of the scene's periodic cell; along open directions it is as long as the picture.
 */
void oz_wall_outline_add_cell(const OzWallOutline *outline, OzMesh *behind, OzMesh *before,
                              const float rgba[4]);
