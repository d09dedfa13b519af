/* Beams, a block of lanes at a time. OpenCL C only. */
#pragma once

#include "kernels/beam_strength.h"
#include "kernels/beam_yield.h"
#include "kernels/element_sums.h"

OZ_INLINE OzBeamEnd oz_element_beams_end(const OzWork *w, const int *slots)
{
    OzBeamEnd end;
    real words[4];
    oz_lanes_load4(w->record, slots, OZ_ELEMENT_RECORD, OZ_PR_CORNER + 4, words);
    end.position = oz_vec2(words[2], words[3]);
    oz_element_work_motion(w, slots, &end.velocity, &end.angle, &end.angular_velocity);
    return end;
}

OZ_INLINE void oz_element_beams_check(OzWork *w, const OzBeamForce *f, const int *slots, int step)
{
    mask stretched =
        !((f->stretch > REAL(OZ_BEAM_STRETCH_LEAST)) & (f->stretch < REAL(OZ_BEAM_STRETCH_MOST)));
    mask bent = !((oz_magnitude(f->bend_a) <= REAL(OZ_BEAM_BEND_MOST)) &
                  (oz_magnitude(f->bend_b) <= REAL(OZ_BEAM_BEND_MOST)));
    if (OZ_ANY(stretched | bent)) {
        oz_work_stop_lanes(w, stretched, OZ_ELEMENT_STOP_STRETCHED, step, slots);
        oz_work_stop_lanes(w, bent, OZ_ELEMENT_STOP_BENT, step, slots);
    }
}

#if OZ_YIELD
/* Shapes at rest follow forces that beams do not bear, which are then what they bear. */
OZ_INLINE void oz_element_beams_yield(OzWork *w, int block, OzBeamForce *f, const int *a,
                                      const int *b)
{
    global real *rest = w->beam_rest + (size_t)block * OZ_BEAM_REST;
    global real *wear = w->beam_wear + (size_t)block * OZ_BEAM_WEAR;
    OzBeamRest now = {rest[0], rest[1], rest[2], REAL(0.0), REAL(0.0) > REAL(0.0)};
    OzBeamConstants constants = w->parameters->beam;
    OzBeamRest next = oz_beam_yield(constants, w->parameters->yield, f, now);
    mask yields = next.yields & (wear[OZ_BW_WHOLE] > REAL(0.5));
    if (OZ_ANY(yields)) {
        rest[0] = yields ? next.length : rest[0];
        rest[1] = yields ? next.a : rest[1];
        rest[2] = yields ? next.b : rest[2];
        wear[OZ_BW_YIELDED] += yields ? next.lost : REAL(0.0);
        *f = oz_beam_force(constants, oz_element_beams_end(w, a), oz_element_beams_end(w, b),
                           rest[0], rest[1], rest[2]);
    }
}
#endif

#if OZ_STRENGTH
/* Takes away what broken beams would do, and breaks those that bear no more. before: how long ago,
 * s, those were there last. */
OZ_INLINE void oz_element_beams_bear(OzWork *w, int block, OzBeamForce *f, const int *a,
                                     const int *b, scalar before, int step)
{
    global const real *rest = w->beam_rest + (size_t)block * OZ_BEAM_REST;
    global real *wear = w->beam_wear + (size_t)block * OZ_BEAM_WEAR;
    real load = oz_beam_strength_load(w->parameters->beam, w->parameters->strength, f, rest[0]);
    mask whole = wear[OZ_BW_WHOLE] > REAL(0.5), breaks = whole & (load >= REAL(1.0));
    if (OZ_ANY(breaks)) {
        real stored = oz_beam_strength_stored(f, oz_element_beams_end(w, a),
                                              oz_element_beams_end(w, b), REAL(before));
        wear[OZ_BW_LOST] = breaks ? stored : wear[OZ_BW_LOST];
        wear[OZ_BW_WHOLE] = breaks ? REAL(0.0) : wear[OZ_BW_WHOLE];
        oz_work_stop_lanes(w, breaks, OZ_ELEMENT_STOP_BROKE, step, a);
    }
    oz_beam_strength_drop(f, !(wear[OZ_BW_WHOLE] > REAL(0.5)));
}
#endif

/* Forces of all beams, which are to be counted for a share of the step. Lanes beyond the last
 * repeat the first beam. */
OZ_INLINE void oz_element_beams_pull(OzWork *w, int step, scalar share, OzElementSums *sums)
{
    int count = w->control->beam_count;
    OZ_EACH(w, block, (count + OZ_LANES - 1) / OZ_LANES)
    {
        int a[OZ_LANES], b[OZ_LANES], first = block * OZ_LANES;
        for (int l = 0; l < OZ_LANES; l++) {
            a[l] = w->beam_a[first + l];
            b[l] = w->beam_b[first + l];
        }
        global const real *rest = w->beam_rest + (size_t)block * OZ_BEAM_REST;
        OzBeamForce f = oz_beam_force(w->parameters->beam, oz_element_beams_end(w, a),
                                      oz_element_beams_end(w, b), rest[0], rest[1], rest[2]);
#if OZ_YIELD
        oz_element_beams_yield(w, block, &f, a, b);
#endif
#if OZ_STRENGTH
        oz_element_beams_bear(w, block, &f, a, b, (scalar)0.5 * share * w->parameters->dt, step);
#endif
        oz_element_beams_check(w, &f, a, step);
        if (OZ_LEDGER) {
            mask present = oz_lanes_mask_of(OZ_LANES_IOTA + first < count);
            sums->word[OZ_PL_BEAM_AXIAL] += present ? f.power_axial : REAL(0.0);
            sums->word[OZ_PL_BEAM_BENDING] += present ? f.power_bending : REAL(0.0);
        }
        real words[4] = {f.force.x, f.force.y, f.moment_a, f.moment_b};
        oz_lanes_store4(w->beam_force + (size_t)first * OZ_ELEMENT_LOAD, OZ_ELEMENT_LOAD, 0, words);
    }
}
