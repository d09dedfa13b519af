/* THE list of models: one row each. */
#include "sim/models.h"

#include "sim/rods.h"
#include "sim/trigrains.h"

static const OzModel *const models[] = {
    [OZ_MODEL_RODS] = &oz_rods_model,
    [OZ_MODEL_TRIGRAINS] = &oz_trigrains_model,
};

const OzModel *oz_models_of(const OzScene *scene)
{
    return models[scene->model];
}
