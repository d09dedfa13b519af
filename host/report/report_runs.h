/* The copies of a scene that one point of a report runs side by side: the scene at the point's
 * setting, and one start for each phase of first touch (or for each start of the case's own). */
#pragma once

#include "report/report_job.h"
#include "sim/sim.h"

enum { OZ_REPORT_RUNS_MOST = 256 };

typedef struct OzReportRuns {
    OzScene scene;
    OzGrains starts[OZ_REPORT_RUNS_MOST];
    OzMember members[OZ_REPORT_RUNS_MOST];
    int count;
    int64_t steps; /* of the whole run */
} OzReportRuns;

/* Loads the scene with the user's settings and the point's, and places its grains; the caller frees
 * with oz_report_runs_close, also when this fails. */
OzStatus oz_report_runs_open(OzReportRuns **runs, const OzReportJob *job,
                             const OzReportPoint *point);
void oz_report_runs_close(OzReportRuns *runs); /* NULL is fine */
