/* One point of a work-precision study: a scene run with one integrator, precision and step; its
 * error over the phases of first touch, and its wall time. */
#pragma once

#include "report/report_job.h"

/* Fills job->truth: exact, or by the reference (report_methods.h). */
OzStatus oz_report_point_truth(OzReportJob *job);

/* Fills the point's errors and times from its integrator, precision, steps and the job's truth. A
 * setting that is unstable or blows up is no failure: the point's reason says so. */
OzStatus oz_report_point_measure(OzReportPoint *point, const OzReportJob *job);
