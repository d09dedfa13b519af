/* Walking the predictions of a scene. */
#include "study/report_refuse.h"

#include "model/predict.h"

#include <stdlib.h>

OzStatus oz_report_refuse_unstable(const OzScene *scene, const OzGrains *grains)
{
    OzPrediction *rows = NULL;
    int count = 0;
    OzStatus status = oz_predict_scene(&rows, &count, scene, grains);
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
