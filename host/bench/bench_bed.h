/* The beds that the benchmark runs: a scene with its grains, settled and shaken, and large beds of
 * the same height made of copies of a small one. */
#pragma once

#include "cli.h"
#include "model/grains.h"

/* A scene and its grains' state at time 0. Zeroed is empty. */
typedef struct OzBenchBed {
    OzScene scene;
    OzGrains grains;
} OzBenchBed;

enum {
    OZ_BENCH_BED_TAKES = 4, /* states of a tile, a tap apart, so that no two neighbours are alike */
    OZ_BENCH_BED_TAPS = 4 /* shaken before the first of them: the bed has forgotten its settling */
};

/* A tile at OZ_BENCH_BED_TAKES moments: the bed is the first. */
typedef struct OzBenchTile {
    OzBenchBed bed;
    double *states; /* takes x grains x OZ_BENCH_BED_WORDS */
    double side;    /* m, of the square                    */
} OzBenchTile;

enum { OZ_BENCH_BED_WORDS = 13 }; /* position, quaternion, velocity, spin of a grain */

/* Loads a scene file (NULL: an6, which the program carries) and places its grains. The caller
 * frees. */
OzStatus oz_bench_bed_load(OzBenchBed *bed, const OzOptions *options, const char *path);

/* an6's grains and floor in a square box of plane walls, with as much floor a grain as an6's
 * cylinder has: beds of any count are equally high. */
OzStatus oz_bench_bed_box(OzBenchBed *bed, double *side, const OzOptions *options, int64_t count);
void oz_bench_bed_free(OzBenchBed *bed);

/* Settles the bed as its scene says and shakes it for some taps, in a process of its own. */
OzStatus oz_bench_bed_settle(OzBenchBed *bed, const OzOptions *options, int taps);

/* Gives bed the state of another of the same grains, which is settled. */
void oz_bench_bed_take(OzBenchBed *bed, const OzBenchBed *from);

/* A settled and shaken tile of so many grains. */
OzStatus oz_bench_bed_tile(OzBenchTile *tile, const OzOptions *options, int64_t count);
void oz_bench_bed_free_tile(OzBenchTile *tile);

/* A box of tiles, turned by quarters and taken at moments drawn at random, as near to a square as
 * count allows; count is rounded to whole tiles. */
OzStatus oz_bench_bed_pave(OzBenchBed *bed, const OzBenchTile *tile, const OzOptions *options,
                           int64_t count);
