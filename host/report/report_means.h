/* Where paths cannot be compared any more: means over seeds of what a few settings of a scene give,
 * with their intervals. */
#pragma once

#include "report/report_path.h"

enum { OZ_REPORT_MEANS_SETTINGS = 3, OZ_REPORT_MEANS_SEEDS = 64, OZ_REPORT_MEANS_QUANTITIES = 9 };

/* One setting. */
typedef struct OzReportMean {
    const char *label; /* "as written"                                                       */
    OzReportPath path; /* whose integrator, substeps and step are taken                      */
    int members;       /* that reached the end                                               */
    double value[OZ_REPORT_MEANS_QUANTITIES][OZ_REPORT_MEANS_SEEDS]; /* NAN: not defined     */
    char reason[200]; /* why not all did; empty: they did                                    */
} OzReportMean;

typedef struct OzReportMeans {
    OzReportMean setting[OZ_REPORT_MEANS_SETTINGS]; /* labels and paths, by the caller; the last
                                                       is what the others are compared with  */
    int count;
    int seeds;         /* 0: nothing was run:                                                    */
    char skipped[200]; /* why                                                               */
    double time;       /* s simulated, after settling                                            */
    int compared;      /* differences between a setting's means and the last one's               */
    int different;     /* of them, those larger than both 95 % intervals together                */
} OzReportMeans;

/* Runs every setting for all seeds (options', else 4, quick 2) side by side, for the scene's time
 * or what takes about a minute and a half (quick: ten seconds); nothing is run where the least that
 * shows anything (two periods, else a twentieth of the scene's time, after settling) would take
 * three times as long, or where nothing depends on the seed. A run's folder is folder/mean_0 ... A
 * setting that fails has its reason. Fails with OZ_ERR_INPUT for fewer than two seeds. */
OzStatus oz_report_means_study(OzReportMeans *means, const OzReportStart *start, const char *path,
                               const char *folder, const OzOptions *options);

/* What the scene has none of is left out, and named. */
void oz_report_means_print(FILE *file, const OzReportMeans *means);
