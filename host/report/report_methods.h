/* How a work-precision study of each model is made: which methods are compared, at which steps, and
 * against what truth. */
#pragma once

#include "scene/scene_types.h"

enum { OZ_REPORT_METHODS_MOST = 16, OZ_REPORT_RUNGS_MOST = 9 };

/* One curve of the report. */
typedef struct OzReportMethod {
    OzIntegrator integrator;
    OzPrecision precision;
    int substeps; /* of beams; 0: none                                */
    bool host;    /* by the reference on the host, else on a device   */
} OzReportMethod;

typedef struct OzReportMethods {
    const char *cycle; /* what steps divide: "contact", the contact time; "period", of the
                          fastest vibration                                       */
    const OzReportMethod *methods;
    int count;
    int steps[OZ_REPORT_RUNGS_MOST], quick[OZ_REPORT_RUNGS_MOST]; /* a cycle; up to a 0 */
    OzIntegrator truth; /* by the reference in double, where no exact answer exists, at */
    int truth_steps;    /* so many a cycle                                              */
} OzReportMethods;

const OzReportMethods *oz_report_methods_of(OzModelKind model);
