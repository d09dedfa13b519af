/* One launch: control words and walls' motion down, the kernel until every member is through,
 * control words up. */
#include "compute/launch.h"

#include "base/log.h"
#include "base/memory.h"
#include "compute/capture.h"
#include "compute/cl_try.h"
#include "compute/deep.h"
#include "compute/guard.h"
#include "compute/host_lists.h"
#include "compute/pack.h"
#include "compute/sim_private.h"
#include "compute/sizes.h"
#include "compute/units.h"

#include <stdlib.h>

static OzStatus write_control(OzSim *sim)
{
    OzStatus status = OZ_OK;
    for (int m = 0; m < sim->crew.member_count; m++) {
        OZ_TRY(oz_arrays_write(&sim->arrays, OZ_FIELD_control, m, &sim->control[m],
                               sizeof(OzControl)));
    }
done:
    return status;
}

static OzStatus read_control(OzSim *sim)
{
    OzStatus status = OZ_OK;
    for (int m = 0; m < sim->crew.member_count; m++) {
        OZ_TRY(
            oz_arrays_read(&sim->arrays, OZ_FIELD_control, m, &sim->control[m], sizeof(OzControl)));
    }
done:
    return status;
}

static void put_motion(double words[OZ_MOTION], const OzMotion *motion, double time,
                       const OzParameters *p)
{
    double offset, speed;
    oz_constants_motion(motion, time, &offset, &speed);
    words[OZ_M_OFFSET] = offset / p->units.length;
    words[OZ_M_SPEED] = speed / oz_units_speed(&p->units);
    words[OZ_M_RISE] = rint(offset / p->length_unit);
    words[OZ_M_RISE_REST] = offset / p->length_unit - words[OZ_M_RISE];
}

OzStatus oz_launch_move_walls(OzSim *sim, int member, int steps)
{
    OzStatus status = OZ_OK;
    int64_t first = sim->crew.step;
    const OzScene *scene = sim->crew.members[member].scene;
    int walls = sim->arrays.switches.walls;
    size_t count = OZ_MOTION * (size_t)(steps + 1) * (size_t)walls;
    double *motion = NULL;
    void *narrow = NULL;
    OZ_TRY(OZ_NEW(&motion, count));
    OZ_TRY(oz_memory_new(&narrow, count, sizeof(double), "wall motion"));
    for (int k = 0; k < (sim->crew.walls_still ? 0 : steps + 1); k++) {
        double time = (double)(sim->parameters[member].dt > 0 ? first + k : first) * scene->step;
        for (int w = 0; w < walls; w++) {
            double *words = motion + OZ_MOTION * ((size_t)k * (size_t)walls + (size_t)w);
            put_motion(words, &scene->walls[sim->wall_order[w]].motion, time,
                       &sim->parameters[member]);
        }
    }
    oz_pack_scalars(narrow, motion, count, sim->arrays.switches.is_double);
    OZ_TRY(
        oz_arrays_write(&sim->arrays, OZ_FIELD_motion, member, narrow,
                        count * (sim->arrays.switches.is_double ? sizeof(double) : sizeof(float))));
done:
    free(motion);
    free(narrow);
    return status;
}

/* A kernel over all members, one work-group each; last is its one argument of its own, unless
 * negative. */
static OzStatus enqueue(OzSim *sim, cl_kernel kernel, int last)
{
    OzStatus status = OZ_OK;
    cl_uint next = 0;
    size_t group = (size_t)sim->arrays.switches.group;
    size_t all = group * (size_t)sim->crew.member_count;
    OZ_TRY(oz_arrays_bind(&sim->arrays, kernel, &next));
    if (last >= 0) {
        CL_TRY(clSetKernelArg(kernel, next, sizeof last, &last));
    }
    CL_TRY(
        clEnqueueNDRangeKernel(sim->device->queue, kernel, 1, NULL, &all, &group, 0, NULL, NULL));
    CL_TRY(clFinish(sim->device->queue));
done:
    return status;
}

/* Springs of every member to where they outlive new list sizes: a member that is through holds its
 * lists, which do not. It makes them again, with the same contacts, when it goes on. */
static OzStatus shelve(OzSim *sim)
{
    OzStatus status = OZ_OK;
    cl_int code = CL_SUCCESS;
    cl_kernel kernel = clCreateKernel(sim->program, "oz_shelve", &code);
    CL_TRY(code);
    OZ_TRY(enqueue(sim, kernel, -1));
    OZ_TRY(read_control(sim));
done:
    if (kernel) {
        clReleaseKernel(kernel);
    }
    return status;
}

/* Larger lists, after which the kernel takes up where it stopped. */
static OzStatus grow_lists(OzSim *sim)
{
    OzStatus status = OZ_OK;
    OzSizes sizes = sim->arrays.sizes;
    if (sim->crew.member_count > 1) {
        OZ_TRY(shelve(sim));
    }
    for (int m = 0; m < sim->crew.member_count; m++) {
        oz_sizes_grow(&sizes, &sim->control[m], &sim->arrays.switches);
        sim->control[m].full = 0;
    }
    oz_log_detail("lists grown at step %lld: outer %d, inner %d, back %d",
                  (long long)sim->crew.step, sizes.outer_capacity, sizes.inner_capacity,
                  sizes.back_capacity);
    sim->crew.counts.growths++;
    OZ_TRY(oz_arrays_resize(&sim->arrays, &sizes));
done:
    return status;
}

/* Whether a member has made its steps and its lists hold, or a guard spoke. */
static bool is_through(const OzControl *control, int steps)
{
    bool lists_hold = control->truth == OZ_TRUTH_INNER && control->stale_step == OZ_NEVER &&
                      control->stale_places == OZ_NEVER;
    return control->stop_bits || (control->step >= steps && lists_hold);
}

/* Repeats the launch until every member is through. */
static OzStatus finish_launch(OzSim *sim, int steps)
{
    OzStatus status = OZ_OK;
    for (bool more = true; more;) {
        OZ_TRY(write_control(sim));
        if (sim->large) {
            OZ_TRY(oz_large_steps(sim->large, &sim->arrays, &sim->control[0], steps));
        } else {
            OZ_TRY(enqueue(sim, sim->advance, steps));
            OZ_TRY(read_control(sim));
        }
        sim->crew.counts.launches++;
        bool full = false;
        more = false;
        for (int m = 0; m < sim->crew.member_count; m++) {
            full |= sim->control[m].full != 0;
            more |= !is_through(&sim->control[m], steps);
        }
        if (full) {
            OZ_TRY(grow_lists(sim));
        } else if (more) {
            OZ_TRY(oz_host_lists_make(sim));
        }
    }
done:
    return status;
}

/* A member that does not go on is at the launch's end already. */
static OzStatus begin_launch(OzSim *sim, int steps)
{
    OzStatus status = OZ_OK;
    for (int m = 0; m < sim->crew.member_count; m++) {
        sim->control[m].deep_count = sim->control[m].deep_depth = sim->control[m].deep_kinds = 0;
        sim->control[m].deep_step = sim->control[m].deep_index = OZ_NEVER;
        sim->control[m].step = oz_crew_goes_on(&sim->crew, m) ? 0 : steps;
        if (oz_crew_goes_on(&sim->crew, m)) {
            OZ_TRY(oz_launch_move_walls(sim, m, steps));
        }
    }
done:
    return status;
}

/* Deep contacts of a member that has not counted the launch's steps yet. */
static void note_deep(OzSim *sim, int member)
{
    const OzControl *control = &sim->control[member];
    bool at_wall = control->deep_kinds == OZ_DEEP_WALL;
    OzDeepFound found = {.count = control->deep_count,
                         .step = sim->crew.reached[member] + control->deep_step + 1,
                         .grain = control->deep_index,
                         .depth = control->deep_depth * (at_wall ? 0.5 : 1) / OZ_DEEP_SHARE,
                         .at_wall = at_wall};
    oz_deep_note(&sim->crew, member, &found);
}

/* Says why a guard stopped a member. */
static OzStatus tell_stop(OzSim *sim, int member)
{
    OzSnapshot now = {0};
    const OzMember *of = &sim->crew.members[member];
    OzStatus status = oz_snapshot_create(&now, of->scene, of->grains);
    status = status == OZ_OK ? oz_capture_snapshot(sim, member, &now, false) : status;
    if (status == OZ_OK) {
        oz_guard_fail(&sim->control[member], &now, sim->crew.walls_still);
        status = oz_crew_stop(&sim->crew, member);
    }
    oz_snapshot_free(&now);
    return status;
}

/* Counts each member's steps and notes which ones a guard stopped. Fails with
 * OZ_ERR_BLOWUP when none is left. */
static OzStatus end_launch(OzSim *sim, int steps)
{
    OzStatus status = OZ_OK;
    int most = 0;
    for (int m = 0; m < sim->crew.member_count; m++) {
        const OzControl *control = &sim->control[m];
        if (!oz_crew_goes_on(&sim->crew, m)) {
            continue;
        }
        int own = control->stop_bits ? control->stop_step + 1 : steps;
        note_deep(sim, m);
        oz_crew_count(&sim->crew, m, own, &most);
        if (control->stop_bits) {
            OZ_TRY(tell_stop(sim, m));
        }
    }
    status = oz_crew_end_launch(&sim->crew, steps, most);
done:
    return status;
}

OzStatus oz_launch_steps(OzSim *sim, int steps)
{
    OzStatus status = OZ_OK;
    OZ_TRY(oz_crew_check(&sim->crew));
    OZ_TRY(begin_launch(sim, steps));
    OZ_TRY(finish_launch(sim, steps));
    OZ_TRY(end_launch(sim, steps));
done:
    return status;
}
