/* One launch: control words and what a model prepares down, the kernels until every member is
 * through, control words up. It knows no model. */
#include "sim/launch.h"

#include "base/log.h"
#include "base/memory.h"
#include "compute/cl_try.h"
#include "sim/deep.h"
#include "sim/guard.h"
#include "sim/read_snapshot.h"

#include <stdlib.h>
#include <string.h>

OzStatus oz_launch_write_control(OzSim *sim)
{
    for (int m = 0; m < sim->batch.member_count; m++) {
        OZ_PASS(oz_arrays_write(&sim->arrays, sim->model->control_field, m, oz_sim_control(sim, m),
                                sim->model->control_bytes));
    }
    return OZ_OK;
}

static OzStatus read_control(OzSim *sim)
{
    for (int m = 0; m < sim->batch.member_count; m++) {
        OZ_PASS(oz_arrays_read(&sim->arrays, sim->model->control_field, m, oz_sim_control(sim, m),
                               sim->model->control_bytes));
    }
    return OZ_OK;
}

OzStatus oz_launch_enqueue(OzSim *sim, cl_kernel kernel, int last)
{
    cl_uint next = 0;
    size_t group = (size_t)oz_arrays_switches(&sim->arrays)->group;
    size_t regions = (size_t)oz_arrays_sizes(&sim->arrays)->regions;
    size_t all = sim->large ? (regions + group - 1) / group * group
                            : group * (size_t)sim->batch.member_count;
    OZ_PASS(oz_arrays_bind(&sim->arrays, kernel, &next));
    if (last >= 0) {
        CL_PASS(clSetKernelArg(kernel, next, sizeof last, &last));
    }
    CL_PASS(
        clEnqueueNDRangeKernel(sim->device->queue, kernel, 1, NULL, &all, &group, 0, NULL, NULL));
    CL_PASS(clFinish(sim->device->queue));
    return OZ_OK;
}

OzStatus oz_launch_open(OzSim *sim)
{
    cl_int code = CL_SUCCESS;
    if (oz_arrays_switches(&sim->arrays)->resort) {
        return oz_large_create(&sim->large, sim->program, sim->device);
    }
    sim->advance = clCreateKernel(sim->program, "oz_advance", &code);
    CL_PASS(code);
    return OZ_OK;
}

OzStatus oz_launch_save_springs(OzSim *sim)
{
    OzStatus status = OZ_OK;
    cl_int code = CL_SUCCESS;
    cl_kernel kernel = NULL;
    if (sim->large) {
        return oz_large_save_springs(sim->large, &sim->arrays, oz_sim_control(sim, 0));
    }
    kernel = clCreateKernel(sim->program, "oz_save_springs", &code);
    CL_TRY(code);
    OZ_TRY(oz_launch_enqueue(sim, kernel, -1));
    OZ_TRY(read_control(sim));
done:
    CL_RELEASE(Kernel, kernel);
    return status;
}

/* Larger lists, after which the kernels take up where they stopped. */
static OzStatus grow_lists(OzSim *sim)
{
    OzStatus status = OZ_OK;
    OzSizesHead *sizes = NULL;
    int lanes = oz_arrays_switches(&sim->arrays)->lanes;
    OZ_TRY(oz_memory_new((void **)&sizes, sim->model->sizes_bytes, 1, "sizes"));
    memcpy(sizes, sim->arrays.sizes, sim->model->sizes_bytes);
    if (sim->batch.member_count > 1) {
        /* A member that is through holds its lists, which do not outlive new sizes. It makes them
         * again, with the same contacts, when it goes on. */
        OZ_TRY(oz_launch_save_springs(sim));
    }
    for (int m = 0; m < sim->batch.member_count; m++) {
        oz_arrays_grow(sizes, oz_sim_control(sim, m), lanes);
        oz_sim_control(sim, m)->full = 0;
    }
    oz_log_detail("lists grown at step %lld: outer %d, inner %d, back %d, triangles %d",
                  (long long)sim->batch.step, sizes->outer_capacity, sizes->inner_capacity,
                  sizes->back_capacity, sizes->face_capacity);
    sim->batch.counts.growths++;
    OZ_TRY(oz_arrays_resize(&sim->arrays, sizes));
done:
    free(sizes);
    return status;
}

static OzStatus run(OzSim *sim, int steps)
{
    if (sim->large) {
        return oz_large_steps(sim->large, &sim->arrays, oz_sim_control(sim, 0), steps);
    }
    OZ_PASS(oz_launch_enqueue(sim, sim->advance, steps));
    return read_control(sim);
}

/* Whether a member has made its steps, with lists that hold: snapshots read them. */
static bool is_through(const OzSim *sim, const OzControlHead *control, int steps)
{
    return control->step >= steps && control->truth == OZ_SPRINGS_AT_INNER &&
           control->stale_step == OZ_NEVER &&
           (!sim->large || control->stale_positions == OZ_NEVER); /* small scenes never ask */
}

/* Repeats the launch until every member is through. */
static OzStatus finish_launch(OzSim *sim, int steps)
{
    for (bool more = true; more;) {
        OZ_PASS(oz_launch_write_control(sim));
        OZ_PASS(run(sim, steps));
        sim->batch.counts.launches++;
        bool full = false;
        more = false;
        for (int m = 0; m < sim->batch.member_count; m++) {
            const OzControlHead *control = oz_sim_control(sim, m);
            if (control->stop_bits && sim->model->mend) {
                OZ_PASS(sim->model->mend(sim, m));
            }
            full |= control->full != 0;
            more |= !control->stop_bits && !is_through(sim, control, steps);
        }
        if (full) {
            OZ_PASS(grow_lists(sim));
        } else if (more && sim->model->supply) {
            OZ_PASS(sim->model->supply(sim));
        }
    }
    return OZ_OK;
}

/* A member that does not go on is at the launch's end already. */
static OzStatus begin_launch(OzSim *sim, int steps)
{
    for (int m = 0; m < sim->batch.member_count; m++) {
        OzControlHead *control = oz_sim_control(sim, m);
        control->deep_count = control->deep_depth = control->deep_kinds = 0;
        control->deep_step = control->deep_index = OZ_NEVER;
        int step = oz_batch_goes_on(&sim->batch, m) ? 0 : steps;
        control->front =
            (control->front + control->step + step) % 2; /* the records stay where they are */
        control->step = step;
        if (oz_batch_goes_on(&sim->batch, m)) {
            OZ_PASS(sim->model->prepare(sim, m, steps));
        }
    }
    return OZ_OK;
}

/* Deep contacts of a member that has not counted the launch's steps yet. The kernels' unit at a
 * wall is half of the radius (kernels/depth.h); it is told in radii. */
static void note_deep(OzSim *sim, int member)
{
    const OzControlHead *control = oz_sim_control(sim, member);
    bool at_wall = control->deep_kinds == OZ_DEEP_WALL;
    OzDeepFound found = {.count = control->deep_count};
    if (found.count > 0) {
        found.step = sim->batch.reached[member] + control->deep_step + 1;
        found.time = oz_batch_time(&sim->batch, member, found.step);
        found.grain = sim->model->grain_of(sim->batch.members[member].grains, control->deep_index);
        found.depth = control->deep_depth * (at_wall ? 0.5 : 1) / OZ_DEEP_SHARE;
        found.at_wall = at_wall;
    }
    oz_deep_note(&sim->batch, member, &found);
}

/* Says why a guard stopped a member. */
static OzStatus tell_stop(OzSim *sim, int member)
{
    OzSnapshot now = {0};
    const OzMember *of = &sim->batch.members[member];
    OzStatus status = oz_snapshot_create(&now, of->scene, of->grains);
    status = status == OZ_OK ? oz_read_snapshot_snapshot(sim, member, &now, false) : status;
    if (status == OZ_OK) {
        oz_guard_fail(sim->model, oz_sim_control(sim, member), &now, sim->batch.walls_still);
        status = oz_batch_stop(&sim->batch, member);
    }
    oz_snapshot_free(&now);
    return status;
}

/* Counts each member's steps and notes which ones a guard stopped. Fails with
 * OZ_ERR_BLOWUP when none is left. */
static OzStatus end_launch(OzSim *sim, int steps)
{
    int most = 0;
    for (int m = 0; m < sim->batch.member_count; m++) {
        const OzControlHead *control = oz_sim_control(sim, m);
        if (!oz_batch_goes_on(&sim->batch, m)) {
            continue;
        }
        int own = control->stop_bits ? control->stop_step + 1 : steps;
        note_deep(sim, m);
        oz_batch_count(&sim->batch, m, own, &most);
        if (control->stop_bits) {
            OZ_PASS(tell_stop(sim, m));
        }
    }
    return oz_batch_end_launch(&sim->batch, steps, most);
}

OzStatus oz_launch_steps(OzSim *sim, int64_t wanted, int *made)
{
    OzStatus status = OZ_OK;
    int64_t first = sim->batch.step, most = oz_arrays_sizes(&sim->arrays)->motion_steps;
    OZ_TRY(oz_batch_check(&sim->batch));
    int64_t steps = wanted < most ? wanted : most;
    for (int m = 0; steps > 0 && sim->model->steps_alike && m < sim->batch.member_count; m++) {
        steps = oz_batch_goes_on(&sim->batch, m) ? sim->model->steps_alike(sim, m, steps) : steps;
    }
    OZ_TRY(begin_launch(sim, (int)steps));
    OZ_TRY(finish_launch(sim, (int)steps));
    OZ_TRY(end_launch(sim, (int)steps));
done:
    *made = (int)(sim->batch.step - first);
    return status;
}
