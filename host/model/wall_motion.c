/* Rigid motion of walls. */
#include "model/wall_motion.h"

#include "model/motion.h"

#include <math.h>

/* A step that lies there to rounding lies there: steps are told apart up to the thousand-millionth.
 */
static bool has_reached(double time, double mark)
{
    const double rounding = 1e-12;
    return time >= mark * (1 - rounding);
}

bool oz_wall_motion_present(const OzWall *wall, double time, bool at_rest)
{
    bool has_come = wall->since <= 0 || (!at_rest && has_reached(time, wall->since));
    return has_come && (at_rest || wall->until <= 0 || !has_reached(time, wall->until));
}

OzWallPose oz_wall_motion_pose(const OzWall *wall, double time, bool at_rest)
{
    const OzMotion *motion = &wall->motion;
    OzWallPose pose = {0};
    if (motion->present && !at_rest) {
        oz_motion_offset(motion, time, &pose.rise, &pose.speed);
        pose.turn = oz_motion_turn(motion, time);
        pose.angular_velocity = oz_motion_rate(motion, time);
    }
    return pose;
}

void oz_wall_motion_place(const OzElements *elements, const OzScene *scene, double time,
                          bool at_rest, double *position, double *angle, double *velocity,
                          double *angular_velocity)
{
    for (int64_t i = elements->free_count; i < elements->count; i++) {
        const OzWall *wall = &scene->walls[elements->body[i] - elements->grain_count];
        OzWallPose pose = oz_wall_motion_pose(wall, time, at_rest);
        double c = cos(pose.turn), s = sin(pose.turn);
        double x = elements->position[2 * i] - wall->point[0];
        double y = elements->position[2 * i + 1] - wall->point[1];
        double turned_x = c * x - s * y, turned_y = s * x + c * y;
        position[2 * i] = wall->point[0] + turned_x;
        position[2 * i + 1] = wall->point[1] + turned_y + pose.rise;
        angle[i] = elements->angle[i] + pose.turn;
        velocity[2 * i] = -pose.angular_velocity * turned_y;
        velocity[2 * i + 1] = pose.angular_velocity * turned_x + pose.speed;
        angular_velocity[i] = pose.angular_velocity;
    }
}
