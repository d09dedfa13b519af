/* Closest points of pairs of shafts, one a lane: a thin shell for test_closest_device. */
#include "kernels/closest.h"

kernel void closest(global const real *in, global real *out)
{
    size_t block = get_global_id(0);
    global const real *v = in + 9 * block;
    OzClosest at = oz_closest(oz_vec3(v[0], v[1], v[2]), oz_vec3(v[3], v[4], v[5]),
                              oz_vec3(v[6], v[7], v[8]));
    out[2 * block] = at.s;
    out[2 * block + 1] = at.t;
}
