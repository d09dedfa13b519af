/* One point of a work-precision study: a scene run with one integrator, precision and step; its
 * error over the phases of first touch, and its wall time. */
#pragma once

#include "report/report_job.h"

/* Steps per contact of the truth where no exact answer exists. Halving the step again moves it by
 * less than a tenth of the error of the finest point of the ladder. */
#define OZ_REPORT_POINT_TRUTH 10000

/* The truth of a scene of rods: exact, or the double reference (velocity-verlet) at
 * OZ_REPORT_POINT_TRUTH steps per contact. */
OzStatus oz_report_point_truth(double *truth, const OzReportJob *job);

/* Fills the point's errors and times from its integrator, precision, steps and truth. A setting
 * that is unstable or blows up is no failure: the point's reason says so. */
OzStatus oz_report_point_measure(OzReportPoint *point, const OzReportJob *job);
