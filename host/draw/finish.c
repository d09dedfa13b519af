/* Row by row; the loops over a row are simple, so that compilers make vectors of them. Knows no GL.
 */
#include "draw/finish.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* One row of the box. */
typedef struct Row {
    float *colour[3]; /* 0 to 255                             */
    float *depth;     /* of what fills the pixel; 0 where nothing */
    float *filled;    /* share of the pixel                      */
    float *shade;     /* how much stands before it, 0 to 1       */
} Row;

static float least(float a, float b)
{
    return a < b ? a : b;
}

static float most(float a, float b)
{
    return a > b ? a : b;
}

static float within_one(float a)
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

/* Sets what belongs to the pixel alone. */
static void take_pixel(const Row *row, int x, const uint8_t *rgba, float depth)
{
    row->filled[x] = depth < 1 ? 1 : 0;
    row->depth[x] = depth < 1 ? depth : 0;
    for (int k = 0; k < 3; k++) {
        row->colour[k][x] = rgba[k];
    }
}

/* A share of a neighbour instead. */
static void mix_in(const Row *row, int x, float share, const uint8_t *own, const uint8_t *rgba,
                   float depth)
{
    row->filled[x] += share * ((depth < 1 ? 1.0f : 0.0f) - row->filled[x]);
    row->depth[x] += depth < 1 ? share * (depth - row->depth[x]) : 0;
    for (int k = 0; k < 3; k++) {
        row->colour[k][x] += share * ((float)rgba[k] - (float)own[k]);
    }
}

/* Each pixel with its part on the other side of its own outline, or within that of the pixels
 * beside it (after Persson, Geometric post-process anti-aliasing, 2011). */
static void smooth_row(const Shares *shares, const Row *row, const OzDrawn *drawn, int y)
{
    const uint8_t *rgba = drawn->colour + 4 * (ptrdiff_t)y * drawn->stride;
    const float *depth = drawn->depth + (ptrdiff_t)y * drawn->stride;
    const ptrdiff_t away[4] = {1, -1, drawn->stride, -drawn->stride};
    for (int x = 0; x < drawn->box.width; x++, rgba += 4, depth++) {
        float share[4], sum = 0;
        for (int i = 0; i < 4; i++) {
            share[i] = shares->out[i][rgba[3]] + shares->in[i ^ 1][rgba[4 * away[i] + 3]];
            sum += share[i];
        }
        take_pixel(row, x, rgba, *depth);
        for (int i = 0; i < 4 && sum > 0; i++) {
            if (share[i] > 0) {
                mix_in(row, x, share[i], rgba, rgba + 4 * away[i], depth[away[i]]);
            }
        }
    }
}

/* How much stands in front nearby (Luft, Colditz & Deussen 2006: a depth buffer against its own
 * surroundings). Opposite neighbours are taken together, so that neither a slanting nor a bulging
 * surface darkens itself; a pair that reaches past everything into the background says nothing. */
static void shade_row(const OzFinish *finish, const Row *row, const OzDrawn *drawn, int y)
{
    const float *own = row->depth;
    float *shade = row->shade;
    memset(shade, 0, sizeof *shade * (size_t)drawn->box.width);
    for (int i = 0; i < finish->pairs && finish->darkening > 0; i++) {
        ptrdiff_t away = finish->taps[i][0] + (ptrdiff_t)finish->taps[i][1] * drawn->stride;
        const float *middle = drawn->depth + (ptrdiff_t)y * drawn->stride;
        const float *ones = middle + away, *others = middle - away;
        for (int x = 0; x < drawn->box.width; x++) {
            float one = ones[x], other = others[x];
            float nearer = within_one((2 * own[x] - one - other) * finish->steepness);
            shade[x] += most(one, other) < 1 ? nearer : 0;
        }
    }
}

static void paint_row(const OzFinish *finish, const Row *row, const OzDrawn *drawn, int y,
                      OzImage *image)
{
    int top = drawn->box.y + drawn->box.height - 1 - y;
    uint8_t *rgba = image->pixels + 4 * ((size_t)top * (size_t)image->width + (size_t)drawn->box.x);
    float start = finish->middle + finish->by_row * (float)(image->height - 1 - top);
    float dark = finish->darkening / (float)(finish->pairs > 0 ? finish->pairs : 1);
    float *light = row->shade, *mist = row->filled;
    for (int x = 0; x < drawn->box.width; x++) {
        float behind = within_one(start + finish->by_depth * row->depth[x]);
        light[x] = 1 - dark * row->filled[x] * row->shade[x];
        mist[x] = finish->fade * row->filled[x] * behind;
    }
    for (int k = 0; k < 3; k++) {
        const float *colour = row->colour[k];
        float far = 255 * finish->background[k];
        for (int x = 0; x < drawn->box.width; x++) {
            float value = light[x] * colour[x];
            value += mist[x] * (far - value);
            rgba[4 * x + k] = (uint8_t)(int)(least(most(value, 0), 255) + 0.5f);
        }
    }
}

OzStatus oz_finish_pixels(const OzFinish *finish, const OzDrawn *drawn, OzImage *image)
{
    size_t width = (size_t)drawn->box.width;
    float *room = NULL;
    OZ_PASS(OZ_NEW(&room, 6 * width));
    Row row = {{room, room + width, room + 2 * width},
               room + 3 * width,
               room + 4 * width,
               room + 5 * width};
    Shares shares;
    find_shares(&shares);
    for (int y = 0; y < drawn->box.height; y++) {
        smooth_row(&shares, &row, drawn, y);
        shade_row(finish, &row, drawn, y);
        paint_row(finish, &row, drawn, y, image);
    }
    free(room);
    return OZ_OK;
}
