/* A study's runs in their folders: DIR/NAME is what `orzo run SCENE -o DIR/NAME --seeds A..B
 * --no-video` leaves, with the study's settings, so that runs made by hand are taken up too. */
#pragma once

#include "cli.h"
#include "figures/study.h"

/* What is behind a run's curves. */
typedef struct OzRunFacts {
    int64_t members, stopped; /* those that a guard stopped      */
    int64_t seed_first, seed_last;
    int64_t step_least, step_most; /* at which members ended */
    double end;                    /* of the longest member */
    bool in_taps;                  /* end is taps; else s, without a moving wall */
} OzRunFacts;

/* Whether every run's scene can be loaded with its settings: fails with OZ_ERR_INPUT and all that
 * is wrong. */
OzStatus oz_study_runs_check(const OzStudy *study, const OzOptions *options);

/* Makes the run where it is missing, goes on with it where it has not ended, leaves it alone where
 * it has. The command's options are those of `orzo figures`. Fails with OZ_ERR_INPUT for a folder
 * that holds another run, and as oz_run_scene does. */
OzStatus oz_study_runs_make(const OzStudy *study, const OzStudyRun *run, const char *folder,
                            const OzOptions *options);

/* Reads them from the run's members.csv. */
OzStatus oz_study_runs_facts(OzRunFacts *facts, const OzStudyRun *run, const char *folder);

/* DIR/NAME/FILE; the caller frees. */
OzStatus oz_study_runs_path(char **path, const OzStudyRun *run, const char *folder,
                            const char *file);
