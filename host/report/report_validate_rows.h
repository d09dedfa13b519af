/* THE list of experiments of `orzo report --validate`, ending with a NULL name. A new one is a
 * scene in scenes/validation/, a look and a row. */
#pragma once

#include "report/report_known.h"

extern const OzValidation oz_report_validate_rows_all[];
