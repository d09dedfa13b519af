/* Walls that swing: each as its motion's angle says. */
#include "sim/swings.h"

#include "model/motion.h"
#include "scene/wall_swing.h"
#include "sim/dialect.h"
#include "sim/units.h"

/* The side of its wall that kernel wall w is: those of one wall come in their order. */
static OzWallShape side_of(const int *order, const OzWall *wall, int w)
{
    OzWallShape sides[OZ_WALL_SIDES_MAX];
    int side = 0;
    for (int k = 0; k < w; k++) {
        side += order[k] == order[w];
    }
    oz_wall_shape_sides(wall, sides);
    return sides[side];
}

static OzWallSwing swing_at(const OzWall *wall, const double point[3], double time, bool at_rest)
{
    if (at_rest) {
        return oz_wall_swing_side(wall, point, 0, 0);
    }
    return oz_wall_swing_side(wall, point, oz_motion_turn(&wall->motion, time),
                              oz_motion_rate(&wall->motion, time));
}

void oz_swings_set(OzPhysics *physics, const OzScene *scene, double time, bool at_rest)
{
    for (int k = 0; k < physics->wall_count; k++) {
        const OzWall *wall = &scene->walls[physics->wall_order[k]];
        OzWallShape *shape = &physics->parameters.wall[k].shape;
        if (oz_wall_swing_has(wall)) {
            OzWallShape side = side_of(physics->wall_order, wall, k);
            physics->swing[k] = swing_at(wall, side.point, time, at_rest);
            for (int c = 0; c < 3; c++) {
                shape->normal[c] = side.normal[c];
                shape->across[c] = side.across[c];
            }
            oz_wall_swing_turn(physics->swing[k].frame, shape->normal);
            oz_wall_swing_turn(physics->swing[k].frame, shape->across);
        }
    }
}

void oz_swings_drive(OzWallDrive *drive, const OzPhysics *physics, const OzScene *scene, int w,
                     double time, bool at_rest)
{
    const OzWall *wall = &scene->walls[physics->wall_order[w]];
    if (oz_wall_swing_has(wall)) {
        OzWallShape side = side_of(physics->wall_order, wall, w);
        OzWallSwing swing = swing_at(wall, side.point, time, at_rest);
        drive->away = oz_vec3(swing.away[0], swing.away[1], swing.away[2]);
        drive->lead = oz_vec3(swing.lead[0], swing.lead[1], swing.lead[2]);
    }
}

OzWallDrive oz_swings_drive_at(const OzPhysics *physics, const OzScene *scene, int w, double time)
{
    const OzWall *wall = &scene->walls[physics->wall_order[w]];
    double offset, speed;
    oz_motion_offset(&wall->motion, time, &offset, &speed);
    OzWallDrive drive =
        oz_dialect_drive(physics, w, offset, speed, oz_motion_rate(&wall->motion, time));
    oz_swings_drive(&drive, physics, scene, w, time, false);
    return drive;
}

void oz_swings_words(double words[OZ_SWING], const OzScene *scene, const int *order, int w,
                     double time, bool at_rest, const OzUnits *units)
{
    const OzWall *wall = &scene->walls[order[w]];
    OzWallSwing swing = swing_at(wall, side_of(order, wall, w).point, time, at_rest);
    for (int k = 0; k < 9; k++) {
        words[OZ_W_FRAME + k] = swing.frame[k];
    }
    for (int c = 0; c < 3; c++) {
        words[OZ_W_AWAY + c] = swing.away[c] / units->length;
        words[OZ_W_LEAD + c] = swing.lead[c] / oz_units_speed(units);
        words[OZ_W_HOME + c] = swing.home[c] / units->length;
    }
}
