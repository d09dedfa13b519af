/* Walls that come and go. */
#include "sim/gates.h"

#include "model/wall_motion.h"

bool oz_gates_has(const OzWall *wall)
{
    return wall->since > 0 || wall->until > 0;
}

int oz_gates_bits(const OzWall *wall, const double times[3], bool at_rest)
{
    bool was = oz_wall_motion_present(wall, times[0], at_rest);
    bool is = oz_wall_motion_present(wall, times[1], at_rest);
    bool will_be = oz_wall_motion_present(wall, times[2], at_rest);
    return is ? (was ? 0 : OZ_GATE_COMES) | (will_be ? 0 : OZ_GATE_GOES) : OZ_GATE_GONE;
}

void oz_gates_set(OzPhysics *physics, const OzScene *scene, double time, bool at_rest)
{
    for (int k = 0; k < physics->wall_count; k++) {
        const OzWall *wall = &scene->walls[physics->wall_order[k]];
        physics->parameters.wall[k].shape.gone = !oz_wall_motion_present(wall, time, at_rest);
    }
}
