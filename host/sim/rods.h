/* The model of rods and spheres. */
#pragma once

#include "sim/model.h"

extern const OzModel oz_rods_model;
