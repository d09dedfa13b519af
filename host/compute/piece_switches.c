/* Deriving trigrains' switches from a scene. */
#include "compute/piece_switches.h"

static bool any_disc(const OzPieces *pieces)
{
    for (int64_t i = 0; i < pieces->free_count; i++) {
        if (pieces->radius[i] > 0) {
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

OzPieceSwitches oz_piece_switches_derive(const OzScene *scene, const OzGrains *grains,
                                         const OzDevice *device)
{
    OzPieceSwitches s = {0};
    bool gear = scene->integrator == OZ_INTEGRATOR_GEAR4;
    s.is_double = scene->precision == OZ_PRECISION_DOUBLE;
    s.group = device->group;
    s.lanes = s.is_double ? device->double_lanes : device->float_lanes;
    s.lanes = s.group > 1 ? 1 : s.lanes;
    s.order = gear ? 5 : 3;
    s.moving = any_motion(scene);
    s.discs = any_disc(grains->pieces);
    s.beams = grains->pieces->beam_count > 0 || grains->count == 0; /* none: as those of others */
    s.substeps = gear || !s.beams ? 1 : (int)scene->beams.substeps;
    s.force_point = (int)scene->triangles.force_point;
    s.damping_shear = (int)scene->beams.damping_shear;
    s.ledger = scene->observe.ledger;
    return s;
}
