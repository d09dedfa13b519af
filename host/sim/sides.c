/* Sides in the order of their kinds. */
#include "sim/sides.h"

int oz_sides_list(OzWallSide sides[OZ_WALLS_MAX], const OzScene *scene)
{
    int count = 0;
    for (int kind = 0; kind < OZ_WALLS_END; kind++) {
        for (int w = 0; w < scene->wall_count; w++) {
            OzWallShape own[OZ_WALL_SIDES_MAX];
            int owned = oz_wall_shape_sides(&scene->walls[w], own);
            for (int k = 0; k < owned; k++) {
                if ((int)own[k].kind == kind && count++ < OZ_WALLS_MAX) {
                    sides[count - 1] = (OzWallSide){w, own[k]};
                }
            }
        }
    }
    return count;
}

OzStatus oz_sides_check(const OzScene *scene)
{
    OzWallSide sides[OZ_WALLS_MAX];
    int count = oz_sides_list(sides, scene);
    return count <= OZ_WALLS_MAX ? OZ_OK
                                 : oz_status_fail(OZ_ERR_INPUT, "%s: walls of %d sides, at most %d",
                                                  scene->path, count, OZ_WALLS_MAX);
}
