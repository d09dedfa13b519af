/* THE list of stiff and extreme cases of trigrains. A new case is a row (study/
 * report_extreme_cases.h says what a row is). */
#pragma once

#include "report/report_extreme_cases.h"

/* Dice of 2 mm with the beams of Poeschel and Buchholtz (1995), 1 us, no gravity, the ledger; one
 * floor far below. */
extern const OzExtremeSuite oz_report_extreme_elements_suite;
