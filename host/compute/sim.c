/* Running the kernels: launches, growth of lists, guards. */
#include "compute/sim_private.h"

#include "base/clock.h"
#include "base/memory.h"
#include "compute/cl_try.h"
#include "compute/company.h"
#include "compute/launch.h"
#include "compute/pack.h"
#include "compute/program.h"
#include "compute/sizes.h"

#include <stdlib.h>

/* The device's idea of the shared structs against ours. */
static OzStatus check_layout(const OzSim *sim, const OzSwitches *switches)
{
    OzLayout layout = {.parameters = sizeof(OzParameters) / sizeof(double),
                       .control = sizeof(OzControl),
                       .sizes = sizeof(OzSizes),
                       .lanes = switches->lanes,
                       .is_double = switches->is_double != 0};
    return oz_program_check(sim->program, sim->device, &layout);
}

OzStatus oz_sim_write_parameters(OzSim *sim)
{
    OzStatus status = OZ_OK;
    for (int m = 0; m < sim->crew.member_count; m++) {
        OZ_TRY(oz_pack_parameters(&sim->arrays, m, &sim->parameters[m]));
    }
done:
    return status;
}

/* Parameters, lists' sizes and the start of every member. */
static OzStatus upload_start(OzSim *sim)
{
    OzStatus status = OZ_OK;
    for (int m = 0; m < sim->crew.member_count; m++) {
        OZ_TRY(oz_pack_start(&sim->arrays, m, &sim->parameters[m], sim->crew.members[m].grains));
        sim->control[m] = (OzControl){.stale_step = OZ_NEVER,
                                      .stale_places = OZ_NEVER,
                                      .stop_step = OZ_NEVER,
                                      .stop_index = OZ_NEVER,
                                      .truth = OZ_TRUTH_NONE};
    }
    OZ_TRY(oz_sim_write_parameters(sim));
done:
    return status;
}

/* Switches and sizes, which all members must share. */
static OzStatus choose_layout(OzSim *sim, OzSwitches *switches, OzSizes *sizes)
{
    OzStatus status = OZ_OK;
    for (int m = 0; m < sim->crew.member_count; m++) {
        const OzMember *member = &sim->crew.members[m];
        OzSwitches s = oz_switches_derive(member->scene, member->grains, sim->device);
        OzSizes z;
        OZ_TRY(
            oz_constants_fill(&sim->parameters[m], sim->wall_order, member->scene, member->grains));
        oz_sizes_choose(&z, &sim->parameters[m], member->scene, member->grains, &s,
                        sim->crew.member_count);
        if (m > 0 && !oz_company_fits(sim->device, &sim->crew.members[0], member)) {
            status = oz_status_fail(OZ_ERR_INPUT,
                                    "%s: members of one launch must have the same "
                                    "features, number of grains, step and settling",
                                    member->scene->path);
            goto done;
        }
        *switches = s;
        *sizes = z;
    }
done:
    return status;
}

static OzStatus build(OzSim *sim, const OzSwitches *switches, const char *source_dir)
{
    OzStatus status = OZ_OK;
    cl_int code = CL_SUCCESS;
    char options[1024];
    OZ_TRY(oz_device_check_double(sim->device, switches->is_double || switches->ledger));
    oz_switches_options(switches, options, sizeof options);
    const char *name = switches->resort ? "kernels/rods_large.cl" : "kernels/rods.cl";
    OZ_TRY(oz_program_build(&sim->program, sim->device, source_dir, name, options));
    if (switches->resort) {
        OZ_TRY(oz_large_create(&sim->large, sim->program, sim->device, switches));
    } else {
        sim->advance = clCreateKernel(sim->program, "oz_advance", &code);
        CL_TRY(code);
    }
    OZ_TRY(check_layout(sim, switches));
done:
    return status;
}

OzStatus oz_sim_create(OzSim **out, const OzDevice *device, const OzMember *members,
                       int member_count, const char *source_dir)
{
    OzStatus status = OZ_OK;
    OzSim *sim = NULL;
    OzSwitches switches = {0};
    OzSizes sizes = {0};
    *out = NULL;
    OZ_TRY(OZ_NEW(&sim, 1));
    sim->device = device;
    OZ_TRY(oz_crew_create(&sim->crew, members, member_count));
    OZ_TRY(OZ_NEW(&sim->parameters, member_count));
    OZ_TRY(OZ_NEW(&sim->control, member_count));
    OZ_TRY(OZ_NEW(&sim->spring_start, member_count));
    OZ_TRY(choose_layout(sim, &switches, &sizes));
    OZ_TRY(build(sim, &switches, source_dir));
    OZ_TRY(oz_arrays_create(&sim->arrays, device, &switches, &sizes));
    OZ_TRY(upload_start(sim));
    OZ_TRY(oz_launch_steps(sim, 0));
    *out = sim;
    sim = NULL;
done:
    oz_sim_free(sim);
    return status;
}

void oz_sim_free(OzSim *sim)
{
    if (!sim) {
        return;
    }
    oz_arrays_free(&sim->arrays);
    oz_large_free(sim->large);
    if (sim->advance) {
        clReleaseKernel(sim->advance);
    }
    if (sim->program) {
        clReleaseProgram(sim->program);
    }
    oz_crew_free(&sim->crew);
    free(sim->parameters);
    free(sim->control);
    free(sim->spring_start);
    free(sim);
}

/* Where places move before the forces, the first accelerations are needed: forces at the start, over
 * no time. */
OzStatus oz_sim_prime(OzSim *sim)
{
    OzStatus status = OZ_OK;
    if (!sim->arrays.switches.moves_before || sim->primed) {
        return OZ_OK;
    }
    double step = sim->parameters[0].dt;
    for (int m = 0; m < sim->crew.member_count; m++) {
        sim->parameters[m].dt = 0;
    }
    OZ_TRY(oz_sim_write_parameters(sim));
    OZ_TRY(oz_launch_steps(sim, 1));
    sim->crew.step -= 1;
    sim->crew.counts.steps -= 1;
    sim->primed = true;
    for (int m = 0; m < sim->crew.member_count; m++) {
        sim->crew.reached[m] -= 1;
        sim->parameters[m].dt = step;
    }
    OZ_TRY(oz_sim_write_parameters(sim));
done:
    return status;
}

OzStatus oz_sim_launch(OzSim *sim, int64_t step)
{
    OzStatus status = OZ_OK;
    OZ_TRY(oz_sim_prime(sim));
    if (sim->crew.step >= step || sim->arrays.sizes.count == 0) {
        oz_crew_skip(&sim->crew, step);
        goto done;
    }
    int steps = oz_crew_launch_steps(&sim->crew, step);
    double start = oz_clock_now();
    OZ_TRY(oz_launch_steps(sim, steps));
    oz_crew_note_launch(&sim->crew, steps, oz_clock_now() - start, sim->arrays.sizes.motion_steps);
done:
    return status;
}

OzStatus oz_sim_advance(OzSim *sim, int64_t step)
{
    OzStatus status = OZ_OK;
    while (status == OZ_OK && sim->crew.step < step) {
        status = oz_sim_launch(sim, step);
    }
    return status;
}

int64_t oz_sim_step(const OzSim *sim)
{
    return sim->crew.step;
}

const char *oz_sim_stopped(const OzSim *sim, int member)
{
    return sim->crew.stopped[member];
}

OzSimCounts oz_sim_counts(const OzSim *sim)
{
    OzSimCounts counts = sim->crew.counts;
    counts.refreshes = counts.rebuilds = counts.crossed = 0;
    for (int m = 0; m < sim->crew.member_count; m++) {
        counts.refreshes += sim->control[m].refreshes;
        counts.rebuilds += sim->control[m].rebuilds;
        counts.crossed += sim->control[m].crossed;
    }
    counts.refreshes /= sim->crew.member_count;
    counts.rebuilds /= sim->crew.member_count;
    return counts;
}

OzStatus oz_sim_describe(const OzDevice *device, const OzScene *scene, const OzGrains *grains,
                         FILE *file)
{
    OzStatus status = OZ_OK;
    OzParameters parameters;
    int order[OZ_WALLS_MAX];
    OzSizes sizes;
    OzSwitches switches = oz_switches_derive(scene, grains, device);
    OZ_TRY(oz_constants_fill(&parameters, order, scene, grains));
    oz_sizes_choose(&sizes, &parameters, scene, grains, &switches, 1);
    oz_switches_print(&switches, file);
    fprintf(file, "device memory of one scene on %s:\n", device->name);
    oz_arrays_print(&switches, &sizes, file);
done:
    return status;
}
