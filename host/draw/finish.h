/* From what was drawn of rods to finished pixels: outlines smoothed, darkened where nearer things
 * stand around a pixel, faded with depth. On the host, whose vectors read neighbours side by side.
 */
#pragma once

#include "draw/shadow.h"

/* How; the same for a whole picture. */
typedef struct OzFinish {
    OzShadow shadow;
    float darkening, fade;          /* 0 to 1                                                    */
    float by_depth, by_row, middle; /* how far behind the middle, 0 to 1; rows from below        */
    float background[3];            /* 0 to 1                                                    */
} OzFinish;

/* Memory, kept from picture to picture. */
typedef struct OzFinishRoom {
    OzShadowRoom shadow;
    float *shade;     /* of a row of so many pixels      */
    uint8_t *divided; /* which of them outlines divide   */
    size_t width;
} OzFinishRoom;

/* Into the image's box; the planes' colours are changed on the way. Fails with OZ_ERR_MEMORY. */
OzStatus oz_finish_pixels(const OzFinish *finish, OzFinishRoom *room, const OzDrawn *drawn,
                          OzImage *image);

void oz_finish_free(OzFinishRoom *room); /* zeroed is fine */
