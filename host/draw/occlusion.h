/* Which grains others hide wholly from the eye: they are the nearest in no
 * pixel's middle. A picture of depths that grains, nearest first, fill with
 * what they surely cover. */
#pragma once

#include "draw/bodies.h"

#include <stdbool.h>

typedef struct OzOcclusion {
    const OzCamera *camera; /* borrowed */
    float *nearest;         /* columns x rows: z of what covers a pixel's middle */
    int columns, rows;
    double middle[2]; /* pixels: where the origin of view coordinates lies */
} OzOcclusion;

/* An empty picture of the box of a panel. Freed with oz_occlusion_free. Fails
 * with OZ_ERR_MEMORY. */
OzStatus oz_occlusion_begin(OzOcclusion *occlusion, const OzCamera *camera, int panel,
                            const OzBox *box);
void oz_occlusion_free(OzOcclusion *occlusion); /* zeroed is fine */

/* Whether it is hidden in every pixel. */
bool oz_occlusion_hides(const OzOcclusion *occlusion, const OzBody *body);

/* What comes later is hidden behind the part of this body whose axis runs
 * between these places, from -half_shaft to half_shaft; nothing is where the
 * first is the larger. */
void oz_occlusion_add(OzOcclusion *occlusion, const OzBody *body, double from, double to);
