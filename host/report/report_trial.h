/* Experiments of which the outcome is known: a scene is run for several seeds and variants, looked
 * at evenly spaced moments, and what was seen is left as numbers. */
#pragma once

#include "cli.h"
#include "compute/device.h"
#include "model/snapshot.h"

enum { OZ_TRIAL_VARIANTS = 8, OZ_TRIAL_NUMBERS = 8, OZ_TRIAL_SEEDS = 16, OZ_TRIAL_SETTINGS = 3 };

/* What looks have left of one variant and seed, zeros at first; what they mean is the trial's own.
 */
typedef double OzTrialNumbers[OZ_TRIAL_NUMBERS];

typedef struct OzTrial {
    const char *scene; /* below scenes/, without .yaml: "validation/incline"                  */
    int seeds;         /* 1: nothing depends on the seed                                      */
    int looks;         /* after the one at time 0, the last at the scene's end                */
    /* settings of each variant, from the first; without any there is one */
    const char *variants[OZ_TRIAL_VARIANTS][OZ_TRIAL_SETTINGS];
    /* look: 0 at time 0 */
    void (*look)(OzTrialNumbers numbers, const OzSnapshot *now, int look);
} OzTrial;

typedef struct OzTrialOutcome {
    int seeds, variants;
    OzTrialNumbers numbers[OZ_TRIAL_SEEDS][OZ_TRIAL_VARIANTS];
} OzTrialOutcome;

/* Seeds are the user's, else the trial's (--quick: three at most); the user's settings come after
 * the scene's and before the variant's. With a path the scene is read from there, else from the
 * copy in the program. Fails as a run does; a member that a guard stops fails with OZ_ERR_BLOWUP.
 */
OzStatus oz_report_trial_run(OzTrialOutcome *outcome, const OzTrial *trial, const char *path,
                             const OzOptions *options, const OzDevice *device);
