/* What a work-precision study asks for, and a point of it. */
#pragma once

#include "cli.h"
#include "compute/device.h"
#include "report/report_case.h"

typedef struct OzReportJob {
    const OzOptions *options; /* settings, source folder, --force */
    const OzDevice *device;   /* that of the points */
    const char *path;         /* scene file                                       */
    const OzReportCase *row;
    double truth[OZ_REPORT_VALUES]; /* what its values should be                    */
    int phases;  /* copies side by side, each starting earlier by another share of a step, evenly
                    stratified  (without phases of first touch all alike)  */
    int repeats; /* timed runs of all copies                                              */
} OzReportJob;

typedef struct OzReportPoint {
    char scene[64];
    const OzReportCase *row;
    const OzDevice *device; /* borrowed                                          */
    const char *label;      /* the device as it was asked for; "" when it is the only one */
    OzIntegrator integrator;
    OzPrecision precision;
    int substeps;      /* of beams; 0: none                                    */
    bool host;         /* by the reference on the host, one copy after another */
    int steps;         /* per cycle                                            */
    const char *cycle; /* as OzReportMethods says                              */
    double step;       /* s                                                    */
    double truth;      /* what the value should be; of several 0, their distance */
    double floor;      /* errors below it are not the method's                 */
    double error_rms;  /* over the phases                                      */
    double error_max;  /* of any phase                                         */
    double wall;       /* s per simulated s: median, for one of the copies     */
    double wall_low, wall_high;
    double evaluations; /* of all forces, per simulated s                       */
    bool good;          /* all of the above is filled in; otherwise: */
    char reason[200];   /* why not                                   */
    bool front;         /* no other point is both faster and more accurate      */
} OzReportPoint;
