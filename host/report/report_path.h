/* Paths of grains against those of a small step, for as long as they can be compared: in a bed two
 * paths that differ by rounding part exponentially, and from some time on no step is right. */
#pragma once

#include "report/report_start.h"

enum { OZ_REPORT_PATH_MOST = 32 };

/* One setting, in the scene's precision. */
typedef struct OzReportPath {
    OzIntegrator integrator;
    int64_t substeps; /* of beams                                                             */
    double steps;     /* per cycle                                                            */
    double step;      /* s, as asked; a run's own is shorter so that it ends at the horizon   */
    double largest;   /* s, the largest stable step (oz_report_start_limit)                   */
    double error;     /* rms over grains of the distance to the small-step path at the horizon,
                         in mean diameters                                                    */
    double wall;      /* s per simulated s                                                    */
    double cost;      /* the same, from the least time that any step of this integrator took  */
    bool good; /* error, wall and cost are there; otherwise:                                 */
    char reason[200]; /* why not                                                              */
} OzReportPath;

typedef struct OzReportPaths {
    OzReportPath path[OZ_REPORT_PATH_MOST]; /* the first: the scene as written */
    int count;
    double longest; /* s, followed by the two small-step paths                         */
    double horizon; /* s, up to which these two agree to OZ_REPORT_PATH_APART; 0: not even at the
                       first look                                                             */
    double apart;   /* of these two at the horizon, diameters: errors below are not seen  */
    double truth_steps; /* per cycle, of the finer of the two                                 */
    double moved;       /* rms distance of grains from their start there, diameters           */
    bool touched;       /* grains touched at a look                                           */
} OzReportPaths;

/* In diameters: paths that are this close are still the same path. */
#define OZ_REPORT_PATH_APART 1e-3

/* Follows two small-step paths (double, where the device has it; velocity-verlet, trigrains:
 * gear4), finds the horizon, and measures every integrator of the model at a ladder of steps there.
 * The time followed is a period of the first moving wall, else what grains need to fall 200
 * diameters, else (or with few grains) the scene's, or less, so that all takes about a minute
 * (quick: some seconds) and the building of kernels. A line in the log before each stage. */
OzStatus oz_report_path_study(OzReportPaths *paths, const OzReportStart *start,
                              const OzOptions *options, const OzDevice *device);

void oz_report_path_print(FILE *file, const OzReportPaths *paths, const OzReportStart *start);

/* The same as numbers, into paths.csv of the folder. Fails with OZ_ERR_FILE. */
OzStatus oz_report_path_write(const char *folder, const OzReportPaths *paths);
