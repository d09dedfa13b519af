/* What the files of trigrains' simulation share among themselves. */
#ifndef OZ_COMPUTE_PIECE_PRIVATE_H
#define OZ_COMPUTE_PIECE_PRIVATE_H

#include "compute/piece_arrays.h"
#include "compute/piece_sim.h"

struct OzPieceSim {
    const OzDevice *device; /* borrowed */
    OzMember *members;
    int member_count;
    OzPieceParameters *parameters; /* one a member, in double                          */
    OzPieceControl *control;       /* one a member, as last read or to be written next */
    unsigned *present;             /* one a member: a bit for each wall that is there  */
    cl_program program;
    cl_kernel advance, begin;
    OzPieceArrays arrays;
    int64_t step;     /* made since time 0 (or since settling began) by those that go on  */
    int64_t *reached; /* one a member: steps that it has made itself                      */
    bool *waits;      /* one a member: makes no steps for now (settled before others)     */
    char **stopped;   /* one a member: what a guard said; NULL while it goes on           */
    int launch_steps; /* of the next launch */
    bool walls_still; /* while settling     */
    OzSimCounts counts;
};

/* Uploads sim->parameters. */
OzStatus oz_piece_sim_write_parameters(OzPieceSim *sim);

#endif
