/* Deriving trigrains' switches from a scene. */
#include "sim/element_switches.h"

static bool any_disc(const OzElements *elements)
{
    for (int64_t i = 0; i < elements->free_count; i++) {
        if (elements->radius[i] > 0) {
            return true;
        }
    }
    return false;
}

static bool any_motion(const OzScene *scene)
{
    for (int w = 0; w < scene->wall_count; w++) {
        if (scene->walls[w].motion.present) {
            return true;
        }
    }
    return false;
}

OzElementSwitches oz_element_switches_derive(const OzScene *scene, const OzGrains *grains,
                                             const OzDevice *device)
{
    OzElementSwitches s = {0};
    bool gear = scene->integrator == OZ_INTEGRATOR_GEAR4;
    s.is_double = scene->precision == OZ_PRECISION_DOUBLE;
    s.group = device->group;
    s.lanes = s.is_double ? device->double_lanes : device->float_lanes;
    s.lanes = s.group > 1 ? 1 : s.lanes;
    s.order = gear ? 5 : 3;
    s.moving = any_motion(scene);
    s.discs = any_disc(grains->elements);
    s.beams = grains->elements->beam_count > 0 || grains->count == 0; /* none: as those of others */
    s.strength = s.beams && oz_beam_types_wear(&scene->beams);
    s.yield = s.beams && scene->beams.yield.present;
    s.substeps = gear || !s.beams ? 1 : (int)scene->beams.substeps;
    s.resort = grains->elements->count > device->small_most && s.substeps == 1;
    s.triangle_field = scene->triangles.overlap == OZ_OVERLAP_FIELD;
    s.force_point = s.triangle_field ? 0 : (int)scene->triangles.force_point;
    s.damping_shear = (int)scene->beams.damping_shear;
    s.ledger = scene->observe.ledger;
    s.impulses = scene->observe.walls == OZ_OBSERVE_WALLS_MEAN && scene->wall_count > 0;
    return s;
}
