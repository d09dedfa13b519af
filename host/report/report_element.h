/* The work-precision study of trigrains: which methods are compared, at which steps, and against
 * what truth. */
#pragma once

#include "report/report_point.h"

/* Steps per period of the truth where no exact answer exists. */
#define OZ_REPORT_ELEMENT_TRUTH 3000

/* One curve of the report. */
typedef struct OzReportMethod {
    OzIntegrator integrator;
    OzPrecision precision;
    int substeps; /* of beams; 0: none                                */
    bool host;    /* by the reference on the host, else on a device   */
} OzReportMethod;

/* THE list of methods; *count receives its length. */
const OzReportMethod *oz_report_element_methods(int *count);

/* Steps per period of the fastest vibration, ascending. */
const int *oz_report_element_ladder(bool quick, int *count);

/* Fills job->truth: zeros where the case is exact, else the reference (gear4, double) at
 * OZ_REPORT_ELEMENT_TRUTH steps. */
OzStatus oz_report_element_truth(OzReportJob *job);
