/* Parting grains on the host. */
#include "sim/element_part.h"

#include "base/memory.h"
#include "model/wall_motion.h"
#include "sim/element_overlap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Two elements as they lie, seen from the centre of the first. */
typedef struct Pair {
    OzTriangle one, other;
} Pair;

static OzTriangle triangle_at(const OzElements *elements, int i, const double *at, double angle)
{
    double corners[6];
    OzTriangle t;
    oz_elements_corners(elements, i, at, angle, corners);
    for (int k = 0; k < 3; k++) {
        t.corner[k] = oz_vec2(corners[2 * k], corners[2 * k + 1]);
    }
    return t;
}

/* False where they cannot touch. */
static bool lay(Pair *pair, const OzElements *elements, const OzElementState *state, int a, int b)
{
    const double still[2] = {0, 0}, *x = state->position;
    const double apart[2] = {x[2 * b] - x[2 * a], x[2 * b + 1] - x[2 * a + 1]};
    bool disc = elements->radius[a] > 0 || elements->radius[b] > 0;
    if (disc || hypot(apart[0], apart[1]) >= elements->reach[a] + elements->reach[b]) {
        return false;
    }
    pair->one = triangle_at(elements, a, still, state->angle[a]);
    pair->other = triangle_at(elements, b, apart, state->angle[b]);
    return true;
}

/* Root of the integral of depth over the overlap, m^1.5; of what kinds of contact do not feel,
 * most. */
static double depth_of(const OzElements *elements, const OzElementState *state, int a, int b)
{
    Pair pair;
    if (!lay(&pair, elements, state, a, b)) {
        return 0;
    }
    OzOverlap o = oz_element_overlap_find(elements, a, b, &pair.one, &pair.other);
    double most = elements->area[a] * elements->reach[a]; /* no contact holds more */
    return sqrt(!OZ_TRIANGLE_FIELD && o.swallowed ? most : fmax(o.energy, 0));
}

static void note_depths(OzWear *wear, const OzElementState *state, const OzElementParting *parting)
{
    const int *before = parting->body_before, *after = parting->after->body;
    for (int a = 0; a < (int)wear->element_count; a++) {
        for (int b = a + 1; b < (int)wear->scar_end[a]; b++) {
            if (before[a] == before[b] && after[a] != after[b]) {
                wear->scar[oz_wear_scar(wear, a, b)] = depth_of(parting->after, state, a, b);
            }
        }
    }
}

/* What a contact's potential is less, m^3, since edges of its elements have become outer ones. */
static double ease(const OzWear *wear, const OzScene *scene, const OzElementState *state,
                   const OzElementParting *parting, OzElementPair of)
{
    Pair pair;
    const OzElements *elements = parting->after;
    int one = parting->edges_before[of.a], other = parting->edges_before[of.b];
    int one_now = oz_elements_outer_edges(elements, of.a);
    int other_now = oz_elements_outer_edges(elements, of.b);
    bool free = of.b < elements->free_count;
    const OzWall *wall =
        free ? NULL : &scene->walls[elements->body[of.b] - (int)elements->grain_count];
    bool begins = free && parting->body_before[of.a] == parting->body_before[of.b];
    bool gone = wall && !oz_wall_motion_present(wall, state->time, state->at_rest);
    if (begins || gone || (one == one_now && other == other_now) ||
        !lay(&pair, elements, state, of.a, of.b)) {
        return 0;
    }
    OzFieldPair was = oz_element_overlap_pair(one, other, !free);
    OzFieldPair is = oz_element_overlap_pair(one_now, other_now, !free);
    int64_t scar = oz_wear_scar(wear, of.a, of.b);
    double least = scar < 0 ? 0 : wear->scar[scar];
    double before = sqrt(fmax(oz_field_energy(&pair.one, &pair.other, &was), 0));
    double after = sqrt(fmax(oz_field_energy(&pair.one, &pair.other, &is), 0));
    before -= oz_beam_strength_least(before, least);
    after -= oz_beam_strength_least(after, least);
    return before * before - after * after;
}

static OzStatus ease_all(OzWear *wear, const OzScene *scene, const OzElementState *state,
                         const OzElementParting *parting)
{
    OzElementPairs pairs = {0};
    double sum = 0;
    int64_t first = 0;
    OZ_PASS(oz_element_pairs_renew(&pairs, parting->after, state->position));
    for (int64_t p = 0; p < pairs.count; p++) {
        sum += ease(wear, scene, state, parting, pairs.pair[p]);
    }
    while (wear->whole[first] > 0) {
        first++;
    }
    wear->lost[first] += scene->triangles.stiffness * sum;
    oz_element_pairs_free(&pairs);
    return OZ_OK;
}

OzStatus oz_element_part_contacts(OzWear *wear, const OzScene *scene, const OzElementState *state,
                                  const OzElementParting *parting)
{
    OZ_USE_SWITCHES(oz_host_switches_elements(scene));
    if (parting->edges_before) {
        OZ_PASS(ease_all(wear, scene, state, parting));
    }
    note_depths(wear, state, parting);
    return OZ_OK;
}

static OzStatus list_edges(int **edges, const OzScene *scene, const OzElements *elements)
{
    *edges = NULL;
    if (scene->triangles.overlap != OZ_OVERLAP_FIELD) {
        return OZ_OK;
    }
    OZ_PASS(OZ_NEW(edges, elements->count));
    for (int64_t i = 0; i < elements->count; i++) {
        (*edges)[i] = oz_elements_outer_edges(elements, i);
    }
    return OZ_OK;
}

OzStatus oz_element_part_grains(OzElementForces *forces, const OzGrains *grains,
                                const OzElementState *state)
{
    OzStatus status = OZ_OK;
    OzGrains *pieces = NULL;
    int *edges = NULL;
    const int *before = forces->elements->body;
    size_t bytes = (size_t)grains->elements->free_count * sizeof *before;
    forces->bear.broke = false;
    OZ_TRY(oz_pieces_make(&pieces, grains, forces->bear.wear->whole, state->position));
    if (memcmp(before, pieces->elements->body, bytes) != 0) {
        OZ_TRY(list_edges(&edges, forces->scene, forces->elements));
        const OzElementParting parting = {before, edges, pieces->elements};
        OZ_TRY(oz_element_part_contacts(forces->bear.wear, forces->scene, state, &parting));
        oz_element_pairs_free(&forces->pairs); /* they are of other bodies */
        oz_pieces_free(forces->pieces);
        forces->pieces = pieces;
        forces->elements = pieces->elements;
        pieces = NULL;
    }
done:
    oz_pieces_free(pieces);
    free(edges);
    return status;
}
