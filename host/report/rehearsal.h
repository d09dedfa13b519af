/* A rehearsal of a run: its bed settled and its first steps made, to say how stiff the bed is and
 * what a step costs here, before anyone waits for it. */
#pragma once

#include "sim/sim.h"
#include "sim/stiffness.h"

#include <stdbool.h>

/* Zeroed is valid. */
typedef struct OzRehearsal {
    OzSnapshot now; /* the settled bed, or as it starts                                */
    bool cut;       /* not settled to the end, for want of patience                    */
    double settled_time, settled_in; /* s simulated, s of computing, of settling so far */
    double settling_left; /* s of computing, at most, that a cut settling would still have taken */
    bool has_stiffness;   /* oz_stiffness_applies, and some grain is there              */
    OzStiffness stiffness;
    int64_t steps; /* of the timed stretch; 0: there was none                           */
    double spent;  /* s of computing that they took                                     */
} OzRehearsal;

/* Settles the scene where it says so, for at most `patience` seconds of computing, measures the
 * bed's stiffness, then makes steps for about `stretch` seconds (0: none). scene and grains are
 * borrowed and must outlive the rehearsal. Fails as a run would; what it found so far stays. The
 * caller frees. */
OzStatus oz_rehearsal_run(OzRehearsal *rehearsal, const OzScene *scene, const OzGrains *grains,
                          const OzDevice *device, const char *source_dir, double patience,
                          double stretch);
void oz_rehearsal_free(OzRehearsal *rehearsal);
