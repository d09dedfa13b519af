/* Shadows at half the size. Loops over a row are simple, so that compilers make vectors of them. */
#include "draw/shadow.h"

#include "base/memory.h"
#include "draw/wide.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double PI = 3.14159265358979323846;

static inline float least(float a, float b)
{
    return a < b ? a : b;
}

static inline float most(float a, float b)
{
    return a > b ? a : b;
}

/* On a spiral, closer together inwards, so that the shadow fades out; no two in a line. */
OzShadow oz_shadow_make(double radius, double deep)
{
    const double golden = 0.6180339887; /* of half a turn */
    OzShadow shadow = {.reach = OZ_SHADOW_BORDER, .steepness = (float)(1 / (1.5 * deep))};
    double half = fmax(0.5 * radius, 1);
    for (int i = 0; i < OZ_SHADOW_PAIRS; i++) {
        double ring = half * (0.2 + (i + 0.5) / OZ_SHADOW_PAIRS), angle = PI * i * golden;
        shadow.taps[i][0] = (int)lround(ring * cos(angle));
        shadow.taps[i][1] = (int)lround(ring * sin(angle));
        for (int k = 0; k < 2; k++) {
            int away = abs(shadow.taps[i][k]);
            shadow.reach = away > shadow.reach ? away : shadow.reach;
        }
    }
    return shadow;
}

void oz_shadow_free(OzShadowRoom *room)
{
    free(room->memory);
    memset(room, 0, sizeof *room);
}

/* Three planes with frames. */
static OzStatus fit(OzShadowRoom *room, const OzBox *box, int reach)
{
    room->width = (box->width + 1) / 2;
    room->height = (box->height + 1) / 2;
    room->stride = room->width + 2 * reach + 1;
    size_t count = (size_t)room->stride * (size_t)(room->height + 2 * reach + 1);
    if (count > room->capacity) {
        free(room->memory);
        room->capacity = 0;
        OZ_PASS(OZ_NEW(&room->memory, 3 * count));
        room->capacity = count;
    }
    size_t inset = (size_t)reach * (size_t)(room->stride + 1);
    room->depth = room->memory + inset;
    room->shade = room->memory + count + inset;
    room->other = room->memory + 2 * count + inset;
    for (size_t i = 0; i < count; i++) {
        room->memory[i] = 1;
    }
    memset(room->memory + count, 0, 2 * count * sizeof *room->memory);
    return OZ_OK;
}

OZ_WIDE static void halve(const OzShadowRoom *room, const OzDrawn *drawn)
{
    for (int y = 0; y < room->height; y++) {
        const float *from = drawn->depth + (ptrdiff_t)2 * y * drawn->stride;
        float *to = room->depth + (ptrdiff_t)y * room->stride;
        for (int x = 0; x < room->width; x++) {
            to[x] = from[2 * x];
        }
    }
}

/* What stands in front nearby (Luft, Colditz & Deussen 2006: a depth buffer against its own
 * surroundings). Opposite neighbours are taken together, so that neither a slanting nor a bulging
 * surface darkens itself; a pair that reaches past everything into the background says nothing. */
OZ_WIDE static void compare_pairs(const OzShadowRoom *room, const OzShadow *shadow)
{
    float twice = 2 * shadow->steepness, once = shadow->steepness;
    for (int y = 0; y < room->height; y++) {
        const float *own = room->depth + (ptrdiff_t)y * room->stride;
        float *restrict shade = room->shade + (ptrdiff_t)y * room->stride;
        for (int i = 0; i < OZ_SHADOW_PAIRS; i++) {
            ptrdiff_t away = shadow->taps[i][0] + (ptrdiff_t)shadow->taps[i][1] * room->stride;
            const float *ones = own + away, *others = own - away;
            for (int x = 0; x < room->width; x++) {
                float one = ones[x], other = others[x];
                float nearer = least(most(own[x] * twice - (one + other) * once, 0), 1);
                shade[x] += most(one, other) < 1 ? nearer * (1.0f / OZ_SHADOW_PAIRS) : 0;
            }
        }
    }
}

/* The mean of five pixels in a line, of those that lie on the same surface. */
OZ_WIDE static void smooth(const OzShadowRoom *room, const OzShadow *shadow,
                           const float *restrict from, float *restrict to, ptrdiff_t step)
{
    for (int y = 0; y < room->height; y++) {
        const float *depth = room->depth + (ptrdiff_t)y * room->stride;
        const float *shade = from + (ptrdiff_t)y * room->stride;
        float *mean = to + (ptrdiff_t)y * room->stride;
        for (int x = 0; x < room->width; x++) {
            float sum = shade[x], weights = 1;
            for (int k = -2; k <= 2; k++) {
                float apart = (depth[x + k * step] - depth[x]) * shadow->steepness;
                float weight = k == 0 ? 0 : most(1 - apart * apart, 0);
                sum += weight * shade[x + k * step];
                weights += weight;
            }
            mean[x] = sum / weights;
        }
    }
}

OzStatus oz_shadow_find(OzShadowRoom *room, const OzShadow *shadow, const OzDrawn *drawn)
{
    OZ_PASS(fit(room, &drawn->box, shadow->reach));
    halve(room, drawn);
    compare_pairs(room, shadow);
    smooth(room, shadow, room->shade, room->other, 1);
    smooth(room, shadow, room->other, room->shade, room->stride);
    return OZ_OK;
}
