/* Timing the kernels of kernels/phases.cl. */
#include "compute/phases.h"

#include "base/clock.h"
#include "compute/buffers.h"
#include "compute/cl_try.h"
#include "compute/launch.h"
#include "compute/program.h"
#include "compute/sim_private.h"

#include <math.h>
#include <stdlib.h>

enum { LAUNCHES = 5 }; /* timed, odd: the median is one of them */

/* Seconds that a timed launch shall take: long against its overhead, short for the one who waits.
 */
static const double launch_seconds = 0.02;

static double clock_of(const OzDevice *device)
{
    return device->is_cpu ? oz_clock_processor() : oz_clock_now();
}

static OzStatus time_launch(OzSim *sim, cl_kernel kernel, cl_uint index, int repeats,
                            double *seconds)
{
    OzStatus status = OZ_OK;
    const OzSwitches *s = &sim->arrays.switches;
    size_t group = (size_t)s->group, items = group;
    if (s->resort) {
        items = ((size_t)sim->arrays.sizes.regions + group - 1) / group * group;
    }
    CL_TRY(clSetKernelArg(kernel, index, sizeof repeats, &repeats));
    double start = clock_of(sim->device);
    CL_TRY(
        clEnqueueNDRangeKernel(sim->device->queue, kernel, 1, NULL, &items, &group, 0, NULL, NULL));
    CL_TRY(clFinish(sim->device->queue));
    *seconds = clock_of(sim->device) - start;
done:
    return status;
}

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double middle(double times[LAUNCHES])
{
    qsort(times, LAUNCHES, sizeof times[0], compare);
    return times[LAUNCHES / 2];
}

/* Seconds of one repeat of a kernel. */
static OzStatus time_kernel(OzSim *sim, cl_program program, const char *name, double *seconds)
{
    OzStatus status = OZ_OK;
    cl_int code = CL_SUCCESS;
    cl_uint index = 0;
    double times[LAUNCHES], spent = 0;
    int repeats = 1;
    cl_kernel kernel = clCreateKernel(program, name, &code);
    CL_TRY(code);
    OZ_TRY(oz_arrays_bind(&sim->arrays, kernel, &index));
    OZ_TRY(time_launch(sim, kernel, index, repeats, &spent)); /* compiles */
    OZ_TRY(time_launch(sim, kernel, index, repeats, &spent));
    while (spent < launch_seconds && repeats < 1 << 24) {
        repeats *= 2;
        OZ_TRY(time_launch(sim, kernel, index, repeats, &spent));
    }
    for (int k = 0; k < LAUNCHES; k++) {
        OZ_TRY(time_launch(sim, kernel, index, repeats, &times[k]));
    }
    *seconds = middle(times) / repeats;
done:
    if (kernel) {
        clReleaseKernel(kernel);
    }
    return status;
}

static OzStatus build(OzSim *sim, const OzSwitches *switches, const char *source_dir,
                      cl_program *program)
{
    char options[1024];
    oz_switches_options(switches, options, sizeof options);
    return oz_program_build(program, sim->device, source_dir, "kernels/phases.cl", options);
}

/* A step of no length, walls where the bed meets them. */
static OzStatus stand_still(OzSim *sim)
{
    OzStatus status = OZ_OK;
    sim->parameters[0].dt = 0;
    OZ_TRY(oz_sim_write_parameters(sim));
    OZ_TRY(oz_launch_move_walls(sim, 0, 1));
done:
    return status;
}

/* Seconds of making the lists of a large scene anew. */
static OzStatus time_renewal(OzSim *sim, bool outer, double *seconds)
{
    OzStatus status = OZ_OK;
    double times[LAUNCHES];
    for (int k = 0; k < LAUNCHES; k++) {
        double start = clock_of(sim->device);
        OZ_TRY(oz_large_renew(sim->large, &sim->arrays, &sim->control[0], outer));
        times[k] = clock_of(sim->device) - start;
    }
    *seconds = middle(times);
done:
    return status;
}

static OzStatus time_lists(OzPhases *phases, OzSim *sim, cl_program program)
{
    OzStatus status = OZ_OK;
    double rebuilt = NAN;
    if (sim->large) {
        OZ_TRY(time_renewal(sim, false, &phases->refresh));
        OZ_TRY(time_renewal(sim, true, &rebuilt));
    } else {
        OZ_TRY(time_kernel(sim, program, "oz_repeat_refresh", &phases->refresh));
        OZ_TRY(time_kernel(sim, program, "oz_repeat_rebuild", &rebuilt));
    }
    phases->rebuild = rebuilt - phases->refresh;
done:
    return status;
}

static OzStatus time_all(OzPhases *phases, OzSim *sim, cl_program whole, cl_program free_of_walls)
{
    OzStatus status = OZ_OK;
    double walled = NAN;
    OZ_TRY(time_kernel(sim, whole, "oz_repeat_pairs", &phases->pairs));
    OZ_TRY(time_kernel(sim, whole, "oz_repeat_grains", &walled));
    OZ_TRY(time_kernel(sim, free_of_walls, "oz_repeat_grains", &phases->grains));
    phases->walls = walled - phases->grains;
    OZ_TRY(time_lists(phases, sim, whole));
done:
    return status;
}

/* Times everything on a bed that stands still, and puts every array back: repeated parts leave what
 * no step would. Walls' forces pile up in the loads, for only the pairs' part clears them, and an
 * integrator that carries accelerations would go on with the pile. */
static OzStatus time_standing(OzPhases *phases, OzSim *sim, cl_program whole,
                              cl_program free_of_walls)
{
    OzStatus status = OZ_OK;
    void *copies[OZ_FIELD_COUNT] = {0};
    OzControl control = sim->control[0];
    double step = sim->parameters[0].dt;
    OZ_TRY(oz_buffers_save(sim->device, sim->arrays.buffer, OZ_FIELD_COUNT, copies));
    status = stand_still(sim);
    status = status == OZ_OK ? time_all(phases, sim, whole, free_of_walls) : status;
    sim->control[0] = control;
    sim->parameters[0].dt = step;
    OzStatus back = oz_buffers_restore(sim->device, sim->arrays.buffer, OZ_FIELD_COUNT, copies);
    status = status == OZ_OK ? back : status;
done:
    for (int f = 0; f < OZ_FIELD_COUNT; f++) {
        free(copies[f]);
    }
    return status;
}

OzStatus oz_phases_measure(OzPhases *phases, OzSim *sim, const char *source_dir)
{
    OzStatus status = OZ_OK;
    cl_program whole = NULL, free_of_walls = NULL;
    OzSwitches switches = sim->arrays.switches;
    *phases = (OzPhases){NAN, NAN, NAN, NAN, NAN};
    OZ_TRY(build(sim, &switches, source_dir, &whole));
    switches.walls = switches.wall_kinds = switches.moving = 0;
    OZ_TRY(build(sim, &switches, source_dir, &free_of_walls));
    OZ_TRY(time_standing(phases, sim, whole, free_of_walls));
done:
    if (free_of_walls) {
        clReleaseProgram(free_of_walls);
    }
    if (whole) {
        clReleaseProgram(whole);
    }
    return status;
}
