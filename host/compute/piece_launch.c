/* One launch: control words and walls' motion down, the kernel until every member is through,
 * control words up. */
#include "compute/piece_launch.h"

#include "base/log.h"
#include "base/memory.h"
#include "compute/cl_try.h"
#include "compute/deep.h"
#include "compute/piece_capture.h"
#include "compute/piece_guard.h"
#include "compute/piece_pack.h"
#include "compute/piece_private.h"
#include "compute/piece_sizes.h"
#include "compute/units.h"
#include "model/wall_motion.h"

#include <math.h>
#include <stdlib.h>

static OzStatus write_control(OzPieceSim *sim)
{
    OzStatus status = OZ_OK;
    for (int m = 0; m < sim->crew.member_count; m++) {
        OZ_TRY(oz_piece_arrays_write(&sim->arrays, OZ_PIECE_FIELD_control, m, &sim->control[m],
                                     sizeof(OzPieceControl)));
    }
done:
    return status;
}

static OzStatus read_control(OzPieceSim *sim)
{
    OzStatus status = OZ_OK;
    for (int m = 0; m < sim->crew.member_count; m++) {
        OZ_TRY(oz_piece_arrays_read(&sim->arrays, OZ_PIECE_FIELD_control, m, &sim->control[m],
                                    sizeof(OzPieceControl)));
    }
done:
    return status;
}

static OzWallPose pose_at(const OzPieceSim *sim, int member, int wall, int64_t step)
{
    const OzScene *scene = sim->crew.members[member].scene;
    return oz_wall_motion_pose(&scene->walls[wall], (double)step * scene->step,
                               sim->crew.walls_still);
}

static bool is_there(const OzPieceSim *sim, int member, int wall, int64_t step)
{
    const OzScene *scene = sim->crew.members[member].scene;
    return oz_wall_motion_present(&scene->walls[wall], (double)step * scene->step,
                                  sim->crew.walls_still);
}

/* The walls whose pieces are there at a step. */
static unsigned present_at(const OzPieceSim *sim, int member, int64_t step)
{
    unsigned present = 0;
    for (int w = 0; w < sim->crew.members[member].scene->wall_count; w++) {
        present |= is_there(sim, member, w, step) ? 1U << w : 0;
    }
    return present;
}

/* How many of these steps can be made before a wall of the member comes or goes: a step feels the
 * walls as they are at its end. */
static int64_t steps_alike(const OzPieceSim *sim, int member, int64_t steps)
{
    int64_t low = 1, high = steps;
    unsigned first = present_at(sim, member, sim->crew.step + 1);
    if (present_at(sim, member, sim->crew.step + steps) == first) {
        return steps; /* a wall that has gone never comes back */
    }
    while (high - low > 1) {
        int64_t middle = (low + high) / 2;
        *(present_at(sim, member, sim->crew.step + middle) == first ? &low : &high) = middle;
    }
    return low;
}

/* The motion of every wall of a member at each step of the launch, and at its end. */
static OzStatus write_motion(OzPieceSim *sim, int member, int steps)
{
    OzStatus status = OZ_OK;
    const OzScene *scene = sim->crew.members[member].scene;
    int walls = sim->arrays.sizes.walls;
    size_t count = (size_t)(steps + 1) * (size_t)walls * OZ_PIECE_MOTION;
    const OzUnits *units = &sim->parameters[member].units;
    double *motion = NULL;
    if (!sim->arrays.switches.moving) {
        return OZ_OK;
    }
    OZ_TRY(OZ_NEW(&motion, count));
    for (int k = 0; k <= steps; k++) {
        for (int w = 0; w < scene->wall_count; w++) {
            double *words = motion + ((size_t)k * (size_t)walls + (size_t)w) * OZ_PIECE_MOTION;
            OzWallPose pose = pose_at(sim, member, w, sim->crew.step + k);
            words[OZ_PM_OFFSET] = pose.rise / units->length;
            words[OZ_PM_COS] = cos(pose.turn);
            words[OZ_PM_SIN] = sin(pose.turn);
            words[OZ_PM_ANGLE] = pose.turn;
            words[OZ_PM_POINT] = scene->walls[w].point[0] / units->length;
            words[OZ_PM_POINT + 1] = scene->walls[w].point[1] / units->length;
            words[OZ_PM_VELOCITY] = pose.speed / oz_units_speed(units);
            words[OZ_PM_SPIN] = pose.spin * units->time;
        }
    }
    OZ_TRY(
        oz_piece_arrays_write_scalars(&sim->arrays, OZ_PIECE_FIELD_motion, member, motion, count));
done:
    free(motion);
    return status;
}

/* A kernel over all members, one work-group each; last is its one argument of its own, unless
 * negative. */
static OzStatus enqueue(OzPieceSim *sim, cl_kernel kernel, int last)
{
    OzStatus status = OZ_OK;
    cl_uint next = 0;
    size_t group = (size_t)sim->arrays.switches.group;
    size_t all = group * (size_t)sim->crew.member_count;
    OZ_TRY(oz_piece_arrays_bind(&sim->arrays, kernel, &next));
    if (last >= 0) {
        CL_TRY(clSetKernelArg(kernel, next, sizeof last, &last));
    }
    CL_TRY(
        clEnqueueNDRangeKernel(sim->device->queue, kernel, 1, NULL, &all, &group, 0, NULL, NULL));
    CL_TRY(clFinish(sim->device->queue));
done:
    return status;
}

/* Larger lists, which all members then make anew. */
static OzStatus grow_lists(OzPieceSim *sim)
{
    OzStatus status = OZ_OK;
    OzPieceSizes sizes = sim->arrays.sizes;
    for (int m = 0; m < sim->crew.member_count; m++) {
        oz_piece_sizes_grow(&sizes, &sim->control[m], &sim->arrays.switches);
        sim->control[m].full = 0;
        sim->control[m].outer_holds = sim->control[m].inner_holds = 0;
    }
    oz_log_detail("lists grown at step %lld: outer %d, inner %d, back %d",
                  (long long)sim->crew.step, sizes.outer_capacity, sizes.inner_capacity,
                  sizes.back_capacity);
    sim->crew.counts.growths++;
    OZ_TRY(oz_piece_arrays_resize(&sim->arrays, &sizes));
done:
    return status;
}

static bool is_through(const OzPieceControl *control, int steps)
{
    return control->stop_bits || control->step >= steps;
}

/* Runs the kernel until every member is through. */
static OzStatus finish_launch(OzPieceSim *sim, int steps)
{
    OzStatus status = OZ_OK;
    for (bool more = true; more;) {
        bool full = false;
        OZ_TRY(write_control(sim));
        OZ_TRY(enqueue(sim, sim->advance, steps));
        OZ_TRY(read_control(sim));
        sim->crew.counts.launches++;
        more = false;
        for (int m = 0; m < sim->crew.member_count; m++) {
            full |= sim->control[m].full != 0;
            more |= !is_through(&sim->control[m], steps);
        }
        if (full) {
            OZ_TRY(grow_lists(sim));
        }
    }
done:
    return status;
}

/* A member that does not go on is at the launch's end already. */
static OzStatus begin_launch(OzPieceSim *sim, int steps)
{
    OzStatus status = OZ_OK;
    for (int m = 0; m < sim->crew.member_count; m++) {
        sim->control[m].step = oz_crew_goes_on(&sim->crew, m) ? 0 : steps;
        sim->control[m].deep_count = sim->control[m].deep_depth = 0;
        sim->control[m].deep_step = sim->control[m].deep_index = OZ_NEVER;
        if (!oz_crew_goes_on(&sim->crew, m)) {
            continue;
        }
        unsigned present = present_at(sim, m, sim->crew.step + 1);
        if (present != sim->present[m]) {
            OZ_TRY(oz_piece_pack_bodies(&sim->arrays, m, sim->crew.members[m].grains, present));
            sim->control[m].outer_holds = sim->control[m].inner_holds = 0;
            sim->present[m] = present;
        }
        OZ_TRY(write_motion(sim, m, steps));
    }
done:
    return status;
}

/* Deep contacts of a member that has not counted the launch's steps yet. */
static void note_deep(OzPieceSim *sim, int member)
{
    const OzPieceControl *control = &sim->control[member];
    const OzPieces *pieces = sim->crew.members[member].grains->pieces;
    OzDeepFound found = {.count = control->deep_count};
    if (found.count > 0) {
        found.step = sim->crew.reached[member] + control->deep_step + 1;
        found.grain = pieces->body[control->deep_index];
        found.depth = (double)control->deep_depth / OZ_DEEP_SHARE;
    }
    oz_deep_note(&sim->crew, member, &found);
}

/* Says why a guard stopped a member. */
static OzStatus tell_stop(OzPieceSim *sim, int member)
{
    OzSnapshot now = {0};
    const OzMember *of = &sim->crew.members[member];
    OzStatus status = oz_snapshot_create(&now, of->scene, of->grains);
    status = status == OZ_OK ? oz_piece_capture_snapshot(sim, member, &now, false) : status;
    if (status == OZ_OK) {
        oz_piece_guard_fail(&sim->control[member], &now, sim->crew.walls_still);
        status = oz_crew_stop(&sim->crew, member);
    }
    oz_snapshot_free(&now);
    return status;
}

/* Counts each member's steps and notes which ones a guard stopped. Fails with
 * OZ_ERR_BLOWUP when none is left. */
static OzStatus end_launch(OzPieceSim *sim, int steps)
{
    OzStatus status = OZ_OK;
    int most = 0;
    for (int m = 0; m < sim->crew.member_count; m++) {
        const OzPieceControl *control = &sim->control[m];
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

OzStatus oz_piece_launch_steps(OzPieceSim *sim, int64_t wanted, int *made)
{
    OzStatus status = OZ_OK;
    int64_t first = sim->crew.step;
    OZ_TRY(oz_crew_check(&sim->crew));
    int64_t steps =
        wanted < sim->arrays.sizes.motion_steps ? wanted : sim->arrays.sizes.motion_steps;
    for (int m = 0; m < sim->crew.member_count; m++) {
        steps = oz_crew_goes_on(&sim->crew, m) ? steps_alike(sim, m, steps) : steps;
    }
    OZ_TRY(begin_launch(sim, (int)steps));
    OZ_TRY(finish_launch(sim, (int)steps));
    OZ_TRY(end_launch(sim, (int)steps));
done:
    *made = (int)(sim->crew.step - first);
    return status;
}

OzStatus oz_piece_launch_begin(OzPieceSim *sim)
{
    OzStatus status = OZ_OK;
    for (int m = 0; m < sim->crew.member_count; m++) {
        OZ_TRY(write_motion(sim, m, 0));
    }
    OZ_TRY(write_control(sim));
    OZ_TRY(enqueue(sim, sim->begin, -1));
done:
    return status;
}
