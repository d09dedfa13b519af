/* Looking for the walls around a piston. */
#include "scene/servo_area.h"

#include "scene/boundary.h"
#include "scene/wall_shape.h"

#include <math.h>
#include <string.h>

/* Of a cosine: normals are unit vectors to rounding. */
static const double rounding = 1e-9;

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static bool is_along(const double *a, const double *b)
{
    return fabs(dot(a, b)) > 1 - rounding;
}

static bool is_across(const double *a, const double *b)
{
    return fabs(dot(a, b)) < rounding;
}

static void set_round(OzServoArea *area, double diameter)
{
    const double PI = 3.14159265358979323846;
    area->side[0] = PI / 4 * diameter;
    area->side[1] = diameter;
}

/* The narrowest cylinder along the normal. */
static bool find_cylinder(OzServoArea *area, const OzScene *scene, const double *normal)
{
    double least = INFINITY;
    for (int w = 0; w < scene->wall_count; w++) {
        const OzWall *wall = &scene->walls[w];
        double axis[3];
        oz_wall_shape_axis(wall, axis);
        if (wall->kind == OZ_WALL_CYLINDER && wall->side == OZ_SIDE_INSIDE &&
            is_along(axis, normal)) {
            least = fmin(least, wall->diameter);
        }
    }
    if (isfinite(least)) {
        set_round(area, least);
    }
    return isfinite(least);
}

/* The period along a direction; 0: space does not repeat itself there. */
static double period_along(const OzScene *scene, const double *direction)
{
    double period = 0;
    for (int k = 0; k < 3; k++) {
        bool along = fabs(direction[k]) > 1 - rounding;
        period = along ? oz_boundary_period(&scene->boundary, k) : period;
    }
    return period;
}

/* The way along a direction between the nearest planes that face each other there. */
static bool find_side(OzServoArea *area, int k, const OzScene *scene, const double *direction)
{
    double ends[2] = {-INFINITY, INFINITY}, period = period_along(scene, direction);
    for (int w = 0; w < scene->wall_count && period == 0; w++) {
        const OzWall *wall = &scene->walls[w];
        OzWallShape sides[OZ_WALL_SIDES_MAX];
        bool is_flat = wall->kind == OZ_WALL_PLANE || wall->kind == OZ_WALL_BOX;
        int count = is_flat ? oz_wall_shape_sides(wall, sides) : 0;
        for (int s = 0; s < count; s++) {
            double at = dot(sides[s].point, direction);
            bool is_low = dot(sides[s].normal, direction) > 0;
            if (is_along(sides[s].normal, direction) && (is_low ? at > ends[0] : at < ends[1])) {
                ends[is_low ? 0 : 1] = at;
                area->bound[k][is_low ? 0 : 1] = w;
            }
        }
    }
    area->side[k] = period > 0 ? period : ends[1] - ends[0];
    return area->side[k] > 0 && isfinite(area->side[k]);
}

static bool find_sides(OzServoArea *area, const OzScene *scene, const double *one,
                       const double *other)
{
    memset(area->bound, -1, sizeof area->bound);
    return find_side(area, 0, scene, one) && find_side(area, 1, scene, other);
}

bool oz_servo_area_find(OzServoArea *area, const OzScene *scene, int wall)
{
    const OzWall *piston = &scene->walls[wall];
    const double *n = piston->normal;
    double one[3], other[3];
    memset(area->bound, -1, sizeof area->bound);
    if (piston->kind == OZ_WALL_DISC) {
        set_round(area, piston->diameter);
        return true;
    }
    if (piston->kind == OZ_WALL_RECTANGLE) {
        memcpy(area->side, piston->size, sizeof area->side);
        return true;
    }
    if (find_cylinder(area, scene, n)) {
        return true;
    }
    oz_wall_shape_across(n, one, other);
    bool is_found = find_sides(area, scene, one, other);
    for (int w = 0; w < scene->wall_count && !is_found; w++) {
        const double *u = scene->walls[w].normal;
        if (scene->walls[w].kind == OZ_WALL_PLANE && is_across(u, n)) {
            double v[3] = {n[1] * u[2] - n[2] * u[1], n[2] * u[0] - n[0] * u[2],
                           n[0] * u[1] - n[1] * u[0]};
            is_found = find_sides(area, scene, u, v);
        }
    }
    return is_found;
}

double oz_servo_area_now(const OzServoArea *area, const OzScene *scene, const double *offsets)
{
    double product = 1;
    for (int k = 0; k < 2; k++) {
        double side = area->side[k];
        for (int end = 0; end < 2; end++) {
            int bound = area->bound[k][end];
            side -= bound >= 0 && scene->walls[bound].servo.present ? offsets[bound] : 0;
        }
        product *= side;
    }
    return product;
}
