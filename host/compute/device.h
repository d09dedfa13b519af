/* OpenCL devices: which there are, which one is taken and why not the others; chosen once at
 * start. */
#pragma once

#include "base/status.h"

#include <CL/cl.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

/* The grains of the largest scene that one work-group computes in launches of many steps; with
 * more, many work-groups do it phase by phase and re-sort them in space. */
enum { OZ_DEVICE_SMALL_MOST = 6000 };

typedef struct OzDevice {
    cl_platform_id platform;
    cl_device_id id;
    cl_context context;
    cl_command_queue queue; /* in order */
    char name[256];         /* device, platform and driver version */
    bool is_cpu;
    bool has_double;
    int float_lanes, double_lanes; /* lanes of a vector that suit it: 1 on a GPU      */
    int units;                     /* compute units                                         */
    int group;                     /* work-items of a work-group for small scenes; 1 on a CPU */
    int64_t small_most;            /* OZ_DEVICE_SMALL_MOST; a test may set it lower */
    uint64_t memory;               /* bytes                                                 */
    uint64_t largest_buffer;       /* bytes                                                 */
} OzDevice;

/* Opens the device: want is NULL or "auto" (a GPU, else the CPU), "gpu", "cpu", a number from
 * oz_device_list, or a part of a name. threads > 0 limits a CPU device's threads (it must be the
 * process's first OpenCL call). Logs each refusal with its reason. Threads may
 * call it at once. The caller frees with oz_device_close. */
OzStatus oz_device_open(OzDevice *device, const char *want, int threads);

/* The same device with a queue of its own, for another thread; the original must outlive it. The
 * caller frees with oz_device_close. */
OzStatus oz_device_branch(OzDevice *branch, const OzDevice *device);

/* Closes; a zeroed device is fine. */
void oz_device_close(OzDevice *device);

/* Fails with OZ_ERR_DEVICE if a scene needs double and the device computes in float only. */
OzStatus oz_device_check_double(const OzDevice *device, bool is_needed);

/* Every device, numbered, and why it would be refused. */
OzStatus oz_device_list(FILE *file);
