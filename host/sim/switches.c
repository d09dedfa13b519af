/* Deriving switches from a scene. */
#include "sim/switches.h"

#include "model/contact.h"
#include "model/motion.h"
#include "scene/boundary.h"
#include "scene/mixing.h"
#include "scene/wall_swing.h"
#include "sim/gates.h"
#include "sim/resolution.h"
#include "sim/sides.h"

static bool all_equal(const OzGrains *grains)
{
    for (int64_t i = 1; i < grains->count; i++) {
        if (grains->diameter[i] != grains->diameter[0] || grains->length[i] != grains->length[0] ||
            grains->mass[i] != grains->mass[0]) {
            return false;
        }
    }
    return true;
}

/* Without any grain there is nothing to leave out kernels for. */
static bool all_round(const OzGrains *grains)
{
    for (int64_t i = 0; i < grains->count; i++) {
        if (grains->length[i] > 0) {
            return false;
        }
    }
    return grains->count > 0;
}

/* Trigrains' own have nothing to do with these kernels. */
static bool moves_before(OzIntegrator integrator)
{
#define FIRST(NAME, name, choice, flat_choice, share, first) [OZ_INTEGRATOR_##NAME] = first,
    static const bool moves[OZ_INTEGRATORS_END] = {OZ_INTEGRATORS(FIRST)};
#undef FIRST
    return moves[integrator];
}

enum { KINDS_A_WORD = 6 }; /* five bits each */

#define ONE(NAME, name, choice, fine, edged) +1
_Static_assert(0 OZ_WALLS(ONE) <= 2 * KINDS_A_WORD, "five bits a kind of wall fill two ints");
#undef ONE

/* How many walls of each kind, as kernels/wall.h has them; constants.c refuses more walls than
 * that. */
static void count_kinds(OzSwitches *s, const OzScene *scene)
{
    OzWallSide sides[OZ_WALLS_MAX];
    s->walls = oz_sides_list(sides, scene);
    for (int k = 0; k < s->walls && k < OZ_WALLS_MAX; k++) {
        s->edged += oz_wall_shape_is_edged(&sides[k].shape);
        s->meshes += (int)sides[k].shape.kind == OZ_WALL_MESH;
        int kind = (int)sides[k].shape.kind, more = kind >= KINDS_A_WORD;
        *(more ? &s->wall_kinds_more : &s->wall_kinds) += 1 << 5 * (kind % KINDS_A_WORD);
    }
}

static bool has_spring(const OzContactValues *values, const OzScene *scene)
{
    return oz_contact_constants_of(values, &scene->contact).tangential_stiffness > 0;
}

static bool resists(const OzContactValues *values)
{
    return values->rolling_friction > 0 || values->twisting_friction > 0;
}

/* Whether any contact of the scene sticks or resists rotation, and whether any with a spring.
 * Springs are kept beside the tangential ones. */
static void derive_rolling(OzSwitches *s, const OzScene *scene)
{
    bool rolls = false;
    for (int i = 0; i < oz_mixing_contacts(scene); i++) {
        OzMixed mixed;
        oz_mixing_contact(&mixed, scene, i);
        s->rolling |= resists(&mixed.values);
        s->adhesion |= mixed.values.surface_energy > 0;
        rolls |= mixed.values.rolling_friction > 0;
    }
    s->rolling_spring = rolls && scene->contact.rolling == OZ_ROLLING_RESISTS_BY_SPRING;
    s->history |= s->rolling_spring;
}

/* Whether any contact of the scene has friction, and whether any of these has a spring. */
static void derive_friction(OzSwitches *s, const OzScene *scene)
{
    for (int i = 0; i < oz_mixing_contacts(scene); i++) {
        OzMixed mixed;
        oz_mixing_contact(&mixed, scene, i);
        s->friction |= mixed.values.friction > 0;
        s->history |= mixed.values.friction > 0 && has_spring(&mixed.values, scene);
    }
}

static void derive_motion(OzSwitches *s, const OzScene *scene)
{
    for (int w = 0; w < scene->wall_count; w++) {
        s->gated |= oz_gates_has(&scene->walls[w]);
        s->moving |= scene->walls[w].motion.present || s->gated;
        s->servos += scene->walls[w].servo.present;
        s->free_motion |= oz_motion_is_free(&scene->walls[w].motion) || s->servos > 0;
        s->swung |= oz_wall_swing_has(&scene->walls[w]);
    }
}

OzSwitches oz_switches_derive(const OzScene *scene, const OzGrains *grains, const OzDevice *device)
{
    OzSwitches s = {0};
    s.is_double = scene->precision == OZ_PRECISION_DOUBLE;
    s.lanes = s.is_double ? device->double_lanes : device->float_lanes;
    s.group = device->group;
    s.integrator = (int)scene->integrator;
    s.moves_before = moves_before(scene->integrator);
    s.round = all_round(grains);
    s.equal = all_equal(grains);
    s.materials = oz_mixing_count(scene);
    derive_friction(&s, scene);
    derive_motion(&s, scene);
    derive_rolling(&s, scene);
    s.slip_scale = s.history && scene->contact.slip == OZ_SLIP_SCALE;
    s.attraction_clamp = scene->contact.attraction == OZ_ATTRACTION_CLAMP;
    s.surfaces = scene->contact.contact_point == OZ_POINT_SURFACES;
    s.law = (int)scene->contact.law;
    s.line = scene->contact.parallel == OZ_PARALLEL_LINE && !s.round;
    s.smooth = scene->contact.law == OZ_LAW_HOOKE && scene->contact.damping == OZ_DAMPING_SMOOTH;
    s.at_contact = scene->contact.restitution_at == OZ_RESTITUTION_CONTACT && !s.round;
    s.gyroscopic = scene->gyroscopic && !s.round; /* a sphere has no gyroscopic term */
    s.drag = scene->drag.viscosity > 0 || scene->drag.coefficient > 0;
    s.fine = oz_resolution_is_fine(scene, grains);
    count_kinds(&s, scene);
    for (int k = 0; k < 3; k++) {
        s.periodic |= (oz_boundary_period(&scene->boundary, k) > 0) << k;
    }
    s.shear = scene->boundary.present && scene->boundary.is_sheared;
    s.ledger = scene->observe.ledger;
    s.impulses = scene->observe.walls == OZ_OBSERVE_WALLS_MEAN && s.walls > 0;
    s.pushed = scene->is_pushed;
    s.all_pairs = scene->broadphase == OZ_BROADPHASE_ALL_PAIRS;
    s.host_lists = scene->broadphase == OZ_BROADPHASE_SORT_AXIS;
    s.resort = grains->count > device->small_most;
    return s;
}
