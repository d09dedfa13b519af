/* Uploading the start of trigrains. */
#include "compute/piece_upload.h"

#include "base/memory.h"
#include "compute/piece_forces.h"
#include "compute/piece_pack.h"
#include "compute/piece_private.h"
#include "compute/piece_reference.h"
#include "model/wall_motion.h"

#include <stdlib.h>
#include <string.h>

/* The start as a snapshot, walls included. */
static void fill_start(OzSnapshot *now, bool at_rest)
{
    const OzPieces *pieces = now->grains->pieces;
    size_t count = (size_t)pieces->count;
    memcpy(now->piece_position, pieces->position, 2 * count * sizeof(double));
    memcpy(now->piece_angle, pieces->angle, count * sizeof(double));
    memcpy(now->piece_velocity, pieces->velocity, 2 * count * sizeof(double));
    memcpy(now->piece_spin, pieces->spin, count * sizeof(double));
    oz_wall_motion_place(pieces, now->scene, 0, at_rest, now->piece_position, now->piece_angle,
                         now->piece_velocity, now->piece_spin);
}

/* How fast the ledger grows; and, where beams go in substeps, what contacts do apart from beams and
 * gravity. */
static OzStatus derive_forces(OzPieceStart *start, const OzSnapshot *now, bool at_rest, bool parts)
{
    OzStatus status = OZ_OK;
    const OzPieces *pieces = now->grains->pieces;
    OzPieceForces forces = {0};
    OzPieceState state = {.position = now->piece_position,
                          .angle = now->piece_angle,
                          .velocity = now->piece_velocity,
                          .spin = now->piece_spin,
                          .at_rest = at_rest};
    OZ_TRY(oz_piece_forces_create(&forces, now->scene, now->grains));
    OZ_TRY(parts ? oz_piece_forces_touch(&forces, &state)
                 : oz_piece_forces_evaluate(&forces, &state));
    start->power = forces.power;
    for (int64_t i = 0; parts && i < pieces->free_count; i++) {
        double *touch = &start->touch[3 * i], *acceleration = &start->acceleration[3 * i];
        memcpy(touch, &forces.force[2 * i], 2 * sizeof *touch);
        touch[2] = forces.torque[i];
        acceleration[0] -= touch[0] / pieces->mass[i];
        acceleration[1] -= touch[1] / pieces->mass[i];
        acceleration[2] -= touch[2] / pieces->inertia[i];
    }
done:
    oz_piece_forces_free(&forces);
    return status;
}

/* Derivatives at the start, which all integrators begin with. */
static OzStatus derive_start(OzPieceStart *start, const OzMember *member, bool parts)
{
    OzStatus status = OZ_OK;
    size_t count = 3 * (size_t)member->grains->pieces->free_count;
    OzSnapshot now = {0};
    bool at_rest = member->scene->settle.present;
    OZ_TRY(OZ_NEW(&start->acceleration, count));
    OZ_TRY(OZ_NEW(&start->third, count));
    OZ_TRY(OZ_NEW(&start->fourth, count));
    OZ_TRY(OZ_NEW(&start->touch, count));
    OZ_TRY(oz_snapshot_create(&now, member->scene, member->grains));
    fill_start(&now, at_rest);
    OZ_TRY(oz_piece_reference_start_derivatives(&now, at_rest, start->acceleration, start->third,
                                                start->fourth));
    OZ_TRY(derive_forces(start, &now, at_rest, parts));
done:
    oz_snapshot_free(&now);
    return status;
}

OzStatus oz_piece_upload_member(OzSim *sim, int m)
{
    OzStatus status = OZ_OK;
    OzPieceStart start = {0};
    const OzMember *member = &sim->crew.members[m];
    const OzPieces *pieces = member->grains->pieces;
    OZ_TRY(derive_start(&start, member, oz_piece_switches(sim)->substeps > 1));
    OZ_TRY(
        oz_piece_pack_start(&sim->arrays, m, oz_piece_parameters(sim, m), member->grains, &start));
    oz_piece_own(sim)->present[m] = ~0U;
    *oz_piece_control(sim, m) =
        (OzPieceControl){.free_count = (int)pieces->free_count,
                         .wall_count = (int)(pieces->count - pieces->free_count),
                         .beam_count = (int)pieces->beam_count,
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
