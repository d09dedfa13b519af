/* Walking the predictions of a scene. */
#include "report/report_refuse.h"

#include "model/beam_limits.h"
#include "model/prediction.h"

#include <stdlib.h>

static OzStatus refuse_elements(const OzScene *scene, const OzGrains *grains)
{
    OzBeamLimit limit;
    OzStatus status = oz_beam_limits_find(&limit, scene, grains);
    if (status == OZ_OK && scene->step >= limit.largest_step) {
        status = oz_status_fail(OZ_ERR_INPUT,
                                "unstable: the largest stable step is %.4g s, %.4g of this one",
                                limit.largest_step, limit.largest_step / scene->step);
    }
    return status;
}

OzStatus oz_report_refuse_unstable(const OzScene *scene, const OzGrains *grains)
{
    OzPrediction *rows = NULL;
    int count = 0;
    if (scene->model == OZ_MODEL_TRIGRAINS) {
        return refuse_elements(scene, grains);
    }
    OzStatus status = oz_prediction_rows(&rows, &count, scene, grains);
    for (int i = 0; status == OZ_OK && i < count; i++) {
        bool touched = rows[i].wall >= 0 || grains->count > 1;
        if (touched && !rows[i].stable) {
            status = oz_status_fail(OZ_ERR_INPUT,
                                    "unstable: the largest stable step is %.4g s, %.4g of this one",
                                    rows[i].largest_step, rows[i].margin);
        }
    }
    free(rows);
    return status;
}
