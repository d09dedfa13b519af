/* What a device can do at best: bytes moved and multiply-adds made in a second, measured with
 * kernels/limits.cl in the lanes of the physics. For `orzo bench`. */
#pragma once

#include "compute/device.h"

/* Bytes a second, read and written ones together, of a copy that touches `bytes` bytes over and
 * over: a few hundred kilobytes stay in a cache, some hundred megabytes come from memory. The
 * fastest of several launches. */
OzStatus oz_limits_copy(double *bytes_per_second, const OzDevice *device, const char *source_dir,
                        size_t bytes, bool is_double);

/* Operations a second, two for each multiply-add of each lane. The fastest of several launches. */
OzStatus oz_limits_multiply_add(double *operations_per_second, const OzDevice *device,
                                const char *source_dir, bool is_double);
