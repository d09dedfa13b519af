/* Forces between grains. Most listed pairs do not touch: a sieve picks those that do, or nearly so,
 * from the list, and the contact law gets full blocks of them, one pair a lane, each pair once.
 * OpenCL C only. Where one work-item does a whole member or tile it adds a pair's force to both
 * grains' loads at once; otherwise it keeps the forces of a region's picked pairs closed up, and
 * the grains gather theirs (loads.h). */
#pragma once

#include "kernels/active.h"
#include "kernels/deep.h"

/* The sieve lets pass what is closer than the sum of radii and this share more: whether a pair
 * touches is the contact law's to say, and the rounding of long shafts must not come between. */
#define OZ_PAIRS_MARGIN 1e-3

/* The squared distance between the shafts of two grains a lane, and the sum of their radii. */
OZ_INLINE real oz_pairs_distance2(const OzWork *w, OzGrain one, OzGrain other, real *radii)
{
    OzVec3 apart = oz_space_minus(one.position, other.position, oz_work_space(w));
    *radii = one.radius + other.radius;
    if (OZ_ROUND) {
        return oz_dot(apart, apart);
    }
    OzClosest at = oz_closest(apart, one.half_shaft, other.half_shaft);
    OzVec3 gap = oz_along(oz_along(apart, at.s, one.half_shaft), -at.t, other.half_shaft);
    return oz_dot(gap, gap);
}

/* What the sieve has found out about a pair and the contact law goes on with. */
enum {
    OZ_P_APART = 0,
    OZ_P_SHAFT_A = 3,
    OZ_P_SHAFT_B = 6,
    OZ_P_CLOSEST = 9,
    OZ_P_RADII = 11, /* this and the masses differ among unequal grains only */
    OZ_P_MASSES = 13,
    OZ_P_WORDS = OZ_EQUAL ? 11 : 15
};

/* Picked pairs, their grains' slots and what is known of them. */
typedef struct OzPairs {
    OzActive active;
    int kept; /* where the first one's force will be kept */
    int a[OZ_ACTIVE_MOST], b[OZ_ACTIVE_MOST];
    scalar word[15][OZ_ACTIVE_MOST];
} OzPairs;

OZ_INLINE void oz_pairs_add(OzPairs *pairs, int first, const int *a, const int *b,
                            const real *words, int bits)
{
    oz_lanes_close_up(pairs->a + pairs->active.count, OZ_LANES_LOAD(a), bits);
    oz_lanes_close_up(pairs->b + pairs->active.count, OZ_LANES_LOAD(b), bits);
#pragma unroll
    for (int k = 0; k < OZ_P_WORDS; k++) {
        oz_active_add_word(&pairs->active, pairs->word[k], words[k], bits);
    }
    oz_active_add(&pairs->active, OZ_LANES_IOTA + first, bits);
}

OZ_INLINE void oz_pairs_fill(OzPairs *pairs, int due)
{
    oz_active_fill(&pairs->active, due);
    for (int l = pairs->active.count; l < due; l++) {
        pairs->a[l] = pairs->a[due - OZ_LANES];
        pairs->b[l] = pairs->b[due - OZ_LANES];
    }
    for (int k = 0; k < OZ_P_WORDS; k++) {
        oz_active_fill_word(&pairs->active, pairs->word[k], due);
    }
}

OZ_INLINE void oz_pairs_drop(OzPairs *pairs, int due)
{
    OZ_LANES_STORE(OZ_LANES_LOAD(pairs->a + due), pairs->a);
    OZ_LANES_STORE(OZ_LANES_LOAD(pairs->b + due), pairs->b);
#pragma unroll
    for (int k = 0; k < OZ_P_WORDS; k++) {
        oz_active_drop_word(pairs->word[k], due);
    }
    oz_active_drop(&pairs->active, due);
}

OZ_INLINE OzVec3 oz_pairs_vector(const OzPairs *pairs, int word, int at)
{
    return oz_vec3(OZ_LANES_LOAD(pairs->word[word] + at), OZ_LANES_LOAD(pairs->word[word + 1] + at),
                   OZ_LANES_LOAD(pairs->word[word + 2] + at));
}

/* The first or second grains of the picked pairs from `at` on. */
OZ_INLINE OzGrain oz_pairs_grains(const OzWork *w, const OzPairs *pairs, int second, int at)
{
    OzGrain grain;
    oz_work_load_motion(w, (second ? pairs->b : pairs->a) + at, &grain);
    grain.half_shaft = oz_pairs_vector(pairs, second ? OZ_P_SHAFT_B : OZ_P_SHAFT_A, at);
    grain.radius = OZ_EQUAL ? REAL(w->parameters->radius)
                            : OZ_LANES_LOAD(pairs->word[OZ_P_RADII + second] + at);
    grain.mass = OZ_EQUAL ? REAL(w->parameters->mass)
                          : OZ_LANES_LOAD(pairs->word[OZ_P_MASSES + second] + at);
#if OZ_FINE
    grain.fine = oz_work_fine(w, (second ? pairs->b : pairs->a) + at);
#endif
    return grain;
}

#if OZ_LEDGER
/* What the ledger needs of contacts after the step. */
OZ_INLINE void oz_pairs_note(global real *words, const int *items, int stride, int word,
                             OzContact contact, OzContactForce parts, OzVec3 third, OzVec3 arm)
{
    oz_work_put3(words, items, stride, word, parts.spring);
    oz_work_put3(words, items, stride, word + 3, parts.dashpot);
    oz_work_put3(words, items, stride, word + 6, contact.velocity);
    oz_work_put3(words, items, stride, word + 9, third);
    oz_work_put3(words, items, stride, word + 12, arm);
}

/* What it needs of their resistance against rotation; dashpot: other dashpots' couple. */
OZ_INLINE void oz_pairs_note_couple(global real *words, const int *items, int stride, int word,
                                    OzContact contact, OzContactForce parts, OzVec3 dashpot)
{
    oz_work_put3(words, items, stride, word, oz_add(parts.couple.dashpot, dashpot));
    oz_work_put3(words, items, stride, word + 3, contact.turning);
    oz_work_put3(words, items, stride, word + 6, parts.couple.spring);
}

OZ_INLINE void oz_pairs_note_pair(OzWork *w, const int *items, OzPairForce pair)
{
    oz_pairs_note(w->pair_ledger, items, OZ_CONTACT_LEDGER, 0, pair.contact, pair.parts, pair.arm_a,
                  pair.arm_b);
    if (OZ_LINE) {
        oz_work_put3(w->pair_couple, items, OZ_COUPLE_LEDGER, 0, pair.couple);
        oz_work_put3(w->pair_couple, items, OZ_COUPLE_LEDGER, 3, pair.turning);
    }
    if (OZ_ROLLING) {
        oz_pairs_note_couple(w->pair_couple, items, OZ_COUPLE_LEDGER, 0, pair.contact, pair.parts,
                             pair.couple);
    }
}

/* Nothing noted, for a block of pairs that may not be picked. */
OZ_INLINE void oz_pairs_note_none(OzWork *w, size_t block)
{
    for (int k = 0; k < OZ_CONTACT_LEDGER; k++) {
        w->pair_ledger[block * OZ_CONTACT_LEDGER + k] = REAL(0.0);
    }
    for (int k = 0; k < (OZ_LINE || OZ_ROLLING ? OZ_COUPLE_LEDGER : 0); k++) {
        w->pair_couple[block * OZ_COUPLE_LEDGER + k] = REAL(0.0);
    }
}
#endif

#if !OZ_GATHER

/* Where a grain's load is; that of a grain of another tile goes where nobody asks for it. */
OZ_INLINE global scalar4 *oz_pairs_load_of(const OzWork *w, int slot)
{
#if OZ_TILES
    slot = oz_work_is_own(w, slot) ? slot : w->stray;
#endif
    return (global scalar4 *)(w->load + (size_t)slot * OZ_LOAD);
}

/* Adds the pairs' forces to the loads of both grains. */
OZ_INLINE void oz_pairs_deliver(OzWork *w, const int *a, const int *b, const scalar4 *forces,
                                const scalar4 *torques_a, const scalar4 *torques_b)
{
#pragma unroll
    for (int l = 0; l < OZ_LANES; l++) {
        global scalar4 *load_a = oz_pairs_load_of(w, a[l]), *load_b = oz_pairs_load_of(w, b[l]);
        load_a[0] -= forces[l];
        load_a[1] += torques_a[l];
        load_b[0] += forces[l];
        load_b[1] += torques_b[l];
    }
}

#else

/* Keeps the pairs' forces from `kept` on. */
OZ_INLINE void oz_pairs_keep(OzWork *w, int kept, const scalar4 *forces, const scalar4 *torques_a,
                             const scalar4 *torques_b)
{
    global scalar4 *to = (global scalar4 *)(w->pair_force + (size_t)kept * OZ_PAIR_FORCE);
    global scalar4 *torque = (global scalar4 *)(w->pair_torque + (size_t)kept * OZ_PAIR_TORQUE);
#pragma unroll
    for (int l = 0; l < OZ_LANES; l++) {
        to[2 * l + OZ_F_FORCE / 4] = forces[l];
        to[2 * l + OZ_F_TORQUE / 4] = torques_b[l];
        torque[l] = torques_a[l];
    }
}

#endif

/* Brings the forces of a block of picked pairs, from number `at` on, to where the grains find them.
 * Lanes outside of `counts` only fill the block up and have no force of their own. */
OZ_INLINE void oz_pairs_finish(OzWork *w, const OzPairs *pairs, int at, mask counts,
                               OzPairForce pair)
{
    scalar4 forces[OZ_LANES], torques_a[OZ_LANES], torques_b[OZ_LANES];
    if (!OZ_GATHER) {
        pair.force = oz_where(counts, pair.force);
        pair.torque_a = oz_where(counts, pair.torque_a);
        pair.torque_b = oz_where(counts, pair.torque_b);
    }
    oz_lanes_rows3(pair.force, forces);
    oz_lanes_rows3(pair.torque_a, torques_a);
    oz_lanes_rows3(pair.torque_b, torques_b);
#if !OZ_GATHER
    oz_pairs_deliver(w, pairs->a + at, pairs->b + at, forces, torques_a, torques_b);
#else
    oz_pairs_keep(w, pairs->kept + at, forces, torques_a, torques_b);
#endif
}

/* The springs of picked pairs, those of `list`. */
OZ_INLINE OzVec3 oz_pairs_load_springs(global const scalar *list, const int *items)
{
    real words[4];
    oz_lanes_load4(list, items, OZ_SPRING, 0, words);
    return oz_vec3(words[0], words[1], words[2]);
}

OZ_INLINE void oz_pairs_store_springs(global scalar *list, const int *items, OzVec3 springs)
{
    scalar4 rows[OZ_LANES];
    oz_lanes_rows3(springs, rows);
#pragma unroll
    for (int l = 0; l < OZ_LANES; l++) {
        *(global scalar4 *)(list + (size_t)items[l] * OZ_SPRING) = rows[l];
    }
}

OZ_INLINE OzMemory oz_pairs_load_memory(const OzWork *w, const int *items)
{
    OzVec3 none = oz_vec3(REAL(0.0), REAL(0.0), REAL(0.0));
    OzMemory memory = {none, none};
    if (OZ_HISTORY) {
        memory.stretch = oz_pairs_load_springs(w->pair_history, items);
    }
    if (OZ_ROLLING_SPRING) {
        memory.turned = oz_pairs_load_springs(w->pair_rolling, items);
    }
    return memory;
}

/* Forces of one block of picked pairs, one pair a lane, from number `at` on. Only the first `count`
 * lanes hold a pair of their own; in a last block that is not full the lanes after them repeat one
 * of these, and what they find is left out. */
OZ_INLINE void oz_pairs_touch(OzWork *w, const OzPairs *pairs, int at, int count,
                              OzLawConstants law, int step)
{
    const int *items = pairs->active.item + at;
    OzGrain one = oz_pairs_grains(w, pairs, 0, at), other = oz_pairs_grains(w, pairs, 1, at);
    OzVec3 apart = oz_pairs_vector(pairs, OZ_P_APART, at);
#if OZ_SHEAR
    other.velocity = oz_rods_beside(other.velocity, apart, oz_work_space(w));
#endif
    OzMemory memory = oz_pairs_load_memory(w, items);
    OzClosest closest = {OZ_LANES_LOAD(pairs->word[OZ_P_CLOSEST] + at),
                         OZ_LANES_LOAD(pairs->word[OZ_P_CLOSEST + 1] + at)};
    OzPairForce pair = oz_rods_touch(one, other, apart, closest,
                                     OZ_MATERIAL_PAIR_LAW(w, pairs->a + at, pairs->b + at, law),
                                     &memory, w->parameters->dt, oz_integrate_share());
    if (OZ_HISTORY) {
        oz_pairs_store_springs(w->pair_history, items, memory.stretch);
    }
    if (OZ_ROLLING_SPRING) {
        oz_pairs_store_springs(w->pair_rolling, items, memory.turned);
    }
    oz_pairs_finish(w, pairs, at, OZ_ACTIVE_BEFORE(count), pair);
    OzDeep deep = {pair.depth,
                   pair.closing,
                   oz_smaller(one.radius, other.radius),
                   one.radius + other.radius,
                   OZ_ACTIVE_BEFORE(count),
                   OZ_DEEP_PAIR};
    oz_deep_guard(w, deep, pairs->a + at, step);
    if (OZ_ANY(pair.crossed)) {
        atomic_inc(&w->control->crossed);
    }
#if OZ_LEDGER
    oz_pairs_note_pair(w, items, pair);
#endif
#if OZ_LEDGER && OZ_SHEAR
    oz_lanes_put(w->pair_ledger, items, OZ_CONTACT_LEDGER, OZ_CONTACT_LEDGER - 1,
                 oz_shear_power(pair.force, apart.y, oz_work_space(w)));
#endif
}

/* Notes which pairs of a block are picked now (one bit a lane), and sets to zero the tangential
 * springs of those that were picked before and are not any more. */
OZ_INLINE void oz_pairs_part(OzWork *w, int first, int bits)
{
    int gone = w->pair_active[first / OZ_LANES] & ~bits;
    w->pair_active[first / OZ_LANES] = bits;
    for (int l = 0; OZ_HISTORY && gone != 0 && l < OZ_LANES; l++) {
        if ((gone >> l) & 1) {
            *(global scalar4 *)(w->pair_history + (size_t)(first + l) * OZ_SPRING) = (scalar4)(0);
#if OZ_ROLLING_SPRING
            *(global scalar4 *)(w->pair_rolling + (size_t)(first + l) * OZ_SPRING) = (scalar4)(0);
#endif
        }
    }
}

/* A block of the list in the sieve. */
typedef struct OzSieved {
    int first, a[OZ_LANES], b[OZ_LANES];
    OzGrain one, other;
    OzVec3 apart;
    OzClosest at;
    int bits;
} OzSieved;

OZ_INLINE void oz_pairs_fetch(const OzWork *w, OzSieved *s, int first)
{
    s->first = first;
#pragma unroll
    for (int l = 0; l < OZ_LANES; l++) {
        s->a[l] = w->pair_a[first + l];
        s->b[l] = w->pair_b[first + l];
    }
    s->one = oz_work_geometry(w, s->a);
    s->other = oz_work_geometry(w, s->b);
    s->apart = oz_space_minus(s->one.position, s->other.position, oz_work_space(w));
}

/* end: of the region's list, which is filled up with pairs of no grain, far away where space is
 * open. */
OZ_INLINE void oz_pairs_judge(OzSieved *s, int end)
{
    s->at = oz_rods_closest(s->apart, s->one.half_shaft, s->other.half_shaft);
    OzVec3 gap =
        oz_along(oz_along(s->apart, s->at.s, s->one.half_shaft), -s->at.t, s->other.half_shaft);
    real far = (s->one.radius + s->other.radius) * REAL(1 + OZ_PAIRS_MARGIN);
    mask near = oz_dot(gap, gap) < far * far;
    if (OZ_PERIODIC) {
        near = near & oz_lanes_mask_of(OZ_LANES_IOTA + s->first < end);
    }
    s->bits = oz_lanes_bits(near);
}

/* Picks pairs of a block of the list. */
OZ_INLINE void oz_pairs_pick(OzWork *w, OzPairs *pairs, const OzSieved *s)
{
    OzVec3 one = s->one.half_shaft, other = s->other.half_shaft;
    real words[15] = {s->apart.x, s->apart.y,    s->apart.z,      one.x,       one.y,
                      one.z,      other.x,       other.y,         other.z,     s->at.s,
                      s->at.t,    s->one.radius, s->other.radius, s->one.mass, s->other.mass};
#if OZ_GATHER
    w->pair_kept[s->first / OZ_LANES] = pairs->kept + pairs->active.count;
#endif
    oz_pairs_add(pairs, s->first, s->a, s->b, words, s->bits);
    oz_pairs_part(w, s->first, s->bits);
#if OZ_LEDGER
    oz_pairs_note_none(w, (size_t)(s->first / OZ_LANES));
#endif
}

OZ_INLINE void oz_pairs_region(OzWork *w, int region, int step)
{
    OzLawConstants law = w->parameters->law;
    int begin = region * w->z.inner_capacity, end = begin + w->pair_count[region];
    OzPairs pairs;
    OZ_WORK_PLACES(w, step + OZ_MOVES_BEFORE);
    pairs.active.count = 0;
    pairs.kept = begin;
    oz_work_tile(w, region);
#if !OZ_GATHER
    oz_work_clear_loads(w, region);
#endif
    for (int first = begin; first < end; first += OZ_ACTIVE_BLOCKS * OZ_LANES) {
        int stop = min(first + OZ_ACTIVE_BLOCKS * OZ_LANES, end);
        for (int block = first; block < stop; block += 2 * OZ_LANES) {
            OzSieved one, other;
            int two = block + OZ_LANES < stop;
            oz_pairs_fetch(w, &one, block);
            oz_pairs_fetch(w, &other, two ? block + OZ_LANES : block);
            oz_pairs_judge(&one, end);
            oz_pairs_judge(&other, end);
            oz_pairs_pick(w, &pairs, &one);
            if (two) {
                oz_pairs_pick(w, &pairs, &other);
            }
        }
        int due = oz_active_due(&pairs.active, stop == end);
        oz_pairs_fill(&pairs, due);
        for (int at = 0; at < due; at += OZ_LANES) {
            oz_pairs_touch(w, &pairs, at, pairs.active.count - at, law, step);
        }
        oz_pairs_drop(&pairs, due);
        pairs.kept += due;
    }
}
