/* What only a series of states tells about flat grains: how fast they flow out, and how the bed in
 * a drum moves: steadily, or sticking and slipping in avalanches. Rows of series.csv are the
 * states. */
#pragma once

#include "base/state.h"
#include "model/snapshot.h"

/* The least fall of a bed's centre of mass that is called an avalanche, degrees. A single grain of
 * 500 that rolls right across the drum lets it fall by 0.3 or less. */
#define OZ_FLOW_AVALANCHE 0.5

/* One evenly spaced sample of a drum's bed, degrees. */
typedef struct OzFlowSample {
    double surface, centre;
} OzFlowSample;

/* Zeroed is valid: nothing seen yet. The values are as of the last state seen. */
typedef struct OzFlow {
    bool has_outlet, has_rate;
    int64_t out_count; /* grains whose centre is below the outlet */
    double out_mass;   /* kg                                      */
    double out_rate;   /* kg/s since the state before             */
    bool has_surface, has_centre;
    double surface, centre; /* degrees, see observe/inclination.h */
    double mean,
        deviation; /* of surface over the later half of the samples, degrees; with samples */
    int64_t avalanche_count; /* a fall of centre from its highest by OZ_FLOW_AVALANCHE or more, that
                                has ended in a rise by half of that */
    double avalanche_size;   /* degrees that the last one fell in all */
    OzFlowSample *samples;
    int64_t sample_count, sample_capacity;
    double last_time, sample_time; /* s, of the last state and the last sample */
    bool seen, is_falling;
    double highest, lowest; /* degrees, of centre: before the fall, and in it */
} OzFlow;

/* Takes a state, later than the last. */
OzStatus oz_flow_see(OzFlow *flow, const OzSnapshot *snapshot);

/* Writes the amplitudes (degrees) of surface and centre at each frequency (Hz) of the later half of
 * the samples, lowest first, as CSV; at most OZ_FLOW_FREQUENCIES rows. Without samples of a drum
 * it writes no file. Stick-slip shows as peaks, steady flow as none. Fails with OZ_ERR_FILE. */
enum { OZ_FLOW_FREQUENCIES = 2000 };
OzStatus oz_flow_write_spectrum(const OzFlow *flow, double interval, const char *path);

void oz_flow_free(OzFlow *flow); /* zeroed is fine */

/* Saves or loads it (base/state.h). */
OzStatus oz_flow_state(OzFlow *flow, OzStateVisit *visit);
