/* Two rows of pixels at a time, in whole numbers, so that the same picture is the same bytes
 * anywhere.
 */
#include "draw/yuv.h"

#include "draw/wide.h"

#include <stddef.h>

/* Rec. ITU-R BT.709: luma 0.2126 R + 0.7152 G + 0.0722 B over 219 levels from 16 on, (B - luma)
 * / 1.8556 and (R - luma) / 1.5748 over 224 levels about 128; times 2^15. */
enum { BITS = 15 };
static const int32_t weights[3][3] = {
    {5983, 20127, 2032}, {-3298, -11094, 14392}, {14392, -13073, -1320}};

/* Limits need no check: weights of either sign add up to no more than their levels. */
OZ_WIDE static void luma_row(const uint8_t *restrict rgba, uint8_t *restrict luma, int width)
{
    const int32_t *w = weights[0];
    for (int x = 0; x < width; x++) {
        int32_t sum = w[0] * rgba[4 * x] + w[1] * rgba[4 * x + 1] + w[2] * rgba[4 * x + 2];
        luma[x] = (uint8_t)((sum + (16 << BITS) + (1 << (BITS - 1))) >> BITS);
    }
}

/* sums[0] is beside the first pixel, and like it. */
OZ_WIDE static void add_rows(const uint8_t *restrict one, const uint8_t *restrict other,
                             int32_t *restrict sums, int width)
{
    for (int x = 0; x < width; x++) {
        sums[x + 1] = one[4 * x] + other[4 * x];
    }
    sums[0] = sums[1];
}

/* Of three columns, the middle one twice, and two rows: eight pixels. */
OZ_WIDE static void chroma_row(const int32_t *restrict sums, uint8_t *restrict chroma,
                               const int32_t w[3], int width)
{
    const int bits = BITS + 3;
    const int32_t *red = sums, *green = red + width + 1, *blue = green + width + 1;
    for (int i = 0; i < width / 2; i++) {
        int x = 2 * i;
        int32_t sum = w[0] * (red[x] + 2 * red[x + 1] + red[x + 2]) +
                      w[1] * (green[x] + 2 * green[x + 1] + green[x + 2]) +
                      w[2] * (blue[x] + 2 * blue[x + 1] + blue[x + 2]);
        chroma[i] = (uint8_t)((sum + (128 << bits) + (1 << (bits - 1))) >> bits);
    }
}

void oz_yuv_convert(const OzImage *image, int32_t *room, uint8_t *const planes[3],
                    const int strides[3])
{
    int width = image->width;
    ptrdiff_t row_bytes = 4 * (ptrdiff_t)width;
    for (int y = 0; y < image->height; y += 2) {
        const uint8_t *one = image->pixels + y * row_bytes, *other = one + row_bytes;
        luma_row(one, planes[0] + (ptrdiff_t)y * strides[0], width);
        luma_row(other, planes[0] + (ptrdiff_t)(y + 1) * strides[0], width);
        for (int k = 0; k < 3; k++) {
            add_rows(one + k, other + k, room + k * (width + 1), width);
        }
        for (int k = 1; k < 3; k++) {
            chroma_row(room, planes[k] + (ptrdiff_t)(y / 2) * strides[k], weights[k], width);
        }
    }
}
