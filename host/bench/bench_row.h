/* One row of the benchmark: a bed stepped on a device with so many threads, in a process of its
 * own. */
#pragma once

#include "bench/bench_bed.h"

/* THE list of columns: name in bench.csv, heading on the terminal (NULL: in the file only),
 * decimals, meaning. us_per_step is the median over timed pieces of one tap each; where a tap takes
 * too long, the pieces are shorter and it is the mean over all of them, because the lists are not
 * rebuilt in each. */
#define OZ_BENCH_COLUMNS(X)                                                                        \
    X(GRAINS, "grains", "grains", 9, 0, "grains of one scene")                                     \
    X(MEMBERS, "scenes", NULL, 0, 0, "equal scenes side by side")                                  \
    X(BITS, "bits", "bits", 5, 0, "of a number: 32 float, 64 double")                              \
    X(LANES, "lanes", NULL, 0, 0, "of a vector")                                                   \
    X(THREADS, "threads", "thr", 5, 0, "of a CPU device")                                          \
    X(US_STEP, "us_per_step", "us/step", 12, 2, "wall time of a step")                             \
    X(US_LEAST, "us_per_step_least", NULL, 0, 2, "the fastest piece's")                            \
    X(US_CPU, "cpu_us_per_step", "cpu us", 12, 2,                                                  \
      "processor time of a step, all threads together")                                            \
    X(NS_GRAIN, "ns_per_grain_step", "ns/grain", 10, 2, "wall time of a step / all grains")        \
    X(REFRESH, "steps_per_refresh", "refresh", 9, 1, "steps per renewal of the inner list")        \
    X(REBUILD, "steps_per_rebuild", "rebuild", 9, 0, "steps per rebuilding of the outer list")     \
    X(PAIRS, "pairs_per_grain", "pairs", 7, 2, "of the inner list")                                \
    X(TOUCHING, "touching_per_grain", "touch", 7, 2, "pairs in contact")                           \
    X(BYTES, "bytes_per_grain", "B/grain", 9, 0, "of device arrays")                               \
    X(GBYTES, "gb_per_s", "GB/s", 8, 2, "counted bytes moved")                                     \
    X(GFLOPS, "gflop_per_s", "GFLOP/s", 9, 2, "counted operations")                                \
    X(COPY, "copy_gb_per_s", NULL, 0, 1, "of a copy that touches as many bytes as a step")         \
    X(MULTIPLY_ADD, "fma_gflop_per_s", NULL, 0, 1, "of multiply-adds in registers")                \
    X(SHARE, "percent_of_limit", "%limit", 8, 1,                                                   \
      "of the time that a copy or multiply-adds need, the larger")                                 \
    X(OBSERVE, "observe_us_per_step", NULL, 0, 2, "of us_per_step: snapshots and series.csv")      \
    X(START, "start_s", "start s", 9, 2, "from opening the device to the end of the first launch") \
    X(TAPS, "taps", "taps", 8, 2, "that were timed")                                               \
    X(PIECES, "pieces", NULL, 0, 0, "timed one by one")                                            \
    X(STEPS_LAUNCH, "steps_per_launch", NULL, 0, 1, "steps per launch")

enum {
#define OZ_BENCH_COLUMN_ID(id, name, heading, width, decimals, meaning) OZ_BENCH_##id,
    OZ_BENCH_COLUMNS(OZ_BENCH_COLUMN_ID)
#undef OZ_BENCH_COLUMN_ID
        OZ_BENCH_COLUMN_COUNT
};

typedef struct OzBenchRow {
    char bed[48];                        /* "an6", "an6 x 2", "box", "yardstick" */
    double value[OZ_BENCH_COLUMN_COUNT]; /* NAN: not measured         */
} OzBenchRow;

typedef struct OzBenchJob {
    const OzOptions *options;
    OzBenchBed *bed;
    const char *name;
    int members, threads; /* threads 0: all                                             */
    bool is_double;
    bool observed;  /* samples and rows as `orzo run --no-video` takes them        */
    double seconds; /* about so long                                              */
} OzBenchJob;

/* A row of which nothing is known but its name. */
OzBenchRow oz_bench_row_empty(const char *name);

/* "an6 x 2, float, 2 threads" */
void oz_bench_row_describe(const OzBenchRow *row, char *text, size_t size);

OzStatus oz_bench_row_measure(OzBenchRow *row, const OzBenchJob *job);
