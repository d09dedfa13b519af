/* Where a body's images stand in a periodic cell: neighbours are searched about each of those that
 * may have some. Cells of the hashed grid know nothing of them. OpenCL C only. */
#pragma once

#include "kernels/cells.h"

#if OZ_NEAR_PERIODIC

/* The images that are still to come, and the place of the body itself. */
typedef struct OzImages {
    place_kind own[3];
    place_kind period[3];
    int low[3], high[3]; /* cells aside, along each axis   */
    int at[3];           /* of the next                    */
} OzImages;

/* How much farther along the first axis a sheared cell's lattice has what is `far` (m) away. */
OZ_INLINE scalar oz_images_slant(const OzWork *w, scalar far)
{
#if OZ_SHEAR
    return fabs(oz_work_space(w).tilt) * far;
#else
    return 0;
#endif
}

/* Those within `far` (m) of the cell, the body itself among them. */
OZ_INLINE OzImages oz_images_of(const OzWork *w, const place_kind place[3], scalar far)
{
    global const OzParameters *p = w->parameters;
    OzImages images;
    for (int k = 0; k < 3; k++) {
        scalar wide = far + (k == 0 ? oz_images_slant(w, far) : 0);
        scalar at = (scalar)place[k], beside = p->period[k] / 2 - wide / p->length_unit;
        int repeats = OZ_PERIODIC >> k & 1;
        images.own[k] = place[k];
        images.period[k] = (place_kind)p->period[k] + (place_kind)p->period_rest[k];
        images.low[k] = images.at[k] = repeats && at > beside ? -1 : 0;
        images.high[k] = repeats && -at > beside ? 1 : 0;
    }
    return images;
}

/* The place of the next image; 0 when there is none. */
OZ_INLINE int oz_images_next(OzImages *images, place_kind place[3])
{
    if (images->at[2] > images->high[2]) {
        return 0;
    }
    for (int k = 0; k < 3; k++) {
        place[k] = images->own[k] + images->at[k] * images->period[k];
    }
    int k = 0;
    while (k < 2 && images->at[k] == images->high[k]) {
        images->at[k] = images->low[k];
        k++;
    }
    images->at[k]++;
    return 1;
}

/* Of each candidate one image counts: the nearest. Differences in m. */
OZ_INLINE mask oz_images_nearest(const OzWork *w, real x, real y, real z)
{
    real apart[3] = {x, y, z};
    mask nearest = x == x;
    for (int k = 0; k < 3; k++) {
        if (OZ_PERIODIC >> k & 1) {
            real beside = REAL(w->parameters->period[k] / 2 * w->parameters->length_unit);
            nearest = nearest & (apart[k] >= -beside) & (apart[k] < beside);
        }
    }
    return nearest;
}

#endif
