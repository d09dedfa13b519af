/* What single precision can tell apart in a scene of rods, and what its lightest contacts need. */
#pragma once

#include "base/status.h"
#include "model/grains.h"

#include <stdbool.h>
#include <stdio.h>

/* Digits of the lightest overlaps, measured by tests/test_light.c: with the first number grains
 * roll right to 0.01 % and hits are off by up to 5 %, with the second by less than 0.1 %. */
#define OZ_RESOLUTION_LEAST  10.0
#define OZ_RESOLUTION_ENOUGH 300.0

/* The change of speed in a step is rounded to whole digits of the speed: to 5 %, to 0.5 %. */
#define OZ_RESOLUTION_GAIN_LEAST  10.0
#define OZ_RESOLUTION_GAIN_ENOUGH 100.0

typedef struct OzResolution {
    double overlap; /* m: of a grain at rest under gravity, in the stiffest contact; of hits at the
                       speeds of the start where gravity is too weak to matter; INFINITY where
                       neither is known */
    bool rests;     /* the former                                                           */
    double digit;   /* m, of an overlap                                                     */
    double gain;    /* m/s, what gravity adds to a speed in a step; INFINITY: too weak to matter */
    double speed;   /* m/s, that may be reached                                             */
    double speed_digit; /* m/s, of such a speed                                             */
} OzResolution;

/* Whether overlaps are to be taken with more digits than a float of a difference has
 * (kernels/fine.h): in single precision, where contacts are light. */
bool oz_resolution_is_fine(const OzScene *scene, const OzGrains *grains);

/* For `orzo check`: a line on overlaps and one on speeds; nothing in double. */
OzStatus oz_resolution_print(FILE *file, const OzScene *scene, const OzGrains *grains);

/* Fails with OZ_ERR_INPUT where single precision would be silently wrong; a warning in the log
 * where it is coarse, or where force is set. */
OzStatus oz_resolution_judge(const OzScene *scene, const OzGrains *grains, bool force);
