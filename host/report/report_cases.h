/* THE list of small scenes of known outcome, of rods and of trigrains. */
#pragma once

#include "report/report_case.h"

/* The rows of a model, ending with one whose scene is NULL. */
const OzReportCase *oz_report_cases_all(OzModelKind model);

/* The row of a scene's name, or NULL. */
const OzReportCase *oz_report_cases_find(const char *scene);

/* What comes out at the end of a case; unused values are left alone. */
void oz_report_cases_read(const OzReportCase *row, const OzSnapshot *end,
                          double values[OZ_REPORT_VALUES]);

/* Error of an end: a share of the truth where a case of one value has no unit. */
double oz_report_cases_error(const OzReportCase *row, const OzSnapshot *end,
                             const double truth[OZ_REPORT_VALUES]);
