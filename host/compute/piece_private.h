/* What the files of trigrains' simulation share among themselves. */
#ifndef OZ_COMPUTE_PIECE_PRIVATE_H
#define OZ_COMPUTE_PIECE_PRIVATE_H

#include "compute/crew.h"
#include "compute/piece_arrays.h"
#include "compute/piece_sim.h"

struct OzPieceSim {
    const OzDevice *device; /* borrowed */
    OzCrew crew;
    OzPieceParameters *parameters; /* one a member, in double                          */
    OzPieceControl *control;       /* one a member, as last read or to be written next */
    unsigned *present;             /* one a member: a bit for each wall that is there  */
    cl_program program;
    cl_kernel advance, begin;
    OzPieceArrays arrays;
};

/* Uploads sim->parameters. */
OzStatus oz_piece_sim_write_parameters(OzPieceSim *sim);

#endif
