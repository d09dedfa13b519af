/* The model of trigrains. */
#ifndef OZ_COMPUTE_TRIGRAINS_H
#define OZ_COMPUTE_TRIGRAINS_H

#include "compute/model.h"

extern const OzModel oz_trigrains_model;

#endif
