/* The model of trigrains. */
#pragma once

#include "sim/model.h"

extern const OzModel oz_trigrains_model;
