/* Members that go on in pieces. */
#include "sim/element_mend.h"

#include "base/memory.h"
#include "model/wall_motion.h"
#include "sim/element_pack.h"
#include "sim/element_part.h"
#include "sim/element_private.h"
#include "sim/element_wear.h"

#include <stdlib.h>
#include <string.h>

/* The member's state where its launch stands, in pieces. */
static OzStatus look(OzSim *sim, int member, OzSnapshot *now)
{
    const OzElementParameters *p = oz_element_parameters(sim, member);
    const OzMember *of = &sim->batch.members[member];
    int64_t step = sim->batch.step + oz_element_control(sim, member)->step;
    OZ_PASS(oz_snapshot_create(now, of->scene, of->grains));
    now->time = oz_batch_time(&sim->batch, member, step);
    OZ_PASS(oz_element_pack_state(&sim->arrays, member, p, now));
    OZ_PASS(oz_element_wear_read(&sim->arrays, member, &p->units, &now->wear));
    OZ_PASS(oz_snapshot_split(now));
    oz_wall_motion_place(of->grains->elements, of->scene, now->time, sim->batch.walls_still,
                         now->element_position, now->element_angle, now->element_velocity,
                         now->element_angular_velocity);
    return OZ_OK;
}

/* Outer edges by element, where contacts have a potential. */
static OzStatus read_edges(const OzSim *sim, int member, const OzElements *elements, int **edges)
{
    OzStatus status = OZ_OK;
    int *words = NULL;
    *edges = NULL;
    if (!oz_element_switches(sim)->triangle_field) {
        return OZ_OK;
    }
    OZ_TRY(OZ_NEW(edges, elements->count));
    OZ_TRY(oz_arrays_download(&sim->arrays, OZ_ELEMENT_FIELD_outer_edges, member, &words));
    for (int64_t i = 0; i < elements->count; i++) {
        (*edges)[i] = words[oz_element_fields_slot(oz_element_sizes(sim), elements, i)];
    }
done:
    free(words);
    return status;
}

/* Bodies and contacts after a break that has parted a grain. */
static OzStatus part(OzSim *sim, int member, OzSnapshot *now, const int *before)
{
    OzStatus status = OZ_OK;
    int *edges = NULL;
    const OzElementState state = {.position = now->element_position,
                                  .angle = now->element_angle,
                                  .time = now->time,
                                  .at_rest = sim->batch.walls_still};
    OZ_TRY(read_edges(sim, member, now->whole->elements, &edges));
    const OzElementParting parting = {before, edges, now->grains->elements};
    OZ_TRY(oz_element_part_contacts(&now->wear, now->scene, &state, &parting));
    OZ_TRY(oz_element_wear_write(&sim->arrays, member, &oz_element_parameters(sim, member)->units,
                                 &now->wear));
    OZ_TRY(oz_element_pack_bodies(&sim->arrays, member, now->whole,
                                  oz_element_own(sim)->present[member]));
    OZ_TRY(oz_element_pack_outer_edges(&sim->arrays, member, now->grains->elements));
    oz_element_control(sim, member)->truth = OZ_SPRINGS_AT_NONE; /* all lists anew */
done:
    free(edges);
    return status;
}

OzStatus oz_element_mend_outline(OzSim *sim, int member)
{
    OzStatus status = OZ_OK;
    OzSnapshot now = {0};
    bool *known = &oz_element_own(sim)->outlined[member];
    if (*known || !oz_element_switches(sim)->strength ||
        !oz_element_switches(sim)->triangle_field) {
        return OZ_OK;
    }
    OZ_TRY(look(sim, member, &now));
    OZ_TRY(oz_element_pack_outer_edges(&sim->arrays, member, now.grains->elements));
    *known = true;
done:
    oz_snapshot_free(&now);
    return status;
}

OzStatus oz_element_mend_member(OzSim *sim, int member)
{
    OzStatus status = OZ_OK;
    OzSnapshot now = {0};
    OzElementControl *control = oz_element_control(sim, member);
    int *before = NULL;
    if (control->stop_bits != OZ_ELEMENT_STOP_BROKE) {
        return OZ_OK;
    }
    OZ_TRY(look(sim, member, &now));
    OZ_TRY(oz_arrays_download(&sim->arrays, OZ_ELEMENT_FIELD_body, member, &before));
    size_t bytes = (size_t)now.whole->elements->free_count * sizeof *before;
    if (memcmp(before, now.grains->elements->body, bytes) != 0) {
        OZ_TRY(part(sim, member, &now, before));
    }
    control->stop_bits = 0;
    control->stop_step = control->stop_index = OZ_NEVER;
done:
    oz_snapshot_free(&now);
    free(before);
    return status;
}

OzStatus oz_element_mend_start_ledger(OzSim *sim, int member)
{
    OzStatus status = OZ_OK;
    OzWear wear = {0};
    const OzUnits one = {1, 1, 1};
    if (!oz_element_switches(sim)->strength) {
        return OZ_OK;
    }
    OZ_TRY(oz_wear_create(&wear, sim->batch.members[member].grains->elements));
    OZ_TRY(oz_element_wear_read(&sim->arrays, member, &one, &wear));
    memset(wear.lost, 0, (size_t)wear.beam_count * sizeof *wear.lost);
    memset(wear.yielded, 0, (size_t)wear.beam_count * sizeof *wear.yielded);
    OZ_TRY(oz_element_wear_write(&sim->arrays, member, &one, &wear));
done:
    oz_wear_free(&wear);
    return status;
}
