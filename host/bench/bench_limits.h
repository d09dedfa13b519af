/* The device that a benchmark runs on, and what it can do at best. */
#pragma once

#include "cli.h"

#include <stdio.h>

typedef struct OzBenchDevice {
    char name[256];
    bool is_cpu, has_double;
    int units, threads; /* threads: of a CPU's rows that take all; 0 on other devices */
    int float_lanes, double_lanes;
    uint64_t memory; /* bytes */
} OzBenchDevice;

/* Looks at the device in a process of its own. */
OzStatus oz_bench_limits_device(OzBenchDevice *device, const OzOptions *options);

/* Prints the device, and its copy and multiply-add rates on one and on all threads. */
OzStatus oz_bench_limits_print(const OzBenchDevice *device, const OzOptions *options, FILE *file);

/* Bytes that are free on the host now; INFINITY when that is not told. */
double oz_bench_limits_free_memory(void);
