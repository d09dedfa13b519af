/* Running trigrains' kernels: programs, uploads, launches of a length that suits. */
#include "compute/piece_sim.h"

#include "base/clock.h"
#include "base/memory.h"
#include "compute/cl_try.h"
#include "compute/piece_company.h"
#include "compute/piece_forces.h"
#include "compute/piece_launch.h"
#include "compute/piece_pack.h"
#include "compute/piece_private.h"
#include "compute/piece_reference.h"
#include "compute/piece_sizes.h"
#include "compute/program.h"
#include "model/wall_motion.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The device's idea of the shared structs against ours. */
static OzStatus check_layout(const OzPieceSim *sim, const OzPieceSwitches *switches)
{
    OzLayout layout = {.parameters = sizeof(OzPieceParameters) / sizeof(double),
                       .control = sizeof(OzPieceControl),
                       .sizes = sizeof(OzPieceSizes),
                       .lanes = switches->lanes,
                       .is_double = switches->is_double != 0};
    return oz_program_check(sim->program, sim->device, &layout);
}

OzStatus oz_piece_sim_write_parameters(OzPieceSim *sim)
{
    OzStatus status = OZ_OK;
    for (int m = 0; m < sim->crew.member_count; m++) {
        OZ_TRY(oz_piece_pack_parameters(&sim->arrays, m, &sim->parameters[m]));
    }
done:
    return status;
}

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

static OzStatus upload_member(OzPieceSim *sim, int m)
{
    OzStatus status = OZ_OK;
    OzPieceStart start = {0};
    const OzMember *member = &sim->crew.members[m];
    const OzPieces *pieces = member->grains->pieces;
    OZ_TRY(derive_start(&start, member, sim->arrays.switches.substeps > 1));
    OZ_TRY(oz_piece_pack_start(&sim->arrays, m, &sim->parameters[m], member->grains, &start));
    sim->present[m] = ~0U;
    sim->control[m] = (OzPieceControl){.free_count = (int)pieces->free_count,
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

static OzStatus upload_start(OzPieceSim *sim)
{
    OzStatus status = OZ_OK;
    for (int m = 0; m < sim->crew.member_count; m++) {
        OZ_TRY(upload_member(sim, m));
    }
    OZ_TRY(oz_piece_sim_write_parameters(sim));
    OZ_TRY(oz_piece_launch_begin(sim));
done:
    return status;
}

/* Switches, which all members must share, and sizes that serve all. */
static OzStatus choose_layout(OzPieceSim *sim, OzPieceSwitches *switches, OzPieceSizes *sizes)
{
    OzStatus status = OZ_OK;
    for (int m = 0; m < sim->crew.member_count; m++) {
        const OzMember *member = &sim->crew.members[m];
        OzPieceSizes own;
        *switches = oz_piece_switches_derive(member->scene, member->grains, sim->device);
        OZ_TRY(oz_piece_sizes_parameters(&sim->parameters[m], member->scene, member->grains));
        oz_piece_sizes_choose(&own, &sim->parameters[m], member->scene, member->grains, switches);
        if (m > 0 && !oz_piece_company_fits(sim->device, &sim->crew.members[0], member)) {
            status = oz_status_fail(OZ_ERR_INPUT,
                                    "%s: members of one launch must have the same features, walls, "
                                    "step and settling",
                                    member->scene->path);
            goto done;
        }
        if (m == 0) {
            *sizes = own;
        } else {
            oz_piece_sizes_join(sizes, &own);
        }
    }
done:
    return status;
}

static OzStatus build(OzPieceSim *sim, const OzPieceSwitches *switches, const char *source_dir)
{
    OzStatus status = OZ_OK;
    cl_int code = CL_SUCCESS;
    char options[1024];
    OZ_TRY(oz_device_check_double(sim->device, switches->is_double || switches->ledger));
    oz_piece_switches_options(switches, options, sizeof options);
    OZ_TRY(
        oz_program_build(&sim->program, sim->device, source_dir, "kernels/trigrains.cl", options));
    sim->advance = clCreateKernel(sim->program, "oz_advance", &code);
    CL_TRY(code);
    sim->begin = clCreateKernel(sim->program, "oz_begin", &code);
    CL_TRY(code);
    OZ_TRY(check_layout(sim, switches));
done:
    return status;
}

OzStatus oz_piece_sim_create(OzPieceSim **out, const OzDevice *device, const OzMember *members,
                             int member_count, const char *source_dir)
{
    OzStatus status = OZ_OK;
    OzPieceSim *sim = NULL;
    OzPieceSwitches switches = {0};
    OzPieceSizes sizes = {0};
    *out = NULL;
    OZ_TRY(OZ_NEW(&sim, 1));
    sim->device = device;
    OZ_TRY(oz_crew_create(&sim->crew, members, member_count));
    sim->crew.walls_still = members[0].scene->settle.present;
    OZ_TRY(OZ_NEW(&sim->parameters, member_count));
    OZ_TRY(OZ_NEW(&sim->control, member_count));
    OZ_TRY(OZ_NEW(&sim->present, member_count));
    OZ_TRY(choose_layout(sim, &switches, &sizes));
    OZ_TRY(build(sim, &switches, source_dir));
    OZ_TRY(oz_piece_arrays_create(&sim->arrays, device, &switches, &sizes));
    OZ_TRY(upload_start(sim));
    *out = sim;
    sim = NULL;
done:
    oz_piece_sim_free(sim);
    return status;
}

void oz_piece_sim_free(OzPieceSim *sim)
{
    if (!sim) {
        return;
    }
    oz_piece_arrays_free(&sim->arrays);
    if (sim->advance) {
        clReleaseKernel(sim->advance);
    }
    if (sim->begin) {
        clReleaseKernel(sim->begin);
    }
    if (sim->program) {
        clReleaseProgram(sim->program);
    }
    oz_crew_free(&sim->crew);
    free(sim->parameters);
    free(sim->control);
    free(sim->present);
    free(sim);
}

OzStatus oz_piece_sim_launch(OzPieceSim *sim, int64_t step)
{
    OzStatus status = OZ_OK;
    int made = 0;
    if (sim->crew.step >= step || sim->arrays.sizes.free_slots == 0) {
        oz_crew_skip(&sim->crew, step);
        goto done;
    }
    int steps = oz_crew_launch_steps(&sim->crew, step);
    double start = oz_clock_now();
    OZ_TRY(oz_piece_launch_steps(sim, steps, &made));
    oz_crew_note_launch(&sim->crew, made, oz_clock_now() - start, sim->arrays.sizes.motion_steps);
done:
    return status;
}

int64_t oz_piece_sim_step(const OzPieceSim *sim)
{
    return sim->crew.step;
}

const char *oz_piece_sim_stopped(const OzPieceSim *sim, int member)
{
    return sim->crew.stopped[member];
}

OzSimCounts oz_piece_sim_counts(const OzPieceSim *sim)
{
    OzSimCounts counts = sim->crew.counts;
    counts.refreshes = counts.rebuilds = counts.crossed = 0;
    for (int m = 0; m < sim->crew.member_count; m++) {
        counts.refreshes += sim->control[m].refreshes;
        counts.rebuilds += sim->control[m].rebuilds;
    }
    counts.refreshes /= sim->crew.member_count;
    counts.rebuilds /= sim->crew.member_count;
    return counts;
}

OzStatus oz_piece_sim_describe(const OzDevice *device, const OzScene *scene, const OzGrains *grains,
                               FILE *file)
{
    OzStatus status = OZ_OK;
    OzPieceParameters parameters;
    OzPieceSizes sizes;
    OzPieceSwitches switches = oz_piece_switches_derive(scene, grains, device);
    OZ_TRY(oz_piece_sizes_parameters(&parameters, scene, grains));
    oz_piece_sizes_choose(&sizes, &parameters, scene, grains, &switches);
    oz_piece_switches_print(&switches, file);
    fprintf(file, "device memory of one scene on %s:\n", device->name);
    oz_piece_arrays_print(&switches, &sizes, grains->pieces->count, file);
done:
    return status;
}
