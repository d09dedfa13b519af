/* Comparing scenes by what their kernels, launches and settling have in common. */
#include "sim/batch_fit.h"

#include "sim/models.h"
#include "sim/relax.h"

#include <assert.h>
#include <math.h>
#include <string.h>

/* Room for the switches of any model: a number each. */
enum { SWITCHES_MOST = 64 };

bool oz_batch_fit_agrees(const OzDevice *device, const OzMember *a, const OzMember *b)
{
    const OzModel *model = oz_models_of(a->scene);
    int s[SWITCHES_MOST] = {0}, other[SWITCHES_MOST] = {0};
    if (model != oz_models_of(b->scene)) {
        return false;
    }
    assert(model->switches_bytes <= sizeof s);
    model->derive(s, a->scene, a->grains, device);
    model->derive(other, b->scene, b->grains, device);
    return memcmp(s, other, sizeof s) == 0 && a->scene->step == b->scene->step &&
           oz_relax_is_same(&a->scene->settle, &b->scene->settle) && model->fits(a, b, s);
}

OzStatus oz_batch_fit_most(const OzDevice *device, const OzMember *member, int64_t *most,
                           double *bytes)
{
    OzStatus status = OZ_OK;
    const OzModel *model = oz_models_of(member->scene);
    OzModelLayout layout;
    double largest = 1, sum = 0;
    OZ_TRY(oz_model_layout(&layout, model, member, device, NULL));
    for (int f = 0; f < model->field_count; f++) {
        double field = 1.5 * (double)oz_model_field_bytes(model, f, layout.switches, layout.sizes);
        largest = fmax(largest, field);
        sum += field;
    }
    *bytes = sum;
    *most = (int64_t)fmax(1, fmin((double)device->largest_buffer / largest,
                                  0.8 * (double)device->memory / fmax(sum, 1)));
done:
    oz_model_layout_free(&layout);
    return status;
}
