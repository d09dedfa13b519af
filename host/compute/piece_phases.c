/* Timing the kernels of kernels/piece_phases.cl. */
#include "compute/piece_phases.h"

#include "base/clock.h"
#include "compute/buffers.h"
#include "compute/cl_try.h"
#include "compute/piece_private.h"
#include "compute/program.h"

#include <stdlib.h>
#include <string.h>

enum { LAUNCHES = 5 }; /* timed, odd: the median is one of them */

/* Seconds that a timed launch shall take: long against its overhead, short for the one who waits;
 * and the most repeats, after which pieces under loads that never change would have gone too far.
 */
static const double launch_seconds = 0.01;
enum { REPEATS_MOST = 2048 };

static const struct {
    const char *name, *kernel, *less;
} phases[] = {
#define ROW(id, name, kernel, less) {name, kernel, less},
    OZ_PIECE_PHASES(ROW)
#undef ROW
};

const char *oz_piece_phases_name(OzPiecePhase phase)
{
    return phases[phase].name;
}

static double clock_of(const OzDevice *device)
{
    return device->is_cpu ? oz_clock_processor() : oz_clock_now();
}

static OzStatus time_launch(OzPieceSim *sim, cl_kernel kernel, cl_uint index, int repeats,
                            double *seconds)
{
    OzStatus status = OZ_OK;
    size_t group = (size_t)sim->arrays.switches.group;
    CL_TRY(clSetKernelArg(kernel, index, sizeof repeats, &repeats));
    double start = clock_of(sim->device);
    CL_TRY(
        clEnqueueNDRangeKernel(sim->device->queue, kernel, 1, NULL, &group, &group, 0, NULL, NULL));
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

/* Seconds of one repeat of a kernel. */
static OzStatus time_kernel(OzPieceSim *sim, cl_program program, const char *name, double *seconds)
{
    OzStatus status = OZ_OK;
    cl_int code = CL_SUCCESS;
    cl_uint index = 0;
    double times[LAUNCHES], spent = 0;
    int repeats = 1;
    cl_kernel kernel = clCreateKernel(program, name, &code);
    CL_TRY(code);
    OZ_TRY(oz_piece_arrays_bind(&sim->arrays, kernel, &index));
    OZ_TRY(time_launch(sim, kernel, index, repeats, &spent)); /* compiles */
    OZ_TRY(time_launch(sim, kernel, index, repeats, &spent));
    while (spent < launch_seconds && repeats < REPEATS_MOST) {
        repeats *= 2;
        OZ_TRY(time_launch(sim, kernel, index, repeats, &spent));
    }
    for (int k = 0; k < LAUNCHES; k++) {
        OZ_TRY(time_launch(sim, kernel, index, repeats, &times[k]));
    }
    qsort(times, LAUNCHES, sizeof times[0], compare);
    *seconds = times[LAUNCHES / 2] / repeats;
done:
    if (kernel) {
        clReleaseKernel(kernel);
    }
    return status;
}

static OzStatus time_all(double seconds[OZ_PIECE_PHASE_COUNT], OzPieceSim *sim, cl_program program)
{
    OzStatus status = OZ_OK;
    memset(seconds, 0, OZ_PIECE_PHASE_COUNT * sizeof *seconds);
    for (int p = 0; p < OZ_PIECE_PHASE_COUNT; p++) {
        double less = 0;
        if (p == OZ_PIECE_PHASE_BEAMS && !sim->arrays.switches.beams) {
            continue;
        }
        OZ_TRY(time_kernel(sim, program, phases[p].kernel, &seconds[p]));
        if (phases[p].less) {
            OZ_TRY(time_kernel(sim, program, phases[p].less, &less));
        }
        seconds[p] -= less;
    }
done:
    return status;
}

/* Times everything and puts every array back. */
static OzStatus time_standing(double seconds[OZ_PIECE_PHASE_COUNT], OzPieceSim *sim,
                              cl_program program)
{
    OzStatus status = OZ_OK;
    void *copies[OZ_PIECE_FIELD_COUNT] = {0};
    const cl_mem *buffers = sim->arrays.buffer;
    OZ_TRY(oz_buffers_save(sim->device, buffers, OZ_PIECE_FIELD_COUNT, copies));
    status = time_all(seconds, sim, program);
    OzStatus back = oz_buffers_restore(sim->device, buffers, OZ_PIECE_FIELD_COUNT, copies);
    status = status == OZ_OK ? back : status;
done:
    for (int f = 0; f < OZ_PIECE_FIELD_COUNT; f++) {
        free(copies[f]);
    }
    return status;
}

OzStatus oz_piece_phases_measure(double seconds[OZ_PIECE_PHASE_COUNT], OzPieceSim *sim,
                                 const char *source_dir)
{
    OzStatus status = OZ_OK;
    cl_program program = NULL;
    char options[1024];
    oz_piece_switches_options(&sim->arrays.switches, options, sizeof options);
    OZ_TRY(oz_program_build(&program, sim->device, source_dir, "kernels/piece_phases.cl", options));
    OZ_TRY(time_standing(seconds, sim, program));
done:
    if (program) {
        clReleaseProgram(program);
    }
    return status;
}
