/* Timing single kernels on a simulation that stands still. */
#pragma once

#include "sim/sim_private.h"

/* How a kernel whose last argument is a number of repeats is timed. */
typedef struct OzTiming {
    size_t items;     /* work-items                                                            */
    double seconds;   /* that a timed launch shall take: long against its overhead, short for
                         the one who waits                                                     */
    int repeats_most; /* after which what is repeated would go too far                         */
} OzTiming;

/* Timed launches of which the median counts: odd, so that it is one of them. */
enum { OZ_TIMING_LAUNCHES = 5 };

/* Processor time of a CPU, wall-clock time of another device, s. */
double oz_timing_clock(const OzDevice *device);

double oz_timing_median(double times[OZ_TIMING_LAUNCHES]);

/* Seconds of one repeat of a kernel. */
OzStatus oz_timing_kernel(OzSim *sim, cl_program program, const char *name, const OzTiming *timing,
                          double *seconds);

/* The program of a simulation's switches, or of others; the caller releases it. */
OzStatus oz_timing_build(OzSim *sim, const void *switches, const char *source_dir, const char *name,
                         cl_program *program);

/* Calls measure with every array of the device saved, and puts them back afterwards. */
OzStatus oz_timing_restored(OzSim *sim, OzStatus (*measure)(void *context, OzSim *sim),
                            void *context);
