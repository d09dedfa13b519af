/* Comparing scenes of trigrains by what their kernels, launches and settling have in common. */
#include "compute/piece_company.h"

#include "compute/piece_arrays.h"
#include "compute/piece_sizes.h"
#include "compute/rest.h"

#include <math.h>
#include <string.h>

bool oz_piece_company_fits(const OzDevice *device, const OzMember *a, const OzMember *b)
{
    if (a->scene->model != b->scene->model) {
        return false;
    }
    OzPieceSwitches s = oz_piece_switches_derive(a->scene, a->grains, device);
    OzPieceSwitches other = oz_piece_switches_derive(b->scene, b->grains, device);
    return memcmp(&s, &other, sizeof s) == 0 && a->scene->step == b->scene->step &&
           a->scene->wall_count == b->scene->wall_count &&
           oz_rest_is_same(&a->scene->settle, &b->scene->settle);
}

OzStatus oz_piece_company_most(const OzDevice *device, const OzMember *member, int64_t *most,
                               double *bytes)
{
    OzStatus status = OZ_OK;
    OzPieceParameters parameters;
    OzPieceSizes sizes;
    double largest = 1, sum = 0;
    OzPieceSwitches switches = oz_piece_switches_derive(member->scene, member->grains, device);
    OZ_TRY(oz_piece_sizes_parameters(&parameters, member->scene, member->grains));
    oz_piece_sizes_choose(&sizes, &parameters, member->scene, member->grains, &switches);
    for (int f = 0; f < OZ_PIECE_FIELD_COUNT; f++) {
        double field = 1.5 * (double)oz_piece_arrays_bytes((OzPieceFieldId)f, &switches, &sizes);
        largest = fmax(largest, field);
        sum += field;
    }
    *bytes = sum;
    *most = (int64_t)fmax(1, fmin((double)device->largest_buffer / largest,
                                  0.8 * (double)device->memory / fmax(sum, 1)));
done:
    return status;
}
