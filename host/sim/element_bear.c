/* Beams' wear as evaluations go. */
#include "sim/element_bear.h"

#include <math.h>

bool oz_element_bear_contact(OzElementBear *bear, int a, int b, OzOverlap *o)
{
    int64_t scar = bear->wear ? oz_wear_scar(bear->wear, a, b) : -1;
    if (scar < 0 || !(bear->wear->scar[scar] > 0)) {
        return false;
    }
    bool unfelt = !OZ_TRIANGLE_FIELD && o->swallowed;
    double depth = unfelt ? OZ_HUGE : sqrt(fmax(o->energy, 0)), least = bear->wear->scar[scar];
    double share = oz_beam_strength_share(depth, least);
    least = oz_beam_strength_least(depth, least);
    if (bear->wears) {
        bear->wear->scar[scar] = least;
    }
    o->push = oz_scale2(o->push, share);
    o->moment *= share;
    o->energy = unfelt ? 0 : (depth - least) * (depth - least);
    return least > 0;
}

static OzBeamForce force_of(const OzElementBear *bear, OzBeamEnd a, OzBeamEnd b, const double *rest)
{
    return oz_beam_force(bear->beam, a, b, rest[0], rest[1], rest[2]);
}

/* The shape at rest follows a force that the beam does not bear, which is then what it bears. */
static void yield(OzElementBear *bear, int64_t k, OzBeamEnd a, OzBeamEnd b, OzBeamForce *beam)
{
    double *rest = bear->wear->rest + 3 * k;
    OzBeamRest next = oz_beam_yield(bear->beam, bear->yield, beam,
                                    (OzBeamRest){.length = rest[0], .a = rest[1], .b = rest[2]});
    if (next.yields) {
        rest[0] = next.length;
        rest[1] = next.a;
        rest[2] = next.b;
        bear->wear->yielded[k] += next.lost;
        *beam = force_of(bear, a, b, rest);
    }
}

OzBeamForce oz_element_bear_beam(OzElementBear *bear, const OzElements *e, int64_t k, OzBeamEnd a,
                                 OzBeamEnd b)
{
    OzWear *wear = bear->wear;
    if (!wear) {
        return oz_beam_force(bear->beam, a, b, e->beam_length[k], e->beam_rest_a[k],
                             e->beam_rest_b[k]);
    }
    OzBeamForce beam = force_of(bear, a, b, wear->rest + 3 * k);
    if (bear->wears && wear->whole[k] > 0) {
        yield(bear, k, a, b, &beam);
        if (oz_beam_strength_load(bear->beam, bear->strength, &beam, wear->rest[3 * k]) >= 1) {
            wear->whole[k] = 0;
            wear->lost[k] = oz_beam_strength_stored(&beam, a, b, bear->before);
            bear->broke = true;
        }
    }
    oz_beam_strength_drop(&beam, !(wear->whole[k] > 0));
    return beam;
}
