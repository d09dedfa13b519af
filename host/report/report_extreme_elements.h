/* THE list of stiff and extreme cases of trigrains. A new case is a row (study/
 * report_extreme_cases.h says what a row is). */
#pragma once

#include "report/report_extreme_cases.h"

/* The rows, ending with one whose name is NULL. */
const OzExtremeCase *oz_report_extreme_elements_all(void);

/* The keys that all cases share, as YAML without grains and walls: dice of 2 mm with the beams of
 * Poeschel and Buchholtz (1995), 1 us, no gravity, the ledger. */
const char *oz_report_extreme_elements_common(void);

/* The walls they share: one floor far below. */
const char *oz_report_extreme_elements_walls(void);
