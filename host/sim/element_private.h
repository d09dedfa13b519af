/* What the files of trigrains' simulation share among themselves: what the driver keeps for them,
 * as what it is. */
#pragma once

#include "sim/element_fields.h"
#include "sim/sim_private.h"

/* Trigrains' own part of a simulation. */
typedef struct OzTrigrains {
    unsigned *present; /* one a member: a bit for each wall that is there */
    bool *outlined;    /* one a member: outer edges are those of its pieces */
    cl_kernel begin;
} OzTrigrains;

OZ_SIM_VIEWS(oz_element, OzTrigrains, OzElementSwitches, OzElementSizes, OzElementControl,
             OzElementParameters)
