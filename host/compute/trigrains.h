/* The model of trigrains. */
#pragma once

#include "compute/model.h"

extern const OzModel oz_trigrains_model;
