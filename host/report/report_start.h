/* Where the study of a scene without a known answer begins: its bed, settled, or run until its
 * grains touch. */
#pragma once

#include "cli.h"
#include "compute/device.h"
#include "model/grains.h"
#include "sim/stiffness.h"

/* Zeroed is empty. */
typedef struct OzReportStart {
    OzScene scene;   /* as written, with the user's settings                                  */
    OzGrains grains; /* at the start of paths, without tangential springs                     */
    bool is_flat;    /* trigrains                                                             */
    double cycle;    /* s that steps are counted by: rods, the shortest hit; trigrains, the
                        period of the fastest vibration                                       */
    const char *cycle_name; /* "contact" or "period"                                             */
    bool touches;           /* grains touch at the start                                         */
    bool has_stiffness;     /* stiffness is that of the bed: rods of hooke that touch            */
    OzStiffness stiffness;
    double settled;      /* s of simulated time that settling takes; at most, where it was cut  */
    double step_seconds; /* wall time of a step, as written                                     */
    char how[200];       /* "the bed settled for 0.31 s"       */
} OzReportStart;

/* Of fewer grains every hit can be followed, from their placing on. */
enum { OZ_REPORT_START_FEW = 10 };

/* Loads the scene, lets it settle as it says, or else (unless grains are few) run until it has as
 * many contacts as half its grains, half its time at most; no more than some seconds of computing
 * for either. Grains whose clock cannot be set back (a wall that turns, goes away, or has a period
 * of its own) start as they are placed, and so does a scene that a guard stops. The caller frees,
 * also on failure. Fails with OZ_ERR_INPUT where nothing can ever touch and for a sweep. */
OzStatus oz_report_start_find(OzReportStart *start, const char *path, const OzOptions *options,
                              const OzDevice *device);
void oz_report_start_free(OzReportStart *start);

/* Below which a step is stable with an integrator and substeps of beams, s: of the bed as a whole
 * where its stiffness is known, and of every contact that can happen. */
OzStatus oz_report_start_limit(double *largest, const OzReportStart *start, OzIntegrator integrator,
                               int64_t substeps);

/* Prints what is known of the bed's stability. */
OzStatus oz_report_start_say(FILE *file, const OzReportStart *start);
