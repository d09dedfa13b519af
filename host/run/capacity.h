/* How many members of an ensemble there is room for at a time. */
#pragma once

#include "cli.h"
#include "sim/sim.h"

/* By memory of the device and of this machine and by open files, for members like this one; at
 * least 1. Asks the system for as many open files as it gives. *bytes receives what one needs. */
OzStatus oz_capacity_most(const OzOptions *options, const OzDevice *device, const OzMember *member,
                          int64_t *most, double *bytes);
