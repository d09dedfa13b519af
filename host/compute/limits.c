/* Measuring a device's limits. */
#include "compute/limits.h"

#include "base/clock.h"
#include "compute/cl_try.h"
#include "compute/program.h"

#include <math.h>

enum {
    LAUNCHES = 7,          /* timed                                            */
    CHAINS = 10,           /* of oz_multiply_add                               */
    GROUPS_A_UNIT = 8,     /* on a GPU: enough to hide latency                 */
    LEAST_BYTES = 1 << 16, /* below, a copy is all loop                        */
    MOST_BYTES = 1 << 29   /* far beyond any cache; more would only cost time  */
};

/* Seconds that a timed launch shall take: long against its overhead, short for the one who waits.
 */
static const double launch_seconds = 0.02;

typedef struct Limit {
    const OzDevice *device;
    cl_program program;
    cl_kernel kernel;
    cl_mem first, second;
    size_t items, group;
    cl_uint repeats_at; /* index of the argument */
} Limit;

static void close_limit(Limit *limit)
{
    CL_RELEASE(MemObject, limit->second);
    CL_RELEASE(MemObject, limit->first);
    CL_RELEASE(Kernel, limit->kernel);
    CL_RELEASE(Program, limit->program);
}

static int lanes_of(const OzDevice *device, bool is_double)
{
    return is_double ? device->double_lanes : device->float_lanes;
}

static OzStatus open_limit(Limit *limit, const OzDevice *device, const char *source_dir,
                           const char *kernel, bool is_double)
{
    cl_int code = CL_SUCCESS;
    char options[96];
    *limit = (Limit){.device = device};
    limit->group = (size_t)device->group;
    limit->items = device->is_cpu ? (size_t)device->units
                                  : (size_t)device->units * GROUPS_A_UNIT * limit->group;
    snprintf(options, sizeof options, "-DOZ_LANES=%d -DOZ_GROUP=%d%s", lanes_of(device, is_double),
             device->group, is_double ? " -DOZ_DOUBLE=1" : "");
    OZ_PASS(oz_program_build(&limit->program, device, source_dir, "kernels/limits.cl", options));
    limit->kernel = clCreateKernel(limit->program, kernel, &code);
    CL_PASS(code);
    return OZ_OK;
}

static OzStatus make_buffer(Limit *limit, cl_mem *buffer, cl_uint index, size_t bytes)
{
    cl_int code = CL_SUCCESS;
    cl_uint zero = 0;
    *buffer = clCreateBuffer(limit->device->context, CL_MEM_READ_WRITE, bytes, NULL, &code);
    CL_PASS(code);
    CL_PASS(clEnqueueFillBuffer(limit->device->queue, *buffer, &zero, sizeof zero, 0, bytes, 0,
                                NULL, NULL));
    CL_PASS(clSetKernelArg(limit->kernel, index, sizeof *buffer, buffer));
    return OZ_OK;
}

static OzStatus time_launch(Limit *limit, int repeats, double *seconds)
{
    CL_PASS(clSetKernelArg(limit->kernel, limit->repeats_at, sizeof repeats, &repeats));
    double start = oz_clock_now();
    CL_PASS(clEnqueueNDRangeKernel(limit->device->queue, limit->kernel, 1, NULL, &limit->items,
                                   &limit->group, 0, NULL, NULL));
    CL_PASS(clFinish(limit->device->queue));
    *seconds = oz_clock_now() - start;
    return OZ_OK;
}

/* Seconds of one repeat, of the fastest launch: a limit is what can be done. */
static OzStatus time_repeat(Limit *limit, double *seconds)
{
    double spent = 0, least = INFINITY;
    int repeats = 2;
    OZ_PASS(time_launch(limit, repeats, &spent)); /* compiles, touches every page */
    OZ_PASS(time_launch(limit, repeats, &spent));
    while (spent < launch_seconds && repeats < 1 << 28) {
        repeats *= 2;
        OZ_PASS(time_launch(limit, repeats, &spent));
    }
    for (int k = 0; k < LAUNCHES; k++) {
        OZ_PASS(time_launch(limit, repeats, &spent));
        least = fmin(least, spent);
    }
    *seconds = least / repeats;
    return OZ_OK;
}

OzStatus oz_limits_copy(double *bytes_per_second, const OzDevice *device, const char *source_dir,
                        size_t bytes, bool is_double)
{
    OzStatus status = OZ_OK;
    Limit limit = {0};
    double seconds = 0;
    size_t real =
        (size_t)lanes_of(device, is_double) * (is_double ? sizeof(double) : sizeof(float));
    bytes = bytes < LEAST_BYTES ? LEAST_BYTES : bytes > MOST_BYTES ? MOST_BYTES : bytes;
    cl_int count = (cl_int)(bytes / 2 / real);
    *bytes_per_second = 0;
    OZ_TRY(open_limit(&limit, device, source_dir, "oz_copy", is_double));
    limit.repeats_at = 3;
    OZ_TRY(make_buffer(&limit, &limit.first, 0, (size_t)count * real));
    OZ_TRY(make_buffer(&limit, &limit.second, 1, (size_t)count * real));
    CL_TRY(clSetKernelArg(limit.kernel, 2, sizeof count, &count));
    OZ_TRY(time_repeat(&limit, &seconds));
    *bytes_per_second = 2 * (double)count * (double)real / seconds;
done:
    close_limit(&limit);
    return status;
}

OzStatus oz_limits_multiply_add(double *operations_per_second, const OzDevice *device,
                                const char *source_dir, bool is_double)
{
    OzStatus status = OZ_OK;
    Limit limit = {0};
    double seconds = 0;
    size_t lanes = (size_t)lanes_of(device, is_double);
    *operations_per_second = 0;
    OZ_TRY(open_limit(&limit, device, source_dir, "oz_multiply_add", is_double));
    limit.repeats_at = 1;
    OZ_TRY(make_buffer(&limit, &limit.first, 0,
                       limit.items * lanes * (is_double ? sizeof(double) : sizeof(float))));
    OZ_TRY(time_repeat(&limit, &seconds));
    *operations_per_second = 2.0 * CHAINS * (double)(limit.items * lanes) / seconds;
done:
    close_limit(&limit);
    return status;
}
