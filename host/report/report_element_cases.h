/* The cases of trigrains, for THE list in report_cases.c. */
#pragma once

#include "report/report_case.h"

/* Ends with a row whose scene is NULL. */
extern const OzReportCase oz_report_element_cases_rows[];
