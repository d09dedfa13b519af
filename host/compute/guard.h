/* What a guard of the kernels found, in words. */
#ifndef OZ_COMPUTE_GUARD_H
#define OZ_COMPUTE_GUARD_H

#include "base/status.h"
#include "compute/constants.h"

#include <stdbool.h>
#include <stdint.h>

/* Fails with OZ_ERR_BLOWUP, naming grain, step, time and reasons. step is the last one made. */
OzStatus oz_guard_fail(const OzControl *control, const OzScene *scene, int64_t step, bool settling);

#endif
