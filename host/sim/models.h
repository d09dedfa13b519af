/* THE list of models. */
#pragma once

#include "sim/model.h"

/* The model of a scene. */
const OzModel *oz_models_of(const OzScene *scene);
