/* Choosing an OpenCL device. */
#include "compute/device.h"

#include "base/log.h"
#include "compute/cl_try.h"
#include "compute/kernel_cache.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

enum { DEVICES_MAX = 64, GPU_GROUP = 256 };

typedef struct Candidate {
    cl_platform_id platform;
    cl_device_id id;
} Candidate;

static int find_candidates(Candidate *found)
{
    cl_platform_id platforms[16];
    cl_uint platform_count = 0;
    int count = 0;
    oz_kernel_cache_choose();
    if (clGetPlatformIDs(16, platforms, &platform_count) != CL_SUCCESS) {
        return 0;
    }
    for (cl_uint p = 0; p < platform_count && p < 16; p++) {
        cl_device_id ids[16];
        cl_uint id_count = 0;
        if (clGetDeviceIDs(platforms[p], CL_DEVICE_TYPE_ALL, 16, ids, &id_count) != CL_SUCCESS) {
            continue;
        }
        for (cl_uint i = 0; i < id_count && i < 16 && count < DEVICES_MAX; i++) {
            found[count++] = (Candidate){platforms[p], ids[i]};
        }
    }
    return count;
}

static int lanes_for(cl_uint preferred, bool is_cpu)
{
    if (!is_cpu) {
        return 1;
    }
    return preferred >= 16 ? 16 : preferred >= 8 ? 8 : preferred >= 4 ? 4 : 1;
}

static void describe(OzDevice *device, const Candidate *candidate)
{
    char name[128] = "", platform[64] = "", driver[48] = "";
    cl_device_type type = 0;
    cl_uint units = 0, float_lanes = 0, double_lanes = 0;
    cl_ulong memory = 0, largest = 0;
    cl_device_fp_config doubles = 0;
    size_t group = 1;
    cl_device_id id = candidate->id;
    memset(device, 0, sizeof *device);
    device->platform = candidate->platform;
    device->id = id;
    clGetDeviceInfo(id, CL_DEVICE_NAME, sizeof name, name, NULL);
    clGetPlatformInfo(candidate->platform, CL_PLATFORM_NAME, sizeof platform, platform, NULL);
    clGetDeviceInfo(id, CL_DRIVER_VERSION, sizeof driver, driver, NULL);
    clGetDeviceInfo(id, CL_DEVICE_TYPE, sizeof type, &type, NULL);
    clGetDeviceInfo(id, CL_DEVICE_MAX_COMPUTE_UNITS, sizeof units, &units, NULL);
    clGetDeviceInfo(id, CL_DEVICE_GLOBAL_MEM_SIZE, sizeof memory, &memory, NULL);
    clGetDeviceInfo(id, CL_DEVICE_MAX_MEM_ALLOC_SIZE, sizeof largest, &largest, NULL);
    clGetDeviceInfo(id, CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT, sizeof float_lanes, &float_lanes,
                    NULL);
    clGetDeviceInfo(id, CL_DEVICE_NATIVE_VECTOR_WIDTH_DOUBLE, sizeof double_lanes, &double_lanes,
                    NULL);
    clGetDeviceInfo(id, CL_DEVICE_DOUBLE_FP_CONFIG, sizeof doubles, &doubles, NULL);
    clGetDeviceInfo(id, CL_DEVICE_MAX_WORK_GROUP_SIZE, sizeof group, &group, NULL);
    snprintf(device->name, sizeof device->name, "%s (%s %s)", name, platform, driver);
    device->is_cpu = (type & CL_DEVICE_TYPE_CPU) != 0;
    device->has_double = doubles != 0;
    device->units = (int)units;
    device->memory = memory;
    device->largest_buffer = largest;
    device->float_lanes = lanes_for(float_lanes, device->is_cpu);
    device->double_lanes = lanes_for(double_lanes, device->is_cpu);
    device->small_most = OZ_DEVICE_SMALL_MOST;
    device->group = device->is_cpu ? 1 : (group < GPU_GROUP ? (int)group : GPU_GROUP);
}

/* Why a device cannot serve at all, or NULL. */
static const char *refusal(const OzDevice *device)
{
    cl_bool available = CL_FALSE, compiler = CL_FALSE;
    clGetDeviceInfo(device->id, CL_DEVICE_AVAILABLE, sizeof available, &available, NULL);
    clGetDeviceInfo(device->id, CL_DEVICE_COMPILER_AVAILABLE, sizeof compiler, &compiler, NULL);
    if (!available) {
        return "not available";
    }
    return compiler ? NULL : "has no compiler";
}

static OzStatus open_one(OzDevice *device)
{
    OzStatus status = OZ_OK;
    cl_int code = CL_SUCCESS;
    cl_context_properties properties[] = {CL_CONTEXT_PLATFORM,
                                          (cl_context_properties)device->platform, 0};
    device->context = clCreateContext(properties, 1, &device->id, NULL, NULL, &code);
    CL_TRY(code);
    device->queue = clCreateCommandQueue(device->context, device->id, 0, &code);
    CL_TRY(code);
done:
    if (status != OZ_OK) {
        oz_device_close(device);
    }
    return status;
}

/* Whether a device answers to what was asked for. */
static bool wanted(const OzDevice *device, int index, const char *want)
{
    char *end = NULL;
    long number = strtol(want, &end, 10);
    if (*want && *end == '\0') {
        return number == index;
    }
    if (strcmp(want, "cpu") == 0 || strcmp(want, "gpu") == 0) {
        return device->is_cpu == (want[0] == 'c');
    }
    return strcasestr(device->name, want) != NULL;
}

/* Opens the first device that answers to want, logging refusals. */
static bool open_first(OzDevice *device, const Candidate *candidates, int count, const char *want)
{
    for (int i = 0; i < count; i++) {
        describe(device, &candidates[i]);
        if (!wanted(device, i, want)) {
            continue;
        }
        const char *reason = refusal(device);
        if (!reason && open_one(device) == OZ_OK) {
            return true;
        }
        oz_log_line("device %d refused: %s: %s", i, device->name,
                    reason ? reason : oz_status_text());
    }
    memset(device, 0, sizeof *device);
    return false;
}

static void limit_threads(int threads)
{
    char number[16];
    if (threads > 0) {
        snprintf(number, sizeof number, "%d", threads);
        setenv("POCL_MAX_PTHREAD_COUNT", number, 1);
    }
}

static OzStatus open_wanted(OzDevice *device, const char *want, int threads)
{
    Candidate candidates[DEVICES_MAX];
    memset(device, 0, sizeof *device);
    limit_threads(threads);
    int count = find_candidates(candidates);
    bool any = !want || strcmp(want, "auto") == 0;
    if (any && (open_first(device, candidates, count, "gpu") ||
                open_first(device, candidates, count, "cpu"))) {
        return OZ_OK;
    }
    if (!any && open_first(device, candidates, count, want)) {
        return OZ_OK;
    }
    const char *trouble = oz_kernel_cache_trouble();
    return oz_status_fail(any ? OZ_ERR_DEVICE : OZ_ERR_INPUT,
                          "no OpenCL device answers to '%s' (%d found); %s", any ? "auto" : want,
                          count,
                          trouble[0] ? trouble
                                     : "`orzo devices` lists them, package pocl-opencl-icd gives "
                                       "any CPU one");
}

/* Drivers start up when they are first asked, and PoCL then shows a second thread no device. */
OzStatus oz_device_open(OzDevice *device, const char *want, int threads)
{
    static pthread_mutex_t starting = PTHREAD_MUTEX_INITIALIZER;
    pthread_mutex_lock(&starting);
    OzStatus status = open_wanted(device, want, threads);
    pthread_mutex_unlock(&starting);
    return status;
}

OzStatus oz_device_branch(OzDevice *branch, const OzDevice *device)
{
    OzStatus status = OZ_OK;
    cl_int code = CL_SUCCESS;
    *branch = *device;
    branch->queue = NULL;
    CL_TRY(clRetainContext(branch->context));
    branch->queue = clCreateCommandQueue(branch->context, branch->id, 0, &code);
    CL_TRY(code);
done:
    if (status != OZ_OK) {
        oz_device_close(branch);
    }
    return status;
}

void oz_device_close(OzDevice *device)
{
    CL_RELEASE(CommandQueue, device->queue);
    CL_RELEASE(Context, device->context);
    memset(device, 0, sizeof *device);
}

OzStatus oz_device_check_double(const OzDevice *device, bool is_needed)
{
    if (is_needed && !device->has_double) {
        return oz_status_fail(OZ_ERR_DEVICE,
                              "%s computes in float only: use precision: float without "
                              "observe.ledger, and observe.walls: instant",
                              device->name);
    }
    return OZ_OK;
}

OzStatus oz_device_list(FILE *file)
{
    Candidate candidates[DEVICES_MAX];
    int count = find_candidates(candidates);
    for (int i = 0; i < count; i++) {
        OzDevice device;
        describe(&device, &candidates[i]);
        const char *reason = refusal(&device);
        fprintf(file, "%d  %s: %s, %d units, %.1f GiB, %d float lanes, %s%s%s\n", i,
                device.is_cpu ? "cpu" : "gpu", device.name, device.units,
                (double)device.memory / 1073741824.0, device.float_lanes,
                device.has_double ? "float and double" : "float only", reason ? "; refused: " : "",
                reason ? reason : "");
    }
    if (count == 0) {
        const char *trouble = oz_kernel_cache_trouble();
        fprintf(file, "no OpenCL device; %s\n",
                trouble[0] ? trouble : "package pocl-opencl-icd gives any CPU one");
    }
    return OZ_OK;
}
