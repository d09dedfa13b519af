/* What the files of trigrains' simulation share among themselves: what the driver keeps for them,
 * as what it is. */
#pragma once

#include "compute/piece_fields.h"
#include "compute/sim_private.h"

/* Trigrains' own part of a simulation. */
typedef struct OzTrigrains {
    unsigned *present; /* one a member: a bit for each wall that is there */
    cl_kernel begin;
} OzTrigrains;

static inline OzTrigrains *oz_piece_own(const OzSim *sim)
{
    return sim->own;
}

static inline const OzPieceSwitches *oz_piece_switches(const OzSim *sim)
{
    return sim->arrays.switches;
}

static inline const OzPieceSizes *oz_piece_sizes(const OzSim *sim)
{
    return sim->arrays.sizes;
}

static inline OzPieceControl *oz_piece_control(const OzSim *sim, int member)
{
    return (OzPieceControl *)sim->control + member;
}

static inline OzPieceParameters *oz_piece_parameters(const OzSim *sim, int member)
{
    return (OzPieceParameters *)sim->parameters + member;
}
