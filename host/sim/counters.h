/* What a simulation holds at the moment, for benchmarks: pairs, contacts, memory. */
#pragma once

#include "sim/sim.h"

/* Sums over all members. */
typedef struct OzCounters {
    int64_t grains;
    int64_t pairs;    /* of the inner lists, which the forces walk          */
    int64_t touching; /* pairs that touched in the last step, or nearly so  */
    int64_t bytes;    /* of all device arrays                               */
    int walls;
    bool is_double, history, equal, round;
} OzCounters;

/* Reads lists and forces back: slow for large scenes. */
OzStatus oz_counters_read(OzCounters *probe, const OzSim *sim);
