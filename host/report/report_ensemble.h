/* `orzo report --ensemble`: what a chaotic bed owes to its step and integrator. Two runs of such a
 * bed part within a few taps whatever the step, so paths are never compared: only means over seeds,
 * with their spread and interval. */
#pragma once

#include "cli.h"

/* Runs the scene of options->paths[0] for every integrator (or that of --set integrator=...) at 20
 * to 100 steps per contact (--quick: 20 and 40, for 2 taps), each for all seeds (default 1 to 4)
 * side by side, for the 20 taps or what time.taps is set to; prints a table and leaves
 * ensemble.csv, ensemble.png and the runs in folder. A setting that fails is listed with its
 * reason. Fails with OZ_ERR_INPUT when the scene has no moving wall. */
OzStatus oz_report_ensemble_run(const OzOptions *options, const char *folder);
