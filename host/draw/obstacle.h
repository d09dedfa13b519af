/* The picture of an obstacle, a wall that grains go around: a ball or a cylinder as an opaque grey
 * body, shaded as grains are. */
#pragma once

#include "draw/mesh.h"
#include "model/snapshot.h"

/* Where its parts go, borrowed. */
typedef struct OzObstacle {
    const OzSnapshot *snapshot;
    const OzLook *look; /* endless cylinders end where its picture does */
    const OzCamera *camera;
    OzMesh *solid, *lines; /* the body, and lines along its outline and its edges */
    double line_width;     /* pixels                                              */
    double top;            /* m: the walls are drawn up to here                   */
    bool is_cut;           /* what lies before the look's cut is left out         */
} OzObstacle;

/* Whether it is one. */
bool oz_obstacle_is(const OzWall *wall);

/* Adds wall w of the scene where it is now, as far as it is on the free side of planes and boxes.
 */
void oz_obstacle_add(const OzObstacle *obstacle, int w);
