/* What a guard of the kernels found, in words. */
#ifndef OZ_COMPUTE_GUARD_H
#define OZ_COMPUTE_GUARD_H

#include "base/status.h"
#include "compute/constants.h"
#include "observe/snapshot.h"

#include <stdbool.h>
#include <stdint.h>

/* Fails with OZ_ERR_BLOWUP, naming grain, step, time, reasons, and what would help. now: the state
 * after that step. */
OzStatus oz_guard_fail(const OzControl *control, const OzSnapshot *now, bool settling);

#endif
