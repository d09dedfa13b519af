/* What nearly parallel contacts cost: torque noise and energy from nowhere of `parallel: single`
 * against `line`, in a bed of aligned rods. */
#pragma once

#include "cli.h"
#include "scene/scene.h"

typedef struct OzParallelNoise {
    double energy; /* gained, as a share of what there was                                       */
    double jump;   /* RMS change of torque from a step to the next, as a share of the RMS torque */
} OzParallelNoise;

/* Runs the scene, in double, with this kind of contact at so many steps per contact; grains get
 * velocities of up to 20 mm/s from the scene's seed. A blow-up gives infinite noise. */
OzStatus oz_report_parallel_measure(OzParallelNoise *noise, const char *path, OzParallel parallel,
                                    int steps, const OzOptions *options);

/* Both kinds at 10 to 500 steps per contact (--quick: 10 to 50): prints a table, leaves
 * folder/aligned.csv and, with gnuplot, folder/aligned.png. */
OzStatus oz_report_parallel_study(const char *path, const char *folder, const OzOptions *options);
