/* The model of rods and spheres. */
#pragma once

#include "compute/model.h"

extern const OzModel oz_rods_model;
