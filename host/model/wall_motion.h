/* Whether a wall is there at a time, and where those of trigrains are: bodies of elements that move
 * as a whole, up and down or about their point. */
#pragma once

#include "model/elements.h"
#include "scene/scene.h"

#include <stdbool.h>

typedef struct OzWallPose {
    double rise, speed;            /* m, m/s along y                           */
    double turn, angular_velocity; /* rad, rad/s about the wall's point at rest */
} OzWallPose;

/* Whether the wall has come and not been taken away yet; at rest (while settling) all are there
 * that do not come later. */
bool oz_wall_motion_present(const OzWall *wall, double time, bool at_rest);

/* At rest: where it was built, without speed. */
OzWallPose oz_wall_motion_pose(const OzWall *wall, double time, bool at_rest);

/* Writes position (2 x), angle, velocity (2 x) and spin of every wall's elements into arrays over
 * all elements; the entries of grains' elements are left alone. A wall that has been taken away
 * keeps its last pose. */
void oz_wall_motion_place(const OzElements *elements, const OzScene *scene, double time,
                          bool at_rest, double *position, double *angle, double *velocity,
                          double *angular_velocity);
