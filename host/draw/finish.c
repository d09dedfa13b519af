/* First every pixel's own colour, in its place, then outlines, from the pixels beside them. Knows
 * no GL.
 */
#include "draw/finish.h"

#include "base/memory.h"
#include "draw/wide.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static inline float least(float a, float b)
{
    return a < b ? a : b;
}

static inline float most(float a, float b)
{
    return a > b ? a : b;
}

static inline float within_one(float a)
{
    return least(most(a, 0), 1);
}

/* By direction (right, left, up, down) and outline_code (lens.glsl): the share of a pixel that lies
 * outside its own outline there, and that of the next pixel which lies within. */
typedef struct Shares {
    float out[4][256], in[4][256];
} Shares;

static void find_shares(Shares *shares)
{
    memset(shares, 0, sizeof *shares);
    for (int code = 1; code < 255; code++) {
        int axis = code >= 128;
        float way = ((float)code - (axis ? 192.0f : 64.0f)) / 62.0f;
        int ahead = 2 * axis + (way < 0);
        shares->out[ahead][code] = most(0.5f - fabsf(way), 0);
        shares->in[ahead][code] = most(fabsf(way) - 0.5f, 0);
    }
}

/* Adds a half-size pixel's shadow, the more of it the nearer it lies to the pixel's own surface. */
static inline void weigh(float *sum, float *weights, float own, float depth, float shade,
                         float steepness)
{
    float apart = (depth - own) * steepness, weight = most(1 - apart * apart, 1e-4f);
    *sum += weight * shade;
    *weights += weight;
}

/* The shadow of a row's pixels from the half-size ones at and beside them. */
OZ_WIDE static void shade_row(float *restrict shade, const OzShadowRoom *half, const float *depth,
                              int y, float steepness)
{
    ptrdiff_t first = (ptrdiff_t)(y / 2) * half->stride, step = y % 2 * (ptrdiff_t)half->stride;
    const float *z = half->depth + first, *s = half->shade + first;
    for (int x = 0; x < half->width; x++) {
        float sum = 0, weights = 0, between = 0, between_weights = 0;
        for (int up = 0; up < 2; up++) {
            ptrdiff_t at = x + up * step;
            weigh(&sum, &weights, depth[2 * x], z[at], s[at], steepness);
            weigh(&between, &between_weights, depth[2 * x + 1], z[at], s[at], steepness);
            weigh(&between, &between_weights, depth[2 * x + 1], z[at + 1], s[at + 1], steepness);
        }
        shade[2 * x] = sum / weights;
        shade[2 * x + 1] = between / between_weights;
    }
}

/* Darkened by what stands before it, faded with depth. start: how far behind the middle depth 0
 * lies. */
OZ_WIDE static void colour_row(const OzFinish *finish, const float *restrict shade,
                               const float *restrict depth, float start, uint8_t *restrict rgba,
                               int width)
{
    float dark = finish->darkening, fade = finish->fade, by_depth = finish->by_depth, far[3];
    for (int k = 0; k < 3; k++) {
        far[k] = 255 * finish->background[k];
    }
    for (int x = 0; x < width; x++) {
        uint32_t old, word;
        memcpy(&old, rgba + 4 * x, sizeof old);
        float filled = depth[x] < 1 ? 1 : 0, light = 1 - dark * filled * shade[x];
        float mist = fade * filled * within_one(start + by_depth * depth[x]);
        word = old & (uint32_t)255 << OZ_WIDE_SHIFT(3);
        for (int k = 0; k < 3; k++) {
            float value = light * (float)(int)(old >> OZ_WIDE_SHIFT(k) & 255);
            value += mist * (far[k] - value);
            word |= (uint32_t)(int)(least(most(value, 0), 255) + 0.5f) << OZ_WIDE_SHIFT(k);
        }
        memcpy(rgba + 4 * x, &word, sizeof word);
    }
}

static inline uint32_t is_divided(const uint8_t *rgba)
{
    return (uint8_t)(rgba[3] + 1) > 1; /* a code, neither 0 nor 255 */
}

/* Pixels as they are, opaque, and which of them an outline may divide. */
OZ_WIDE static void copy_row(uint8_t *restrict to, uint8_t *restrict divided, const uint8_t *rgba,
                             ptrdiff_t stride, int width)
{
    for (int x = 0; x < width; x++) {
        const uint8_t *own = rgba + 4 * x;
        divided[x] = (uint8_t)(is_divided(own) | is_divided(own + 4) | is_divided(own - 4) |
                               is_divided(own + 4 * stride) | is_divided(own - 4 * stride));
    }
    for (int x = 0; x < width; x++) {
        uint32_t word;
        memcpy(&word, rgba + 4 * x, sizeof word);
        word |= (uint32_t)255 << OZ_WIDE_SHIFT(3);
        memcpy(to + 4 * x, &word, sizeof word);
    }
}

/* Each pixel with its part on the other side of its own outline, or within that of the pixels
 * beside it (after Persson, Geometric post-process anti-aliasing, 2011). */
static void divide_pixel(const Shares *shares, uint8_t *to, const uint8_t *own, ptrdiff_t stride)
{
    const ptrdiff_t away[4] = {4, -4, 4 * stride, -4 * stride};
    float colour[3] = {own[0], own[1], own[2]};
    for (int i = 0; i < 4; i++) {
        const uint8_t *other = own + away[i];
        float share = shares->out[i][own[3]] + shares->in[i ^ 1][other[3]];
        for (int k = 0; k < 3; k++) {
            colour[k] += share * (float)(other[k] - own[k]);
        }
    }
    for (int k = 0; k < 3; k++) {
        to[k] = (uint8_t)(int)(least(most(colour[k], 0), 255) + 0.5f);
    }
}

static OzStatus fit(OzFinishRoom *room, size_t width)
{
    if (width > room->width) {
        oz_finish_free(room);
        OZ_PASS(OZ_NEW(&room->shade, width));
        OZ_PASS(OZ_NEW(&room->divided, width));
        room->width = width;
    }
    return OZ_OK;
}

static void colour_pixels(const OzFinish *finish, OzFinishRoom *room, const OzDrawn *drawn,
                          int image_height)
{
    for (int y = 0; y < drawn->box.height; y++) {
        ptrdiff_t place = (ptrdiff_t)y * drawn->stride;
        int row = image_height - drawn->box.y - drawn->box.height + y;
        float start = finish->middle + finish->by_row * (float)row;
        shade_row(room->shade, &room->shadow, drawn->depth + place, y, finish->shadow.steepness);
        colour_row(finish, room->shade, drawn->depth + place, start, drawn->colour + 4 * place,
                   drawn->box.width);
    }
}

OzStatus oz_finish_pixels(const OzFinish *finish, OzFinishRoom *room, const OzDrawn *drawn,
                          OzImage *image)
{
    const OzBox *box = &drawn->box;
    Shares shares;
    OZ_PASS(fit(room, (size_t)box->width + 1));
    OZ_PASS(oz_shadow_find(&room->shadow, &finish->shadow, drawn));
    find_shares(&shares);
    colour_pixels(finish, room, drawn, image->height);
    for (int y = 0; y < box->height; y++) {
        const uint8_t *from = drawn->colour + 4 * (ptrdiff_t)y * drawn->stride;
        size_t top = (size_t)(box->y + box->height - 1 - y);
        uint8_t *to = image->pixels + 4 * (top * (size_t)image->width + (size_t)box->x);
        copy_row(to, room->divided, from, drawn->stride, box->width);
        for (int x = 0; x < box->width; x++) {
            if (room->divided[x]) {
                divide_pixel(&shares, to + 4 * x, from + 4 * x, drawn->stride);
            }
        }
    }
    return OZ_OK;
}

void oz_finish_free(OzFinishRoom *room)
{
    oz_shadow_free(&room->shadow);
    free(room->shade);
    free(room->divided);
    memset(room, 0, sizeof *room);
}
