/* What the files of the simulation share among themselves. */
#ifndef OZ_COMPUTE_SIM_PRIVATE_H
#define OZ_COMPUTE_SIM_PRIVATE_H

#include "compute/arrays.h"
#include "compute/crew.h"
#include "compute/large.h"
#include "compute/sim.h"

struct OzSim {
    const OzDevice *device; /* borrowed */
    OzCrew crew;
    OzParameters *parameters;     /* one a member, in double                          */
    OzControl *control;           /* one a member, as last read or to be written next */
    double *spring_start;         /* one a member: J in tangential springs at time 0  */
    int wall_order[OZ_WALLS_MAX]; /* scene's wall of each kernel wall             */
    cl_program program;
    cl_kernel advance; /* small scenes */
    OzLarge *large;    /* large scenes */
    OzArrays arrays;
    bool primed; /* velocity-verlet knows its first acceleration */
};

/* Uploads sim->parameters. */
OzStatus oz_sim_write_parameters(OzSim *sim);

/* The first force evaluation of integrators that need one. */
OzStatus oz_sim_prime(OzSim *sim);

#endif
