/* What the files of trigrains' simulation share among themselves: what the driver keeps for them,
 * as what it is. */
#pragma once

#include "sim/element_fields.h"
#include "sim/sim_private.h"

/* Trigrains' own part of a simulation. */
typedef struct OzTrigrains {
    unsigned *present; /* one a member: a bit for each wall that is there */
    cl_kernel begin;
} OzTrigrains;

static inline OzTrigrains *oz_element_own(const OzSim *sim)
{
    return sim->own;
}

static inline const OzElementSwitches *oz_element_switches(const OzSim *sim)
{
    return sim->arrays.switches;
}

static inline const OzElementSizes *oz_element_sizes(const OzSim *sim)
{
    return sim->arrays.sizes;
}

static inline OzElementControl *oz_element_control(const OzSim *sim, int member)
{
    return (OzElementControl *)sim->control + member;
}

static inline OzElementParameters *oz_element_parameters(const OzSim *sim, int member)
{
    return (OzElementParameters *)sim->parameters + member;
}
