/* Casting rays in blocks. Loops over a block have no branches, so that compilers make vectors of
 * them; each is short, so that its numbers stay in registers or the nearest cache. */
#include "draw/raster_row.h"

#include "draw/drawn.h"
#include "draw/wide.h"

#include <math.h>
#include <string.h>

enum { BLOCK = OZ_DRAWN_BLOCK };

static const float LIGHT[3] = {-0.41f, 0.58f, 0.70f};
static const float HALFWAY[3] = {-0.225f, 0.318f, 0.921f}; /* between the light and the eye */

/* A block's rays q + t d, d = (x, y, -1), q in the plane of the body's centre and relative to it.
 */
typedef struct Rays {
    float qx[BLOCK], qy[BLOCK], dx[BLOCK], dy;
    float gap; /* of the eye from that plane */
} Rays;

/* Where they meet the body; beside it, where they come closest. */
typedef struct Meeting {
    float t[BLOCK], spine[BLOCK]; /* spine: the nearest point's place on the axis */
    float thickness[BLOCK];       /* square of half the way within it; not positive beside it */
    float middle[BLOCK];          /* t where the ray comes closest to the axis */
    float beside[BLOCK];          /* the axis's place there */
} Meeting;

/* By pixel: the surface's depth and colour, and the way to the nearest outline, pixels. */
typedef struct Surface {
    float depth[BLOCK], rgb[3][BLOCK];
    float way_x[BLOCK], way_y[BLOCK]; /* one of them is 0 */
    int seen[BLOCK];
} Surface;

static inline float least(float a, float b)
{
    return a < b ? a : b;
}

static inline float most(float a, float b)
{
    return a > b ? a : b;
}

static inline float within(float a, float low, float high)
{
    return least(most(a, low), high);
}

static inline void cast(Rays *rays, const OzRasterLens *lens, const OzRasterBody *body,
                        const OzRasterRow *row, int x)
{
    const float *along = lens->along + x;
    rays->gap = lens->distance - body->centre[2];
    rays->dy = row->up;
    for (int i = 0; i < BLOCK; i++) {
        rays->dx[i] = along[i];
        rays->qx[i] = along[i] * rays->gap - body->centre[0];
        rays->qy[i] = row->up * rays->gap - body->centre[1];
    }
}

/* which: -1 entering, 1 leaving. The infinite cylinder is met first; if that is beyond an end, the
 * sphere there decides. */
static inline void meet(Meeting *m, const Rays *rays, const OzRasterBody *body, float which)
{
    float ux = body->axis[0], uy = body->axis[1], uz = body->axis[2];
    float h = body->half_shaft, square = body->radius * body->radius, dy = rays->dy;
    for (int i = 0; i < BLOCK; i++) {
        float qx = rays->qx[i], qy = rays->qy[i], dx = rays->dx[i];
        float uq = ux * qx + uy * qy, ud = ux * dx + uy * dy - uz;
        float qd = qx * dx + qy * dy, qq = qx * qx + qy * qy, dd = dx * dx + dy * dy + 1;
        float across = most(dd - ud * ud, 1e-9f), inverse = 1 / across;
        float b = (qd - uq * ud) * inverse, chord = b * b - (qq - uq * uq - square) * inverse;
        float t = which * sqrtf(most(chord, 0)) - b;
        float y = uq + t * ud, spine = within(y, -h, h), inverse_dd = 1 / dd;
        float b_end = (qd - spine * ud) * inverse_dd;
        float thick = dd * b_end * b_end - (qq - 2 * spine * uq + spine * spine - square);
        float t_end = which * sqrtf(most(thick * inverse_dd, 0)) - b_end;
        m->spine[i] = spine;
        m->t[i] = y == spine ? t : t_end;
        m->thickness[i] = y == spine ? chord * across : thick;
        m->middle[i] = y == spine ? -b : -b_end;
        m->beside[i] = y == spine ? uq - b * ud : spine;
    }
}

/* The way along the row or the column, whichever is shorter, to where a value that is negative
 * within and has these slopes becomes zero. */
static inline void set_way(Surface *s, int i, float value, float slope_x, float slope_y)
{
    int is_x = fabsf(slope_x) > fabsf(slope_y);
    float slope = is_x ? slope_x : slope_y;
    slope = fabsf(slope) < 1e-20f ? 1e-20f : slope;
    float way = -value / slope;
    s->way_x[i] = is_x ? way : 0;
    s->way_y[i] = is_x ? 0 : way;
}

/* Where the silhouette runs: how far the ray passes beside the surface grows with the pixel's move
 * across the axis. */
static inline void find_outline(Surface *s, const OzRasterLens *lens, const Rays *rays,
                                const Meeting *m, const OzRasterBody *body)
{
    float r = body->radius, pixel = lens->pixel / lens->distance;
    for (int i = 0; i < BLOCK; i++) {
        float wx = rays->qx[i] + m->middle[i] * rays->dx[i] - m->beside[i] * body->axis[0];
        float wy = rays->qy[i] + m->middle[i] * rays->dy - m->beside[i] * body->axis[1];
        float reach = most(sqrtf(most(r * r - m->thickness[i], 0)), 1e-3f * r);
        float scale = pixel * (rays->gap + m->middle[i]);
        set_way(s, i, (reach - r) * reach, wx * scale, wy * scale);
    }
}

/* Soft light from the upper left, a sky from above, edges darkened so that each rod stands out. */
static inline void shade(Surface *s, const Rays *rays, const Meeting *m, const OzRasterBody *body)
{
    float inverse = 1 / body->radius, base[3];
    for (int k = 0; k < 3; k++) {
        base[k] = body->rgb[k] + 0.05f * (1 - body->rgb[k]);
    }
    for (int i = 0; i < BLOCK; i++) {
        float t = m->t[i], spine = m->spine[i], dx = rays->dx[i], dy = rays->dy;
        float nx = (rays->qx[i] + t * dx - spine * body->axis[0]) * inverse;
        float ny = (rays->qy[i] + t * dy - spine * body->axis[1]) * inverse;
        float nz = (-t - spine * body->axis[2]) * inverse;
        float facing = within(nz - nx * dx - ny * dy, 0, 1);
        float lit = most(nx * LIGHT[0] + ny * LIGHT[1] + nz * LIGHT[2], 0);
        float light = 0.58f + 0.42f * lit + 0.10f * ny;
        float shine = most(nx * HALFWAY[0] + ny * HALFWAY[1] + nz * HALFWAY[2], 0);
        shine *= shine;
        shine *= shine;
        shine *= shine;
        shine *= shine;
        light *= 0.42f + (1.10f - 0.42f) * facing * (2 - facing);
        float gloss = 0.22f * shine * shine;
        for (int k = 0; k < 3; k++) {
            s->rgb[k][i] = base[k] * light + gloss;
        }
    }
}

/* outline_code of lens.glsl, as a byte. */
static inline uint32_t code_of(float way_x, float way_y)
{
    float code = way_x != 0 ? 64.0f + 62.0f * way_x : 192.0f + 62.0f * way_y;
    int is_near = most(fabsf(way_x), fabsf(way_y)) < 1;
    return (uint32_t)(int)((is_near ? code : 255.0f) + 0.5f);
}

static inline uint32_t byte_of(float value)
{
    return (uint32_t)(int)(255 * within(value, 0, 1) + 0.5f);
}

static inline uint32_t pack(uint32_t red, uint32_t green, uint32_t blue, uint32_t code)
{
    return red << OZ_WIDE_SHIFT(0) | green << OZ_WIDE_SHIFT(1) | blue << OZ_WIDE_SHIFT(2) |
           code << OZ_WIDE_SHIFT(3);
}

static inline void store(const Surface *s, const OzRasterRow *row, int x)
{
    float *depth = row->depth + x;
    uint8_t *place = row->colour + 4 * (ptrdiff_t)x;
    uint32_t colour[BLOCK];
    memcpy(colour, place, sizeof colour);
    for (int i = 0; i < BLOCK; i++) {
        uint32_t rgba = pack(byte_of(s->rgb[0][i]), byte_of(s->rgb[1][i]), byte_of(s->rgb[2][i]),
                             code_of(s->way_x[i], s->way_y[i]));
        colour[i] = s->seen[i] ? rgba : colour[i];
        depth[i] = s->seen[i] ? s->depth[i] : depth[i];
    }
    memcpy(place, colour, sizeof colour);
}

/* Depth is linear in z, so that differences of depth are lengths. Returns whether any is seen. */
static inline int see(Surface *s, const float *t, const float *thickness, const OzRasterLens *lens,
                      const OzRasterBody *body, const float *depth)
{
    float scale = 0.5f / lens->depth;
    int any = 0;
    for (int i = 0; i < BLOCK; i++) {
        s->depth[i] = within(0.5f - (body->centre[2] - t[i]) * scale, 0, 1);
        s->seen[i] = (thickness[i] > 0) & (s->depth[i] < depth[i]);
        any |= s->seen[i];
    }
    return any;
}

OZ_WIDE int oz_raster_row_whole(const OzRasterLens *lens, const OzRasterBody *body,
                                const OzRasterRow *row)
{
    Rays rays;
    Meeting m;
    Surface s;
    int any = 0;
    for (int x = row->first; x < row->end; x += BLOCK) {
        cast(&rays, lens, body, row, x);
        meet(&m, &rays, body, -1);
        if (see(&s, m.t, m.thickness, lens, body, row->depth + x)) {
            find_outline(&s, lens, &rays, &m, body);
            shade(&s, &rays, &m, body);
            store(&s, row, x);
            any = 1;
        }
    }
    return any;
}

/* Flat, with a dark outline a seventh of the radius wide, at least a pixel. A point of the section
 * lies from its outline, within the plane, as far as from the surface over the slope there. */
static inline void shade_section(Surface *s, const Rays *rays, const float *t, const int *section,
                                 const OzRasterLens *lens, const OzRasterBody *body)
{
    const float *u = body->axis, *n = lens->plane;
    float width = most(0.14f * body->radius, lens->pixel), per_pixel = 1 / lens->pixel;
    for (int i = 0; i < BLOCK; i++) {
        float px = rays->qx[i] + t[i] * rays->dx[i], py = rays->qy[i] + t[i] * rays->dy;
        float spine =
            within(px * u[0] + py * u[1] - t[i] * u[2], -body->half_shaft, body->half_shaft);
        float ax = px - spine * u[0], ay = py - spine * u[1], az = -t[i] - spine * u[2];
        float reach = most(sqrtf(ax * ax + ay * ay + az * az), 1e-9f);
        float lean = (ax * n[0] + ay * n[1] + az * n[2]) / reach;
        float inside = (body->radius - reach) / sqrtf(most(1 - lean * lean, 1e-6f));
        float fill = within((inside - width) * per_pixel + 0.5f, 0, 1);
        for (int k = 0; k < 3; k++) {
            float rim = 0.40f * body->rgb[k], face = body->rgb[k] + 0.08f * (1 - body->rgb[k]);
            s->rgb[k][i] = section[i] ? rim + fill * (face - rim) : s->rgb[k][i];
        }
    }
}

/* Convex: the kept half is hit exactly where the ray leaves the body behind the plane. Takes what
 * is before the plane out of the meeting; left: how far behind the plane the ray leaves. */
static inline void cut(float *left, float *t, int *section, Meeting *first, const Meeting *last,
                       const Rays *rays, const OzRasterLens *lens, const OzRasterBody *body)
{
    const float *n = lens->plane, *c = body->centre;
    float base = n[0] * c[0] + n[1] * c[1] + n[2] * c[2] - lens->offset;
    for (int i = 0; i < BLOCK; i++) {
        float start = base + n[0] * rays->qx[i] + n[1] * rays->qy[i];
        float rise = n[0] * rays->dx[i] + n[1] * rays->dy - n[2];
        left[i] = start + last->t[i] * rise;
        section[i] = start + first->t[i] * rise < 0;
        t[i] = section[i] ? -start / rise : first->t[i];
        first->thickness[i] = left[i] > 0 ? first->thickness[i] : -1;
    }
}

/* Where the plane cuts the surface at which rays leave: the nearer of the two outlines. */
static inline void find_cut_outline(Surface *s, const float *left, const Meeting *last,
                                    const Rays *rays, const OzRasterLens *lens,
                                    const OzRasterBody *body)
{
    const float *u = body->axis, *n = lens->plane;
    float pixel = lens->pixel / lens->distance;
    for (int i = 0; i < BLOCK; i++) {
        float t = last->t[i], spine = last->spine[i], dx = rays->dx[i], dy = rays->dy;
        float mx = rays->qx[i] + t * dx - spine * u[0], my = rays->qy[i] + t * dy - spine * u[1];
        float mz = -t - spine * u[2];
        float along = most(mx * dx + my * dy - mz, 1e-6f * body->radius);
        float rise = (n[0] * dx + n[1] * dy - n[2]) / along, scale = pixel * (rays->gap + t);
        float way_x = s->way_x[i], way_y = s->way_y[i], old = fabsf(way_x) + fabsf(way_y);
        set_way(s, i, -left[i], -scale * (n[0] - mx * rise), -scale * (n[1] - my * rise));
        int is_nearer = fabsf(s->way_x[i]) + fabsf(s->way_y[i]) < old;
        s->way_x[i] = is_nearer ? s->way_x[i] : way_x;
        s->way_y[i] = is_nearer ? s->way_y[i] : way_y;
    }
}

OZ_WIDE int oz_raster_row_sliced(const OzRasterLens *lens, const OzRasterBody *body,
                                 const OzRasterRow *row)
{
    Rays rays;
    Meeting first, last;
    Surface s;
    float left[BLOCK], t[BLOCK];
    int section[BLOCK], any = 0;
    for (int x = row->first; x < row->end; x += BLOCK) {
        cast(&rays, lens, body, row, x);
        meet(&first, &rays, body, -1);
        meet(&last, &rays, body, 1);
        cut(left, t, section, &first, &last, &rays, lens, body);
        if (see(&s, t, first.thickness, lens, body, row->depth + x)) {
            find_outline(&s, lens, &rays, &first, body);
            find_cut_outline(&s, left, &last, &rays, lens, body);
            shade(&s, &rays, &first, body);
            shade_section(&s, &rays, t, section, lens, body);
            store(&s, row, x);
            any = 1;
        }
    }
    return any;
}

OZ_WIDE void oz_raster_row_outlined(const OzRasterLens *lens, const OzRasterBody *body,
                                    const OzRasterRow *row)
{
    float r = body->radius, per_pixel = 1 / lens->pixel, width = most(0.11f * r * per_pixel, 1.5f);
    Rays rays;
    Meeting m;
    for (int x = row->first; x < row->end; x += BLOCK) {
        uint8_t *rgba = row->colour + 4 * (ptrdiff_t)x;
        float alpha[BLOCK];
        cast(&rays, lens, body, row, x);
        meet(&m, &rays, body, -1);
        for (int i = 0; i < BLOCK; i++) {
            float inside = (r - sqrtf(most(r * r - m.thickness[i], 0))) * per_pixel;
            alpha[i] = 0.55f * within(inside + 0.5f, 0, 1) * within(width - inside + 0.5f, 0, 1);
        }
        for (int i = 0; i < BLOCK; i++) {
            for (int k = 0; k < 3; k++) {
                float old = rgba[4 * i + k], new = 255 * 0.6f * body->rgb[k];
                rgba[4 * i + k] = (uint8_t)(int)(old + alpha[i] * (new - old) + 0.5f);
            }
        }
    }
}
