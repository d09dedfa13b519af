/* The picture of a thin sheet: a rectangle, a disc, a cone or an open tube, as glass with its edges
 * as lines. What lies before the grains, as far as a sheet can say, is drawn after them. */
#pragma once

#include "draw/mesh.h"
#include "model/snapshot.h"

/* Where its parts go, borrowed. */
typedef struct OzWallSheet {
    const OzSnapshot *snapshot;
    const OzCamera *camera;
    OzMesh *behind, *before;
    double line_width; /* pixels                             */
    double reach;      /* m: endless tubes reach so far to either side */
    bool is_cut;       /* what lies before y = cut is left out */
    double cut;        /* m                                  */
} OzWallSheet;

/* Adds wall w of the scene where it is now; of a box, and of a cylinder or ball that holds grains,
 * the glass without lines; of other walls nothing. */
void oz_wall_sheet_add(const OzWallSheet *sheet, int w);
