/* Shapes of rods' walls. */
#include "scene/wall_shape.h"

#include "scene/wall_mesh.h"

#include <math.h>
#include <string.h>

#define OZ_WALL_KINDS      0x3fffffff /* the host knows them all */
#define OZ_WALL_KINDS_MORE 0x3fffffff
#define OZ_MESHES          0
#define OZ_GATED           0 /* where a wall is, whether there or not */

#include "kernels/wall.h"

static void shape_plane(OzWallShape *shape, const OzWall *wall)
{
    for (int c = 0; c < 3; c++) {
        shape->point[c] = wall->point[c];
        shape->normal[c] = wall->normal[c];
    }
}

void oz_wall_shape_axis(const OzWall *wall, double axis[3])
{
    bool is_told = wall->axis[0] != 0 || wall->axis[1] != 0 || wall->axis[2] != 0;
    for (int c = 0; c < 3; c++) {
        axis[c] = is_told ? wall->axis[c] : c == 2;
    }
}

void oz_wall_shape_across(const double normal[3], double u[3], double v[3])
{
    int least = fabs(normal[0]) < fabs(normal[1]) ? 0 : 1;
    least = fabs(normal[2]) < fabs(normal[least]) ? 2 : least;
    double length = sqrt(1 - normal[least] * normal[least]);
    for (int k = 0; k < 3; k++) {
        u[k] = ((k == least) - normal[least] * normal[k]) / length;
    }
    for (int k = 0; k < 3; k++) {
        int a = (k + 1) % 3, b = (k + 2) % 3;
        v[k] = normal[a] * u[b] - normal[b] * u[a];
    }
}

static void shape_tube(OzWallShape *shape, const OzWall *wall)
{
    oz_wall_shape_axis(wall, shape->normal);
    for (int c = 0; c < 3; c++) {
        shape->point[c] = wall->point[c];
    }
    shape->radius = wall->diameter / 2;
    shape->side = wall->side == OZ_SIDE_OUTSIDE ? -1 : 1;
}

static void copy(double to[3], const double from[3])
{
    memcpy(to, from, 3 * sizeof *to);
}

static void shape_rectangle(OzWallShape *shape, const OzWall *wall)
{
    copy(shape->point, wall->point);
    copy(shape->normal, wall->normal);
    copy(shape->across, wall->edge);
    for (int c = 0; c < 2; c++) {
        shape->extent[c] = wall->size[c] / 2;
    }
}

/* An open cylinder. */
static void shape_band(OzWallShape *shape, const OzWall *wall)
{
    double v[3];
    shape->kind = OZ_WALL_BAND;
    copy(shape->point, wall->point);
    oz_wall_shape_axis(wall, shape->normal);
    oz_wall_shape_across(shape->normal, shape->across, v);
    shape->radius = shape->extent[0] = wall->diameter / 2;
    shape->extent[1] = wall->length;
}

/* A round wall with rods outside. */
static void shape_obstacle(OzWallShape *shape, const OzWall *wall)
{
    shape_tube(shape, wall);
    shape->kind = OZ_WALL_OBSTACLE;
    for (int c = 0; c < 3 && wall->kind == OZ_WALL_SPHERE; c++) {
        shape->normal[c] = 0;
    }
}

static void shape_solid(OzWallShape *shape, const OzWall *wall)
{
    shape_band(shape, wall);
    shape->kind = OZ_WALL_SOLID;
}

static void shape_cylinder(OzWallShape *shape, const OzWall *wall)
{
    if (wall->length > 0 && wall->ends == OZ_ENDS_OPEN) {
        shape_band(shape, wall);
    } else if (wall->length > 0 && wall->side == OZ_SIDE_OUTSIDE) {
        shape_solid(shape, wall);
    } else if (oz_wall_shape_is_upright(wall)) {
        shape->radius = wall->diameter / 2;
        oz_wall_shape_axis(wall, shape->normal);
    } else if (wall->meets_rods && wall->side == OZ_SIDE_OUTSIDE) {
        shape_obstacle(shape, wall);
    } else {
        shape->kind = OZ_WALL_TUBE;
        shape_tube(shape, wall);
    }
}

static void shape_sphere(OzWallShape *shape, const OzWall *wall)
{
    if (wall->meets_rods && wall->side == OZ_SIDE_OUTSIDE) {
        shape_obstacle(shape, wall);
        return;
    }
    copy(shape->point, wall->point);
    shape->radius = wall->diameter / 2;
    shape->side = wall->side == OZ_SIDE_OUTSIDE ? -1 : 1;
}

static void shape_mesh(OzWallShape *shape, const OzWall *wall)
{
    copy(shape->point, wall->point);
    shape->radius = wall->mesh ? wall->mesh->reach : 0;
}

/* A plane through a point that lies `along` from another one, in the direction of normal. */
static OzWallShape plane(const double point[3], double along, const double normal[3], double sign)
{
    OzWallShape shape = {.kind = OZ_WALL_PLANE};
    for (int c = 0; c < 3; c++) {
        shape.point[c] = point[c] + along * normal[c];
        shape.normal[c] = sign * normal[c];
    }
    return shape;
}

static int sides_box(OzWallShape *sides, const OzWall *wall)
{
    for (int k = 0; k < 3; k++) {
        const double axis[3] = {k == 0, k == 1, k == 2};
        double low = k == 2 ? 0 : -wall->size[k] / 2;
        sides[2 * k] = plane(wall->point, low, axis, 1);
        sides[2 * k + 1] = plane(wall->point, low + wall->size[k], axis, -1);
    }
    return 6;
}

static int sides_disc(OzWallShape *sides, const OzWall *wall)
{
    double v[3];
    sides[0] = (OzWallShape){.kind = OZ_WALL_BAND, .extent = {wall->diameter / 2, 0}};
    copy(sides[0].point, wall->point);
    copy(sides[0].normal, wall->normal);
    oz_wall_shape_across(wall->normal, sides[0].across, v);
    return 1;
}

static int sides_cone(OzWallShape *sides, const OzWall *wall)
{
    sides[0] = (OzWallShape){.radius = 0};
    shape_band(&sides[0], wall);
    sides[0].radius = wall->diameters[0] / 2;
    sides[0].extent[0] = wall->diameters[1] / 2;
    return 1;
}

bool oz_wall_shape_is_upright(const OzWall *wall)
{
    double axis[3];
    oz_wall_shape_axis(wall, axis);
    return wall->kind == OZ_WALL_CYLINDER && wall->side == OZ_SIDE_INSIDE && fabs(axis[2]) == 1 &&
           wall->point[0] == 0 && wall->point[1] == 0 &&
           !(wall->length > 0 && wall->ends == OZ_ENDS_OPEN);
}

void oz_wall_shape_meet(OzScene *scene)
{
    bool has_rods = false;
    for (int i = 0; i < scene->population_count; i++) {
        const OzPopulation *grains = &scene->populations[i];
        has_rods |= grains->kind == OZ_GRAINS_FILE || grains->aspect.high > 0;
    }
    for (int w = 0; w < scene->wall_count; w++) {
        scene->walls[w].meets_rods = has_rods;
    }
}

/* The one side of a wall that is no compound of several. */
static int shape_of(OzWallShape *side, const OzWall *wall)
{
#define ROW(NAME, name, choice, fine, edged) [OZ_WALL_##NAME] = shape_##name,
    static void (*const shapes[OZ_WALLS_END])(OzWallShape * shape,
                                              const OzWall *wall) = {OZ_WALLS(ROW)};
#undef ROW
    *side = (OzWallShape){.kind = wall->kind};
    if (!shapes[wall->kind]) {
        return 0;
    }
    shapes[wall->kind](side, wall);
    return 1;
}

int oz_wall_shape_sides(const OzWall *wall, OzWallShape sides[OZ_WALL_SIDES_MAX])
{
#define ROW(NAME, name, choice) [OZ_WALL_##NAME] = sides_##name,
    static int (*const compounds[OZ_WALLS_END])(OzWallShape * sides,
                                                const OzWall *wall) = {OZ_COMPOUND_WALLS(ROW)};
#undef ROW
    if (compounds[wall->kind]) {
        return compounds[wall->kind](sides, wall);
    }
    int count = shape_of(sides, wall);
    if (count > 0 && wall->length > 0 && wall->ends == OZ_ENDS_CLOSED &&
        sides[0].kind != OZ_WALL_SOLID) {
        sides[count++] = plane(wall->point, 0, wall->axis, 1);
        sides[count++] = plane(wall->point, wall->length, wall->axis, -1);
    }
    return count;
}

void oz_wall_shape_shift(const OzWall *wall, double offset, double shift[3])
{
    const double *direction = wall->servo.present ? wall->normal : wall->motion.direction;
    bool is_told = direction[0] != 0 || direction[1] != 0 || direction[2] != 0;
    for (int c = 0; c < 3; c++) {
        shift[c] = offset * (is_told ? direction[c] : c == 2);
    }
}

double oz_wall_shape_side_distance(const OzWallShape *side, const double shift[3],
                                   const double point[3], double normal[3])
{
    OzVec3 from =
        oz_vec3(point[0] - (side->point[0] + shift[0]), point[1] - (side->point[1] + shift[1]),
                point[2] - (side->point[2] + shift[2]));
    OzWallDistance at = oz_wall_distance(from, *side);
    if (normal) {
        normal[0] = at.normal.x;
        normal[1] = at.normal.y;
        normal[2] = at.normal.z;
    }
    return at.distance;
}

double oz_wall_shape_distance(const OzWall *wall, double offset, const double point[3],
                              double normal[3])
{
    OzWallShape sides[OZ_WALL_SIDES_MAX];
    int count = oz_wall_shape_sides(wall, sides), nearest = 0;
    double least = INFINITY, shift[3];
    oz_wall_shape_shift(wall, offset, shift);
    if (wall->mesh) {
        double from[3];
        for (int c = 0; c < 3; c++) {
            from[c] = point[c] - wall->point[c] - shift[c];
        }
        return oz_wall_mesh_distance(wall->mesh, from, normal);
    }
    for (int k = 0; k < count; k++) {
        double distance = oz_wall_shape_side_distance(&sides[k], shift, point, NULL);
        nearest = distance < least ? k : nearest;
        least = fmin(distance, least);
    }
    return count > 0 ? oz_wall_shape_side_distance(&sides[nearest], shift, point, normal) : least;
}

static int edged(const OzWallShape *side)
{
#define ROW(NAME, name, choice, fine, edged) [OZ_WALL_##NAME] = edged,
    static const int is_edged[OZ_WALLS_END] = {OZ_WALLS(ROW)};
#undef ROW
    return is_edged[(int)side->kind];
}

bool oz_wall_shape_is_edged(const OzWallShape *side)
{
    return edged(side) > 0;
}

bool oz_wall_shape_is_sheet(const OzWall *wall)
{
    OzWallShape sides[OZ_WALL_SIDES_MAX];
    bool is_sheet = oz_wall_shape_sides(wall, sides) > 0 && edged(&sides[0]) == 1;
    return is_sheet || wall->kind == OZ_WALL_MESH;
}
