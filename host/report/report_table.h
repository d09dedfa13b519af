/* A report in words and numbers: report.csv, the Pareto front, the sentence for a tolerance. */
#pragma once

#include "report/report_point.h"

#include <stdio.h>

/* Marks the points of one scene that no other point beats in both wall time and RMS error. */
void oz_report_table_front(OzReportPoint *points, int count);

/* The good point of least wall time whose greatest error is at most tolerance; NULL: there is none.
 */
const OzReportPoint *oz_report_table_cheapest(const OzReportPoint *points, int count,
                                              double tolerance);

/* "velocity-verlet, 4 substeps, double": integrator and precision in words. */
void oz_report_table_method(const OzReportPoint *point, char *text, size_t size);

/* Whether two points are of one method: integrator, substeps, precision and device. */
bool oz_report_table_alike(const OzReportPoint *a, const OzReportPoint *b);

/* The order at which one method's RMS error falls with the step, fitted over its good points
 * (those alike); NAN where errors are mere rounding or too
 * few. */
double oz_report_table_order(const OzReportPoint *points, int count, const OzReportPoint *like);

/* One sentence for one scene, what failed, and, with paste, the setting as lines of a scene file.
 */
void oz_report_table_say(FILE *file, const OzReportPoint *points, int count, double tolerance,
                         bool paste);

/* Writes folder/report.csv. */
OzStatus oz_report_table_write(const char *folder, const OzReportPoint *points, int count);
