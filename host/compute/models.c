/* THE list of models: one row each. */
#include "compute/models.h"

#include "compute/rods.h"
#include "compute/trigrains.h"

static const OzModel *const models[] = {
    [OZ_MODEL_RODS] = &oz_rods_model,
    [OZ_MODEL_TRIGRAINS] = &oz_trigrains_model,
};

const OzModel *oz_models_of(const OzScene *scene)
{
    return models[scene->model];
}
