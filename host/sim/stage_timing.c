/* Timing the kernels of kernels/stage_timing.cl. */
#include "sim/stage_timing.h"

#include "compute/cl_try.h"
#include "sim/rods_private.h"
#include "sim/timing.h"

#include <math.h>

static OzStatus time_kernel(OzSim *sim, cl_program program, const char *name, double *seconds)
{
    size_t group = (size_t)oz_rods_switches(sim)->group, items = group;
    if (oz_rods_switches(sim)->resort) {
        items = ((size_t)oz_rods_sizes(sim)->regions + group - 1) / group * group;
    }
    const OzTiming timing = {.items = items, .seconds = 0.02, .repeats_most = 1 << 24};
    return oz_timing_kernel(sim, program, name, &timing, seconds);
}

/* A step of no length, walls where the bed meets them. */
static OzStatus stand_still(OzSim *sim)
{
    oz_rods_parameters(sim, 0)->dt = 0;
    OZ_PASS(oz_sim_write_parameters(sim));
    return oz_rods_move_walls(sim, 0, 1);
}

/* Seconds of making the lists of a large scene anew. */
static OzStatus time_renewal(OzSim *sim, bool outer, double *seconds)
{
    double times[OZ_TIMING_LAUNCHES];
    for (int k = 0; k < OZ_TIMING_LAUNCHES; k++) {
        double start = oz_timing_clock(sim->device);
        OZ_PASS(oz_large_renew(sim->large, &sim->arrays, oz_sim_control(sim, 0), outer));
        times[k] = oz_timing_clock(sim->device) - start;
    }
    *seconds = oz_timing_median(times);
    return OZ_OK;
}

static OzStatus time_lists(OzStageTiming *phases, OzSim *sim, cl_program program)
{
    double rebuilt = NAN;
    if (sim->large) {
        OZ_PASS(time_renewal(sim, false, &phases->refresh));
        OZ_PASS(time_renewal(sim, true, &rebuilt));
    } else {
        OZ_PASS(time_kernel(sim, program, "oz_repeat_refresh", &phases->refresh));
        OZ_PASS(time_kernel(sim, program, "oz_repeat_rebuild", &rebuilt));
    }
    phases->rebuild = rebuilt - phases->refresh;
    return OZ_OK;
}

/* What is measured, and with which programs. */
typedef struct Job {
    OzStageTiming *phases;
    cl_program whole, free_of_walls;
} Job;

static OzStatus time_all(Job *job, OzSim *sim)
{
    OzStageTiming *phases = job->phases;
    double walled = NAN;
    OZ_PASS(time_kernel(sim, job->whole, "oz_repeat_pairs", &phases->pairs));
    OZ_PASS(time_kernel(sim, job->whole, "oz_repeat_grains", &walled));
    OZ_PASS(time_kernel(sim, job->free_of_walls, "oz_repeat_grains", &phases->grains));
    phases->walls = walled - phases->grains;
    return time_lists(phases, sim, job->whole);
}

/* Times everything on a bed that stands still: repeated parts leave what no step would. Walls'
 * forces pile up in the loads, for only the pairs' part clears them, and an integrator that carries
 * accelerations would go on with the pile. */
static OzStatus time_standing(void *context, OzSim *sim)
{
    OzControl control = *oz_rods_control(sim, 0);
    double step = oz_rods_parameters(sim, 0)->dt;
    OzStatus status = stand_still(sim);
    status = status == OZ_OK ? time_all(context, sim) : status;
    *oz_rods_control(sim, 0) = control;
    oz_rods_parameters(sim, 0)->dt = step;
    return status;
}

OzStatus oz_stage_timing_measure(OzStageTiming *phases, OzSim *sim, const char *source_dir)
{
    OzStatus status = OZ_OK;
    Job job = {.phases = phases};
    OzSwitches switches = *oz_rods_switches(sim);
    *phases = (OzStageTiming){NAN, NAN, NAN, NAN, NAN};
    OZ_TRY(oz_timing_build(sim, &switches, source_dir, "kernels/stage_timing.cl", &job.whole));
    switches.walls = switches.wall_kinds = switches.moving = 0;
    OZ_TRY(
        oz_timing_build(sim, &switches, source_dir, "kernels/stage_timing.cl", &job.free_of_walls));
    OZ_TRY(oz_timing_restored(sim, time_standing, &job));
done:
    CL_RELEASE(Program, job.free_of_walls);
    CL_RELEASE(Program, job.whole);
    return status;
}
