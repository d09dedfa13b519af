/* Which scenes may be members of one simulation, and how many a device holds. */
#pragma once

#include "compute/device.h"
#include "model/grains.h"

#include <stdbool.h>

/* Whether two scenes can share launches: the same model, kernel switches, step and settling, and
 * what else the model asks for. */
bool oz_batch_fit_agrees(const OzDevice *device, const OzMember *a, const OzMember *b);

/* How many members like this one fit the device's memory at a time, lists grown by half included;
 * at least 1. *bytes receives what one needs. */
OzStatus oz_batch_fit_most(const OzDevice *device, const OzMember *member, int64_t *most,
                           double *bytes);
