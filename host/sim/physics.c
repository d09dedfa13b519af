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
    OzWallSide sides[OZ_WALLS_MAX];
    physics->wall_count = oz_sides_list(sides, scene);
    physics->edged = 0;
    for (int k = 0; k < physics->wall_count && k < OZ_WALLS_MAX; k++) {
        physics->edged += oz_wall_shape_is_edged(&sides[k].shape);
    }
    physics->ends = physics->switches.round ? 1 : 2;
    physics->share = shares[scene->integrator];
    return oz_constants_fill(&physics->parameters, physics->wall_order, &in_double, grains);
}
