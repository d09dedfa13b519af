/* Repeating kernels against the clock. */
#include "sim/timing.h"

#include "base/clock.h"
#include "base/memory.h"
#include "compute/buffers.h"
#include "compute/cl_try.h"
#include "compute/program.h"

#include <stdlib.h>

double oz_timing_clock(const OzDevice *device)
{
    return device->is_cpu ? oz_clock_processor() : oz_clock_now();
}

static OzStatus time_launch(OzSim *sim, cl_kernel kernel, cl_uint index, size_t items, int repeats,
                            double *seconds)
{
    size_t group = (size_t)oz_arrays_switches(&sim->arrays)->group;
    CL_PASS(clSetKernelArg(kernel, index, sizeof repeats, &repeats));
    double start = oz_timing_clock(sim->device);
    CL_PASS(
        clEnqueueNDRangeKernel(sim->device->queue, kernel, 1, NULL, &items, &group, 0, NULL, NULL));
    CL_PASS(clFinish(sim->device->queue));
    *seconds = oz_timing_clock(sim->device) - start;
    return OZ_OK;
}

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

double oz_timing_median(double times[OZ_TIMING_LAUNCHES])
{
    qsort(times, OZ_TIMING_LAUNCHES, sizeof times[0], compare);
    return times[OZ_TIMING_LAUNCHES / 2];
}

OzStatus oz_timing_kernel(OzSim *sim, cl_program program, const char *name, const OzTiming *timing,
                          double *seconds)
{
    OzStatus status = OZ_OK;
    cl_int code = CL_SUCCESS;
    cl_uint index = 0;
    double times[OZ_TIMING_LAUNCHES], spent = 0;
    int repeats = 1;
    cl_kernel kernel = clCreateKernel(program, name, &code);
    CL_TRY(code);
    OZ_TRY(oz_arrays_bind(&sim->arrays, kernel, &index));
    OZ_TRY(time_launch(sim, kernel, index, timing->items, repeats, &spent)); /* compiles */
    OZ_TRY(time_launch(sim, kernel, index, timing->items, repeats, &spent));
    while (spent < timing->seconds && repeats < timing->repeats_most) {
        repeats *= 2;
        OZ_TRY(time_launch(sim, kernel, index, timing->items, repeats, &spent));
    }
    for (int k = 0; k < OZ_TIMING_LAUNCHES; k++) {
        OZ_TRY(time_launch(sim, kernel, index, timing->items, repeats, &times[k]));
    }
    *seconds = oz_timing_median(times) / repeats;
done:
    CL_RELEASE(Kernel, kernel);
    return status;
}

OzStatus oz_timing_build(OzSim *sim, const void *switches, const char *source_dir, const char *name,
                         cl_program *program)
{
    char options[1024];
    oz_model_options(sim->model, switches, options, sizeof options);
    return oz_program_build(program, sim->device, source_dir, name, options);
}

OzStatus oz_timing_restored(OzSim *sim, OzStatus (*measure)(void *context, OzSim *sim),
                            void *context)
{
    OzStatus status = OZ_OK;
    int count = sim->model->field_count;
    void **copies = NULL;
    OZ_TRY(OZ_NEW(&copies, count));
    OZ_TRY(oz_buffers_save(sim->device, sim->arrays.buffer, count, copies));
    status = measure(context, sim);
    OzStatus back = oz_buffers_restore(sim->device, sim->arrays.buffer, count, copies);
    status = status == OZ_OK ? back : status;
done:
    for (int f = 0; copies && f < count; f++) {
        free(copies[f]);
    }
    free(copies);
    return status;
}
