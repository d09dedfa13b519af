/* Running a model's kernels: layout, program, uploads, launches of a length that suits. */
#include "sim/sim_private.h"

#include "base/clock.h"
#include "base/memory.h"
#include "compute/cl_try.h"
#include "compute/program.h"
#include "sim/batch_fit.h"
#include "sim/launch.h"
#include "sim/models.h"

#include <stdlib.h>
#include <string.h>

OzStatus oz_sim_write_parameters(OzSim *sim)
{
    for (int m = 0; m < sim->batch.member_count; m++) {
        OZ_PASS(sim->model->write_parameters(sim, m));
    }
    return OZ_OK;
}

/* One member's layout into what all share. */
static OzStatus take_layout(OzSim *sim, int m, const OzModelLayout *own, OzModelLayout *shared)
{
    const OzMember *member = &sim->batch.members[m];
    if (m > 0 && !oz_batch_fit_agrees(sim->device, &sim->batch.members[0], member)) {
        return oz_status_fail(OZ_ERR_INPUT, "%s: members of one launch must have the same %s",
                              member->scene->path, sim->model->alike);
    }
    memcpy(oz_sim_parameters(sim, m), own->parameters, sim->model->parameters_bytes);
    if (m > 0) {
        sim->model->join(shared->sizes, own->sizes);
    }
    sim->is_empty = sim->is_empty && member->grains->count == 0;
    return OZ_OK;
}

/* A member's layout, in the units of the simulation that it goes on from, if there is one. */
static OzStatus layout_of(OzModelLayout *layout, const OzSim *sim, int m, const OzSim *running)
{
    return oz_model_layout(layout, sim->model, &sim->batch.members[m], sim->device,
                           running ? oz_sim_parameters(running, m) : NULL);
}

/* Switches, which all members must share, and sizes that serve all; arrays of these. */
static OzStatus choose_layout(OzSim *sim, const OzSim *running)
{
    OzStatus status = OZ_OK;
    OzModelLayout shared = {0}, own = {0};
    OZ_TRY(layout_of(&shared, sim, 0, running));
    OZ_TRY(take_layout(sim, 0, &shared, &shared));
    for (int m = 1; m < sim->batch.member_count; m++) {
        OZ_TRY(layout_of(&own, sim, m, running));
        OZ_TRY(take_layout(sim, m, &own, &shared));
        oz_model_layout_free(&own);
    }
    ((OzSizesHead *)shared.sizes)->members = sim->batch.member_count;
    OZ_TRY(oz_arrays_create(&sim->arrays, sim->device, sim->model, shared.switches, shared.sizes));
done:
    oz_model_layout_free(&own);
    oz_model_layout_free(&shared);
    return status;
}

/* Whether any array is in double whatever the precision. */
static bool sums_up(const OzSim *sim)
{
    bool any = false;
    for (int f = 0; f < sim->model->field_count; f++) {
        bool is_wide = sim->model->fields[f].kind == OZ_STATE_DOUBLE;
        any |= is_wide && oz_arrays_bytes(&sim->arrays, f) > 0;
    }
    return any;
}

/* The program, and the device's idea of the shared structs against ours. */
static OzStatus build(OzSim *sim, const char *source_dir)
{
    char options[1024];
    const OzModel *model = sim->model;
    const OzSwitchesHead *switches = oz_arrays_switches(&sim->arrays);
    const OzLayout layout = {.parameters = model->parameters_bytes / sizeof(double),
                             .control = model->control_bytes,
                             .sizes = model->sizes_bytes,
                             .lanes = switches->lanes,
                             .is_double = switches->is_double != 0};
    OZ_PASS(oz_device_check_double(sim->device, switches->is_double || sums_up(sim)));
    oz_model_options(model, switches, options, sizeof options);
    OZ_PASS(oz_program_build(&sim->program, sim->device, source_dir, model->program, options));
    OZ_PASS(oz_launch_open(sim));
    OZ_PASS(model->open(sim));
    return oz_program_check(sim->program, sim->device, &layout);
}

static OzStatus create(OzSim *sim, const OzMember *members, int member_count,
                       const char *source_dir, const OzSim *running)
{
    OZ_PASS(oz_batch_create(&sim->batch, members, member_count));
    OZ_PASS(oz_memory_new(&sim->parameters, (size_t)member_count, sim->model->parameters_bytes,
                          "parameters"));
    OZ_PASS(oz_memory_new(&sim->control, (size_t)member_count, sim->model->control_bytes,
                          "control words"));
    OZ_PASS(choose_layout(sim, running));
    OZ_PASS(build(sim, source_dir));
    return sim->model->start(sim);
}

OzStatus oz_sim_create(OzSim **sim, const OzDevice *device, const OzMember *members,
                       int member_count, const char *source_dir)
{
    return oz_sim_create_after(sim, device, members, member_count, source_dir, NULL);
}

OzStatus oz_sim_create_after(OzSim **out, const OzDevice *device, const OzMember *members,
                             int member_count, const char *source_dir, const OzSim *running)
{
    OzStatus status = OZ_OK;
    OzSim *sim = NULL;
    *out = NULL;
    OZ_TRY(OZ_NEW(&sim, 1));
    sim->device = device;
    sim->model = oz_models_of(members[0].scene);
    sim->is_empty = true;
    OZ_TRY(create(sim, members, member_count, source_dir, running));
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
    sim->model->close(sim);
    oz_large_free(sim->large);
    CL_RELEASE(Kernel, sim->advance);
    CL_RELEASE(Program, sim->program);
    oz_batch_free(&sim->batch);
    free(sim->parameters);
    free(sim->control);
    free(sim);
}

OzStatus oz_sim_launch(OzSim *sim, int64_t step)
{
    int made = 0;
    if (sim->model->prime) {
        OZ_PASS(sim->model->prime(sim));
    }
    if (sim->batch.step >= step || sim->is_empty) {
        oz_batch_skip(&sim->batch, step);
        return OZ_OK;
    }
    int steps = oz_batch_launch_steps(&sim->batch, step);
    double start = oz_clock_now();
    OZ_PASS(oz_launch_steps(sim, steps, &made));
    oz_batch_note_launch(&sim->batch, made, oz_clock_now() - start,
                         oz_arrays_sizes(&sim->arrays)->motion_steps);
    return OZ_OK;
}

OzStatus oz_sim_advance(OzSim *sim, int64_t step)
{
    OzStatus status = OZ_OK;
    while (status == OZ_OK && sim->batch.step < step) {
        status = oz_sim_launch(sim, step);
    }
    return status;
}

int64_t oz_sim_step(const OzSim *sim)
{
    return sim->batch.step;
}

/* Members that go on have one clock; of the others each has its last. */
const OzStepClock *oz_sim_clock(const OzSim *sim)
{
    int m = 0;
    while (m < sim->batch.member_count - 1 && sim->batch.stopped[m]) {
        m++;
    }
    return &sim->batch.clock[m];
}

double oz_sim_time(const OzSim *sim)
{
    return oz_step_clock_time(oz_sim_clock(sim), sim->batch.step);
}

const OzScene *oz_sim_scene(const OzSim *sim, int member)
{
    return sim->batch.members[member].scene;
}

const char *oz_sim_stopped(const OzSim *sim, int member)
{
    return sim->batch.stopped[member];
}

OzSimCounts oz_sim_counts(const OzSim *sim)
{
    OzSimCounts counts = sim->batch.counts;
    counts.refreshes = counts.rebuilds = counts.crossed = 0;
    for (int m = 0; m < sim->batch.member_count; m++) {
        const OzControlHead *control = oz_sim_control(sim, m);
        counts.refreshes += control->refreshes;
        counts.rebuilds += control->rebuilds;
        counts.crossed += control->crossed;
    }
    counts.refreshes /= sim->batch.member_count;
    counts.rebuilds /= sim->batch.member_count;
    return counts;
}

OzStatus oz_sim_describe(const OzDevice *device, const OzScene *scene, const OzGrains *grains,
                         FILE *file)
{
    OzStatus status = OZ_OK;
    const OzModel *model = oz_models_of(scene);
    const OzMember member = {scene, grains};
    OzModelLayout layout;
    OZ_TRY(oz_model_layout(&layout, model, &member, device, NULL));
    oz_model_print_switches(model, layout.switches, file);
    fprintf(file, "device memory of one scene on %s:\n", device->name);
    oz_arrays_print(model, layout.switches, layout.sizes, grains, file);
done:
    oz_model_layout_free(&layout);
    return status;
}
