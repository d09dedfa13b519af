/* How much stands before each pixel nearby, from depths at half the size, smoothed along surfaces:
 * shadows are soft, and cost a part of what they would at full size. */
#pragma once

#include "draw/drawn.h"

enum {
    OZ_SHADOW_PAIRS = 12, /* of neighbours: with fewer their single copies of an edge are seen */
    OZ_SHADOW_BORDER = 2  /* half-size pixels about the shadow that are 0 */
};

/* How; the same for a whole picture. */
typedef struct OzShadow {
    int taps[OZ_SHADOW_PAIRS][2]; /* half-size pixels; the other of a pair lies opposite          */
    int reach;                    /* half-size pixels: the furthest tap along an axis             */
    float steepness;              /* 1/depth at which a pair darkens fully                        */
} OzShadow;

/* Memory, kept from picture to picture. */
typedef struct OzShadowRoom {
    float *memory;
    size_t capacity;              /* numbers of each of these planes, which have frames */
    float *depth, *shade, *other; /* half-size pixels: 1 in the frame; 0 to 1, 0 in the frame */
    int width, height, stride;    /* half-size; stride of all three */
} OzShadowRoom;

/* radius: of a typical grain, pixels; deep: the same, depth. */
OzShadow oz_shadow_make(double radius, double deep);

/* room->shade at y * stride + x, and room->depth, receive what belongs to the pixel 2 x, 2 y. Fails
 * with OZ_ERR_MEMORY. */
OzStatus oz_shadow_find(OzShadowRoom *room, const OzShadow *shadow, const OzDrawn *drawn);

void oz_shadow_free(OzShadowRoom *room); /* zeroed is fine */
