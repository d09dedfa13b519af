/* The picture of a wall of which nothing but its distance is known: level lines on its surface. */
#pragma once

#include "draw/mesh.h"
#include "scene/scene.h"

typedef struct OzWallLevels {
    const OzWall *wall; /* borrowed, like the camera            */
    double offset;      /* m, by which the wall has moved up    */
    const OzCamera *camera;
    double low, high;  /* m, between which levels lie          */
    double line_width; /* pixels                               */
    bool is_cut;       /* the half before the axis is left out */
} OzWallLevels;

/* Adds lines where horizontal rays from above or below the wall's point leave its free side: so
 * walls are seen that surround that point. Parts farther away than the picture is large are left
 * out. */
void oz_wall_levels_add(const OzWallLevels *levels, OzMesh *behind, OzMesh *before,
                        const float rgba[4]);
