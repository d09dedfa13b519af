/* From what was drawn of rods to finished pixels: outlines smoothed, darkened where nearer things
 * stand around a pixel, faded with depth. On the host, whose vectors read neighbours side by side.
 */
#pragma once

#include "draw/drawn.h"

enum { OZ_FINISH_PAIRS = 64 };

/* How; the same for a whole picture. */
typedef struct OzFinish {
    int pairs;                      /* of neighbours that may darken a pixel                     */
    int taps[OZ_FINISH_PAIRS][2];   /* pixels; the other of a pair lies opposite                 */
    int reach;                      /* pixels: the furthest tap along an axis                    */
    float steepness;                /* 1/depth at which a pair darkens fully                     */
    float darkening, fade;          /* 0 to 1                                                    */
    float by_depth, by_row, middle; /* how far behind the middle, 0 to 1; rows from below        */
    float background[3];            /* 0 to 1                                                    */
} OzFinish;

/* Into the image's box. Fails with OZ_ERR_MEMORY. */
OzStatus oz_finish_pixels(const OzFinish *finish, const OzDrawn *drawn, OzImage *image);
