/* Colours as movies store them: full-range RGB to limited-range bt709, chroma at half the size, at
 * the left of each two pixels and between each two rows. */
#pragma once

#include "draw/image.h"

/* Sums of two rows' colours on the way: so many numbers for an image of this width. */
#define OZ_YUV_ROOM(width) (3 * ((size_t)(width) + 1))

/* An image of even size into planes Y, Cb and Cr whose rows lie strides bytes apart. */
void oz_yuv_convert(const OzImage *image, int32_t *room, uint8_t *const planes[3],
                    const int strides[3]);
