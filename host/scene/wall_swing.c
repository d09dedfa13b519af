/* Turned walls, by Rodrigues' formula. */
#include "scene/wall_swing.h"

#include "scene/wall_mesh.h"

#include <math.h>
#include <string.h>

bool oz_wall_swing_has(const OzWall *wall)
{
    const OzMotion *motion = &wall->motion;
    bool is_told = motion->has_axis || motion->has_point;
    bool keeps_shape = wall->kind == OZ_WALL_DISC || wall->kind == OZ_WALL_PLANE;
    bool is_free = wall->kind == OZ_WALL_MESH || wall->kind == OZ_WALL_RECTANGLE ||
                   wall->kind == OZ_WALL_BOX || (keeps_shape && is_told);
    bool turns = motion->has_turning || motion->angular_velocity != 0 || motion->turned != 0;
    return is_free && motion->present && turns;
}

bool oz_wall_swing_tilts(const OzWall *wall)
{
    const double *a = wall->motion.axis, *n = wall->normal;
    double along = fabs(a[0] * n[0] + a[1] * n[1] + a[2] * n[2]);
    return wall->kind == OZ_WALL_PLANE && oz_wall_swing_has(wall) && along < 1 - 1e-12;
}

static void cross(const double a[3], const double b[3], double to[3])
{
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;
        to[k] = a[i] * b[j] - a[j] * b[i];
    }
}

/* What takes a direction to where it is after a turn about a unit vector. */
static void make_frame(double frame[9], const double axis[3], double angle)
{
    double c = cos(angle), s = sin(angle);
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 3; column++) {
            double about = 0;
            if (row != column) {
                double sign = (column - row + 3) % 3 == 1 ? -1 : 1;
                about = sign * axis[3 - row - column];
            }
            frame[3 * row + column] =
                c * (row == column) + (1 - c) * axis[row] * axis[column] + s * about;
        }
    }
}

OzWallSwing oz_wall_swing_side(const OzWall *wall, const double point[3], double angle, double rate)
{
    const OzMotion *motion = &wall->motion;
    OzWallSwing swing = {.frame = {1, 0, 0, 0, 1, 0, 0, 0, 1}};
    double arm[3], now[3], home[3];
    if (!oz_wall_swing_has(wall)) {
        return swing;
    }
    for (int k = 0; k < 3; k++) {
        arm[k] = point[k] - (motion->has_point ? motion->point[k] : wall->point[k]);
        home[k] = wall->point[k] - point[k];
    }
    make_frame(swing.frame, motion->axis, angle);
    memcpy(now, arm, sizeof now);
    oz_wall_swing_turn(swing.frame, now);
    oz_wall_swing_turn(swing.frame, home);
    memcpy(swing.home, home, sizeof home);
    cross(motion->axis, now, swing.lead);
    for (int k = 0; k < 3; k++) {
        swing.away[k] = now[k] - arm[k];
        swing.lead[k] *= rate;
    }
    return swing;
}

OzWallSwing oz_wall_swing_at(const OzWall *wall, double angle, double rate)
{
    return oz_wall_swing_side(wall, wall->point, angle, rate);
}

OzWall oz_wall_swing_turned(const OzWall *wall, double angle)
{
    OzWall turned = *wall;
    OzWallSwing swing = oz_wall_swing_at(wall, angle, 0);
    oz_wall_swing_turn(swing.frame, turned.normal);
    oz_wall_swing_turn(swing.frame, turned.edge);
    for (int k = 0; k < 3; k++) {
        turned.point[k] += swing.away[k];
    }
    return turned;
}

/* The square of the distance from the axis of a place that is seen from the wall's point, m^2. */
static double square_from_axis(const OzWall *wall, const double place[3])
{
    const OzMotion *motion = &wall->motion;
    double from[3], across[3];
    for (int k = 0; k < 3; k++) {
        from[k] = place[k] + (motion->has_point ? wall->point[k] - motion->point[k] : 0);
    }
    cross(motion->axis, from, across);
    return across[0] * across[0] + across[1] * across[1] + across[2] * across[2];
}

static double rectangle_reach2(const OzWall *wall)
{
    double second[3], most = 0;
    cross(wall->normal, wall->edge, second);
    for (int corner = 0; corner < 4; corner++) {
        double place[3], one = corner & 1 ? 0.5 : -0.5, other = corner & 2 ? 0.5 : -0.5;
        for (int k = 0; k < 3; k++) {
            place[k] = one * wall->size[0] * wall->edge[k] + other * wall->size[1] * second[k];
        }
        most = fmax(most, square_from_axis(wall, place));
    }
    return most;
}

static double box_reach2(const OzWall *wall)
{
    double most = 0;
    for (int corner = 0; corner < 8; corner++) {
        double place[3];
        for (int k = 0; k < 3; k++) {
            double share = (corner >> k & 1) - (k == 2 ? 0 : 0.5);
            place[k] = share * wall->size[k];
        }
        most = fmax(most, square_from_axis(wall, place));
    }
    return most;
}

static double mesh_reach2(const OzWall *wall)
{
    double most = 0;
    for (int corner = 0; corner < 3 * wall->mesh->count; corner++) {
        most = fmax(most, square_from_axis(wall, wall->mesh->corners + 3 * (size_t)corner));
    }
    return most;
}

double oz_wall_swing_reach(const OzWall *wall)
{
    if (!oz_wall_swing_has(wall) || wall->kind == OZ_WALL_PLANE) {
        return 0;
    }
    if (wall->kind == OZ_WALL_BOX) {
        return sqrt(box_reach2(wall));
    }
    if (wall->kind == OZ_WALL_DISC) {
        const double middle[3] = {0};
        return sqrt(square_from_axis(wall, middle)) + wall->diameter / 2;
    }
    return sqrt(wall->mesh ? mesh_reach2(wall) : rectangle_reach2(wall));
}
