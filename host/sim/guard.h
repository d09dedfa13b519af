/* What a guard of the kernels found, in words. */
#pragma once

#include "sim/model.h"

#include <stdbool.h>

/* Fails with OZ_ERR_BLOWUP, naming grain, step, time, reasons, and what would help. now: the state
 * after that step. */
OzStatus oz_guard_fail(const OzModel *model, const OzControlHead *control, const OzSnapshot *now,
                       bool settling);
