/* The model of rods and spheres. */
#ifndef OZ_COMPUTE_RODS_H
#define OZ_COMPUTE_RODS_H

#include "compute/model.h"

extern const OzModel oz_rods_model;

#endif
