/* Shapes of rods' walls. */
#include "scene/wall_shape.h"

#define OZ_WALL_KINDS (-1)

#include "kernels/wall.h"

static void shape_plane(OzWallShape *shape, const OzWall *wall)
{
    for (int c = 0; c < 3; c++) {
        shape->point[c] = wall->point[c];
        shape->normal[c] = wall->normal[c];
    }
}

static void shape_cylinder(OzWallShape *shape, const OzWall *wall)
{
    shape->radius = wall->diameter / 2;
}

OzWallShape oz_wall_shape_of(const OzWall *wall)
{
#define ROW(NAME, name, choice, fine) [OZ_WALL_##NAME] = shape_##name,
    static void (*const shapes[OZ_WALLS_END])(OzWallShape * shape,
                                              const OzWall *wall) = {OZ_WALLS(ROW)};
#undef ROW
    OzWallShape shape = {.kind = wall->kind};
    if (shapes[wall->kind]) {
        shapes[wall->kind](&shape, wall);
    }
    return shape;
}

double oz_wall_shape_distance(const OzWall *wall, double offset, const double point[3],
                              double normal[3])
{
    OzWallShape shape = oz_wall_shape_of(wall);
    OzVec3 from = oz_vec3(point[0] - shape.point[0], point[1] - shape.point[1],
                          point[2] - (shape.point[2] + offset));
    OzWallDistance at = oz_wall_distance(from, shape);
    if (normal) {
        normal[0] = at.normal.x;
        normal[1] = at.normal.y;
        normal[2] = at.normal.z;
    }
    return at.distance;
}
