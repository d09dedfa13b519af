/* Triangles between their edges, with numbers that are linear over the picture. Knows no grains. */
#include "draw/mesh_rows.h"

#include "draw/wide.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

/* Over the picture linear: 1/w, and colour, alpha and the place across a line over w, w the way
 * from the eye along its axis. */
enum { BLOCK = OZ_DRAWN_BLOCK, INVERSE = 0, RED, ALPHA = RED + 3, ACROSS, HALF, VALUES };

typedef struct Corner {
    double x, y; /* pixels of the planes */
    double value[VALUES];
} Corner;

/* value = at + x * by_x + y * by_y */
typedef struct Triangle {
    Corner corners[3];
    float at[VALUES], by_x[VALUES], by_y[VALUES];
    float distance, depth; /* of the eye; half the depth range */
    OzMeshUse use;
} Triangle;

/* The pixels of a row whose middles lie within. */
typedef struct Span {
    int first, end;
} Span;

static void set_corner(Corner *corner, const OzCorner *from, const OzDrawn *drawn,
                       const OzCamera *camera, const OzLook *look, int panel)
{
    const OzPanel *p = &camera->panels[panel];
    double w = fmax(camera->distance - (double)from->place[2], 1e-3);
    double scale = camera->scale * camera->distance / w;
    double low = look->height - drawn->box.y - drawn->box.height;
    corner->x = scale * (double)from->place[0] + (double)lround(p->middle_x) - drawn->box.x;
    corner->y = scale * (double)from->place[1] + look->height - (double)lround(p->middle_y) - low;
    corner->value[INVERSE] = 1 / w;
    for (int k = 0; k < 4; k++) {
        corner->value[RED + k] = (double)from->rgba[k] / w;
    }
    corner->value[ACROSS] = (double)from->across[0] / w;
    corner->value[HALF] = (double)from->across[1] / w;
}

static bool find_slopes(Triangle *t)
{
    const Corner *c = t->corners;
    double x[2], y[2];
    for (int i = 0; i < 2; i++) {
        x[i] = c[i + 1].x - c[0].x;
        y[i] = c[i + 1].y - c[0].y;
    }
    double area = x[0] * y[1] - x[1] * y[0];
    if (!(fabs(area) > 1e-12)) {
        return false;
    }
    for (int v = 0; v < VALUES; v++) {
        double one = c[1].value[v] - c[0].value[v], other = c[2].value[v] - c[0].value[v];
        double by_x = (one * y[1] - other * y[0]) / area;
        double by_y = (other * x[0] - one * x[1]) / area;
        t->at[v] = (float)(c[0].value[v] + by_x * (0.5 - c[0].x) + by_y * (0.5 - c[0].y));
        t->by_x[v] = (float)by_x;
        t->by_y[v] = (float)by_y;
    }
    return true;
}

/* An edge's place in a row depends on its two corners alone, so that both its triangles agree. */
static double crossing(const Corner *a, const Corner *b, double y)
{
    const Corner *low = a->y < b->y ? a : b, *high = a->y < b->y ? b : a;
    return low->x + (y - low->y) * (high->x - low->x) / (high->y - low->y);
}

static int pixel_from(double x, int count)
{
    return (int)ceil(fmax(fmin(x, count + 0.5), 0.5) - 0.5);
}

static Span span_of(const Triangle *t, int row, int columns)
{
    double y = row + 0.5, low = 1e30, high = -1e30;
    for (int e = 0; e < 3; e++) {
        const Corner *a = &t->corners[e], *b = &t->corners[(e + 1) % 3];
        if ((a->y <= y) != (b->y <= y)) {
            double x = crossing(a, b, y);
            low = fmin(low, x);
            high = fmax(high, x);
        }
    }
    return low <= high ? (Span){pixel_from(low, columns), pixel_from(high, columns)} : (Span){0, 0};
}

static inline float within_one(float a)
{
    return a < 0 ? 0 : a > 1 ? 1 : a;
}

static inline uint32_t blend(uint32_t word, int k, float new, float share)
{
    float old = (float)(int)(word >> OZ_WIDE_SHIFT(k) & 255);
    return (uint32_t)(int)(old + share * (new - old) + 0.5f) << OZ_WIDE_SHIFT(k);
}

/* start: every number at x = 0. Blocks reach beyond the span, where they change nothing. */
OZ_WIDE static void paint_over(const Triangle *t, const float *start, const Span *span,
                               uint8_t *rgba)
{
    float fourth = t->use == OZ_MESH_LAYER ? 1 : 0;
    for (int first = span->first; first < span->end; first += BLOCK) {
        uint32_t words[BLOCK];
        memcpy(words, rgba + 4 * (ptrdiff_t)first, sizeof words);
        for (int i = 0; i < BLOCK; i++) {
            float value[VALUES], at = (float)(first + i);
            for (int v = 0; v < VALUES; v++) {
                value[v] = start[v] + at * t->by_x[v];
            }
            float w = 1 / value[INVERSE], across = fabsf(value[ACROSS] * w);
            float alpha =
                within_one(value[ALPHA] * w) * within_one(value[HALF] * w + 0.5f - across);
            alpha = first + i < span->end ? alpha : 0;
            uint32_t mixed = blend(words[i], 3, 255, alpha * fourth);
            for (int k = 0; k < 3; k++) {
                mixed |= blend(words[i], k, 255 * within_one(value[RED + k] * w), alpha);
            }
            words[i] = mixed;
        }
        memcpy(rgba + 4 * (ptrdiff_t)first, words, sizeof words);
    }
}

static void paint_solid(const Triangle *t, const float *start, const Span *span, uint8_t *rgba,
                        float *depth)
{
    for (int x = span->first; x < span->end; x++) {
        float at = (float)x, w = 1 / (start[INVERSE] + at * t->by_x[INVERSE]);
        float z = within_one(0.5f - 0.5f * (t->distance - w) / t->depth);
        if (z < depth[x]) {
            depth[x] = z;
            for (int k = 0; k < 3; k++) {
                float new = 255 * within_one((start[RED + k] + at * t->by_x[RED + k]) * w);
                rgba[4 * x + k] = (uint8_t)(int)(new + 0.5f);
            }
            rgba[4 * x + 3] = 255;
        }
    }
}

static void paint(const Triangle *t, const OzDrawn *drawn)
{
    double low = fmin(fmin(t->corners[0].y, t->corners[1].y), t->corners[2].y);
    double high = fmax(fmax(t->corners[0].y, t->corners[1].y), t->corners[2].y);
    int end = pixel_from(high, drawn->box.height);
    for (int row = pixel_from(low, drawn->box.height); row < end; row++) {
        Span span = span_of(t, row, drawn->box.width);
        ptrdiff_t place = (ptrdiff_t)row * drawn->stride;
        float start[VALUES];
        for (int v = 0; v < VALUES; v++) {
            start[v] = t->at[v] + (float)row * t->by_y[v];
        }
        if (t->use == OZ_MESH_SOLID) {
            paint_solid(t, start, &span, drawn->colour + 4 * place, drawn->depth + place);
        } else {
            paint_over(t, start, &span, drawn->colour + 4 * place);
        }
    }
}

void oz_mesh_rows_paint(const OzDrawn *drawn, const OzMesh *mesh, const OzCamera *camera,
                        const OzLook *look, int panel, OzMeshUse use)
{
    Triangle t = {.distance = (float)camera->distance, .depth = (float)camera->depth, .use = use};
    for (size_t i = 0; i + 2 < mesh->count; i += 3) {
        for (int c = 0; c < 3; c++) {
            set_corner(&t.corners[c], &mesh->corners[i + (size_t)c], drawn, camera, look, panel);
        }
        if (find_slopes(&t)) {
            paint(&t, drawn);
        }
    }
}

OzBox oz_mesh_rows_box(const OzMesh *mesh, const OzCamera *camera, const OzLook *look, int panel)
{
    const OzPanel *p = &camera->panels[panel];
    OzDrawn whole = {.box = {p->x, 0, p->width, look->height}};
    double low[2] = {p->width, look->height}, high[2] = {0, 0};
    for (size_t i = 0; i < mesh->count; i++) {
        Corner corner;
        set_corner(&corner, &mesh->corners[i], &whole, camera, look, panel);
        low[0] = fmin(low[0], corner.x);
        low[1] = fmin(low[1], corner.y);
        high[0] = fmax(high[0], corner.x);
        high[1] = fmax(high[1], corner.y);
    }
    int left = (int)fmax(floor(low[0]), 0), right = (int)fmin(ceil(high[0]), p->width);
    int bottom = (int)fmax(floor(low[1]), 0), top = (int)fmin(ceil(high[1]), look->height);
    return (OzBox){p->x + left, look->height - top, right > left ? right - left : 0,
                   top > bottom ? top - bottom : 0};
}
