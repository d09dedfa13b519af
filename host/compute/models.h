/* THE list of models. */
#ifndef OZ_COMPUTE_MODELS_H
#define OZ_COMPUTE_MODELS_H

#include "compute/model.h"

/* The model of a scene. */
const OzModel *oz_models_of(const OzScene *scene);

#endif
