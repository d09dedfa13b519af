/* Deriving what the host's physics needs from a scene. */
#include "sim/physics.h"

#include "kernels/integrators.h"
#include "sim/sides.h"

static const double shares[] = {
#define SHARE(NAME, name, choice, flat_choice, share, first) [OZ_INTEGRATOR_##NAME] = share,
    OZ_INTEGRATORS(SHARE)
#undef SHARE
};

OzStatus oz_physics_derive(OzPhysics *physics, const OzScene *scene, const OzGrains *grains)
{
    OzScene in_double = *scene;
    OzDevice none = {
        .float_lanes = 1, .double_lanes = 1, .group = 1, .small_most = OZ_DEVICE_SMALL_MOST};
    in_double.precision = OZ_PRECISION_DOUBLE;
    physics->switches = oz_switches_derive(&in_double, grains, &none);
    physics->wall_count = physics->switches.walls;
    physics->edged = physics->switches.edged;
    physics->meshes = physics->switches.meshes;
    physics->ends = physics->switches.round ? 1 : 2;
    physics->touches = physics->ends * physics->wall_count;
    physics->touches += physics->switches.round ? 0 : 2 * physics->edged;
    physics->touches += OZ_MESH_SLOTS * physics->meshes;
    physics->share = shares[scene->integrator];
    OZ_PASS(oz_constants_fill(&physics->parameters, physics->wall_order, &in_double, grains));
    physics->scene = scene;
    physics->grains = grains;
    oz_law_table_fill(physics->law_table, scene, physics->wall_order, physics->wall_count);
    for (int k = 0; k < OZ_WALLS_MAX; k++) {
        bool is_there = k < physics->wall_count;
        physics->mesh[k] = is_there ? scene->walls[physics->wall_order[k]].mesh : NULL;
        physics->swing[k] = (OzWallSwing){.frame = {1, 0, 0, 0, 1, 0, 0, 0, 1}};
    }
    return OZ_OK;
}
