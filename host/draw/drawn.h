/* Rods as they are drawn, before outlines and shadows are finished: planes of colours and depths,
 * by OpenGL and read back, or by the host itself. */
#pragma once

#include "draw/camera.h"
#include "draw/image.h"

enum { OZ_DRAWN_BLOCK = 16 }; /* pixels that the host draws together */

/* A part of the picture as it was drawn, row 0 at the bottom, with a frame of depth 1 and colour 0
 * about it, a block wide. */
typedef struct OzDrawn {
    OzBox box;       /* in the picture, from its top                                         */
    int stride;      /* pixels from row to row: the box's width and both borders              */
    uint8_t *colour; /* its first pixel within the frame; RGB, and outline_code (lens.glsl)  */
    float *depth;    /* likewise; 0 nearest, 1 where nothing is                              */
} OzDrawn;

/* Their memory, kept from picture to picture. */
typedef struct OzDrawnRoom {
    uint8_t *colour;
    float *depth;
    size_t capacity; /* pixels */
} OzDrawnRoom;

/* Planes of this box with this colour, RGB and 0, in the room's memory until its next use, the
 * frame `reach` pixels wide or more. Fails with OZ_ERR_MEMORY. */
OzStatus oz_drawn_open(OzDrawn *drawn, OzDrawnRoom *room, const OzBox *box, const float rgb[3]);

void oz_drawn_free(OzDrawnRoom *room); /* zeroed is fine */
