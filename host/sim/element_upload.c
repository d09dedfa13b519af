/* Uploading the start of trigrains. */
#include "sim/element_upload.h"

#include "base/memory.h"
#include "model/wall_motion.h"
#include "sim/element_forces.h"
#include "sim/element_pack.h"
#include "sim/element_private.h"
#include "sim/element_reference.h"

#include <stdlib.h>
#include <string.h>

/* The start as a snapshot, walls included. */
static void fill_start(OzSnapshot *now, bool at_rest)
{
    const OzElements *elements = now->grains->elements;
    size_t count = (size_t)elements->count;
    memcpy(now->element_position, elements->position, 2 * count * sizeof(double));
    memcpy(now->element_angle, elements->angle, count * sizeof(double));
    memcpy(now->element_velocity, elements->velocity, 2 * count * sizeof(double));
    memcpy(now->element_angular_velocity, elements->angular_velocity, count * sizeof(double));
    oz_wall_motion_place(elements, now->scene, 0, at_rest, now->element_position,
                         now->element_angle, now->element_velocity, now->element_angular_velocity);
}

/* How fast the ledger grows; and, where beams go in substeps, what contacts do apart from beams and
 * gravity. */
static OzStatus derive_forces(OzElementStart *start, const OzSnapshot *now, bool at_rest,
                              bool parts)
{
    OzStatus status = OZ_OK;
    const OzElements *elements = now->grains->elements;
    OzElementForces forces = {0};
    OzElementState state = {.position = now->element_position,
                            .angle = now->element_angle,
                            .velocity = now->element_velocity,
                            .angular_velocity = now->element_angular_velocity,
                            .at_rest = at_rest};
    OZ_TRY(oz_element_forces_create(&forces, now->scene, now->grains));
    OZ_TRY(parts ? oz_element_forces_touch(&forces, &state)
                 : oz_element_forces_evaluate(&forces, &state));
    start->power = forces.power;
    for (int64_t i = 0; parts && i < elements->free_count; i++) {
        double *touch = &start->touch[3 * i], *acceleration = &start->acceleration[3 * i];
        memcpy(touch, &forces.force[2 * i], 2 * sizeof *touch);
        touch[2] = forces.torque[i];
        acceleration[0] -= touch[0] / elements->mass[i];
        acceleration[1] -= touch[1] / elements->mass[i];
        acceleration[2] -= touch[2] / elements->inertia[i];
    }
done:
    oz_element_forces_free(&forces);
    return status;
}

/* Derivatives at the start, which all integrators begin with. */
static OzStatus derive_start(OzElementStart *start, const OzMember *member, bool parts)
{
    OzStatus status = OZ_OK;
    size_t count = 3 * (size_t)member->grains->elements->free_count;
    OzSnapshot now = {0};
    bool at_rest = member->scene->settle.present;
    OZ_TRY(OZ_NEW(&start->acceleration, count));
    OZ_TRY(OZ_NEW(&start->third, count));
    OZ_TRY(OZ_NEW(&start->fourth, count));
    OZ_TRY(OZ_NEW(&start->touch, count));
    OZ_TRY(oz_snapshot_create(&now, member->scene, member->grains));
    fill_start(&now, at_rest);
    OZ_TRY(oz_element_reference_start_derivatives(&now, at_rest, start->acceleration, start->third,
                                                  start->fourth));
    OZ_TRY(derive_forces(start, &now, at_rest, parts));
done:
    oz_snapshot_free(&now);
    return status;
}

OzStatus oz_element_upload_member(OzSim *sim, int m)
{
    OzStatus status = OZ_OK;
    OzElementStart start = {0};
    const OzMember *member = &sim->batch.members[m];
    const OzElements *elements = member->grains->elements;
    OZ_TRY(derive_start(&start, member, oz_element_switches(sim)->substeps > 1));
    OZ_TRY(oz_element_pack_start(&sim->arrays, m, oz_element_parameters(sim, m), member->grains,
                                 &start));
    oz_element_own(sim)->present[m] = ~0U;
    *oz_element_control(sim, m) =
        (OzElementControl){.free_count = (int)elements->free_count,
                           .wall_count = (int)(elements->count - elements->free_count),
                           .beam_count = (int)elements->beam_count,
                           .stale_step = OZ_NEVER,
                           .stale_positions = OZ_NEVER,
                           .stop_step = OZ_NEVER,
                           .stop_index = OZ_NEVER,
                           .deep_step = OZ_NEVER,
                           .deep_index = OZ_NEVER};
done:
    free(start.acceleration);
    free(start.third);
    free(start.fourth);
    free(start.touch);
    return status;
}
