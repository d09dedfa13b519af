/* Comparing scenes by what their kernels, launches and settling have in common. */
#include "compute/company.h"

#include "compute/arrays.h"
#include "compute/rest.h"
#include "compute/sizes.h"
#include "compute/switches.h"

#include <math.h>
#include <string.h>

/* Walls are numbered by kind in the kernels, one numbering for all members. */
static bool same_walls(const OzScene *a, const OzScene *b)
{
    for (int w = 0; w < a->wall_count && w < b->wall_count; w++) {
        if (a->walls[w].kind != b->walls[w].kind) {
            return false;
        }
    }
    return a->wall_count == b->wall_count;
}

bool oz_company_fits(const OzDevice *device, const OzMember *a, const OzMember *b)
{
    OzSwitches s = oz_switches_derive(a->scene, a->grains, device);
    OzSwitches other = oz_switches_derive(b->scene, b->grains, device);
    return memcmp(&s, &other, sizeof s) == 0 && !s.resort && !s.host_lists &&
           a->grains->count == b->grains->count && a->scene->step == b->scene->step &&
           same_walls(a->scene, b->scene) && oz_rest_is_same(&a->scene->settle, &b->scene->settle);
}

OzStatus oz_company_most(const OzDevice *device, const OzMember *member, int64_t *most,
                         double *bytes)
{
    OzStatus status = OZ_OK;
    OzParameters parameters;
    OzSizes sizes;
    int order[OZ_WALLS_MAX];
    double largest = 1, sum = 0;
    OzSwitches switches = oz_switches_derive(member->scene, member->grains, device);
    OZ_TRY(oz_constants_fill(&parameters, order, member->scene, member->grains));
    oz_sizes_choose(&sizes, &parameters, member->scene, member->grains, &switches, 1);
    for (int f = 0; f < OZ_FIELD_COUNT; f++) {
        double field = 1.5 * (double)oz_arrays_bytes((OzFieldId)f, &switches, &sizes);
        largest = fmax(largest, field);
        sum += field;
    }
    *bytes = sum;
    *most = (int64_t)fmax(1, fmin((double)device->largest_buffer / largest,
                                  0.8 * (double)device->memory / fmax(sum, 1)));
done:
    return status;
}
