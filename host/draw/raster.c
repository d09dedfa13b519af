/* Which rows and blocks of a picture a grain may be seen in. Knows no colours but the palette's. */
#include "draw/raster.h"

#include "base/memory.h"
#include "draw/palette.h"
#include "draw/stadium.h"
#include "draw/wide.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    BLOCK = OZ_DRAWN_BLOCK,
    BAND = 8 /* rows of which far has one number a block: as high as rods are thick, or less */
};

typedef int DrawRow(const OzRasterLens *lens, const OzRasterBody *body, const OzRasterRow *row);

/* A grain on its way into the planes. */
typedef struct Stroke {
    OzRasterBody body;
    OzStadium stadium;
    OzStadiumSpan rows;
    float near; /* depth of its nearest point, or less */
} Stroke;

static void set_lens(OzRaster *raster)
{
    const OzCamera *camera = raster->bodies->camera;
    OzRasterLens *lens = &raster->lens;
    *lens = (OzRasterLens){.distance = (float)camera->distance,
                           .depth = (float)camera->depth,
                           .pixel = (float)(1 / camera->scale),
                           .offset = (float)raster->bodies->offset,
                           .along = raster->along};
    for (int k = 0; k < 3; k++) {
        lens->plane[k] = (float)raster->bodies->inward[k];
    }
    for (int x = 0; x < (raster->blocks + 1) * BLOCK; x++) {
        raster->along[x] =
            (float)((x + 0.5 - raster->middle[0]) / (camera->scale * camera->distance));
    }
}

/* Notes anew how far a band's blocks reach back. */
static void note_far(OzRaster *raster, int band, int first, int end)
{
    int low = band * BAND, height = raster->drawn.box.height;
    int high = low + BAND < height ? low + BAND : height;
    for (int block = first; block < end; block++) {
        float most[BLOCK] = {0}, far = 0;
        for (int y = low; y < high; y++) {
            const float *depth = raster->drawn.depth + (ptrdiff_t)y * raster->drawn.stride +
                                 (ptrdiff_t)block * BLOCK;
            for (int i = 0; i < BLOCK; i++) {
                most[i] = most[i] > depth[i] ? most[i] : depth[i];
            }
        }
        for (int i = 0; i < BLOCK; i++) {
            far = far > most[i] ? far : most[i];
        }
        raster->far[band * raster->blocks + block] = far;
    }
}

OzStatus oz_raster_begin(OzRaster *raster, const OzDrawn *drawn, const OzBodies *bodies, int panel)
{
    const OzPanel *p = &bodies->camera->panels[panel];
    const OzBox *box = &drawn->box;
    int bands = (box->height + BAND - 1) / BAND;
    *raster = (OzRaster){.bodies = bodies, .drawn = *drawn, .view = bodies->look->views[panel]};
    raster->middle[0] = (double)lround(p->middle_x) - box->x;
    raster->middle[1] = (double)box->y + box->height - (double)lround(p->middle_y);
    raster->blocks = (box->width + BLOCK - 1) / BLOCK;
    OZ_PASS(OZ_NEW(&raster->along, (raster->blocks + 1) * BLOCK));
    OZ_PASS(OZ_NEW(&raster->far, raster->blocks * bands + 1));
    set_lens(raster);
    for (int band = 0; band < bands; band++) {
        note_far(raster, band, 0, raster->blocks);
    }
    return OZ_OK;
}

/* What was drawn in the frame, by blocks that reach beyond the box, is the frame's again. */
static void clean_frame(const OzRaster *raster)
{
    const OzDrawn *drawn = &raster->drawn;
    int width = drawn->box.width, beside = BLOCK;
    for (int y = 0; y < drawn->box.height; y++) {
        ptrdiff_t place = (ptrdiff_t)y * drawn->stride + width;
        memset(drawn->colour + 4 * place, 0, 4 * (size_t)beside);
        for (int x = 0; x < beside; x++) {
            drawn->depth[place + x] = 1;
        }
    }
}

void oz_raster_end(OzRaster *raster)
{
    free(raster->along);
    free(raster->far);
    memset(raster, 0, sizeof *raster);
}

/* Its outline is a little wider than its discs', off the picture's middle most. */
static Stroke stroke_of(const OzRaster *raster, int64_t k)
{
    const OzBody *from = &raster->bodies->bodies[k];
    const OzCamera *camera = raster->bodies->camera;
    double ends[2][2], radius = (double)from->radius, widest = 0, near = -1e9;
    Stroke stroke = {.body = {.radius = from->radius, .half_shaft = from->half_shaft}};
    memcpy(stroke.body.centre, from->centre, sizeof from->centre);
    memcpy(stroke.body.axis, from->axis, sizeof from->axis);
    for (int e = 0; e < 2; e++) {
        double at = e ? (double)from->half_shaft : -(double)from->half_shaft, point[3];
        for (int c = 0; c < 3; c++) {
            point[c] = (double)from->centre[c] + at * (double)from->axis[c];
        }
        double scale = camera->scale * camera->distance / fmax(camera->distance - point[2], 1e-6);
        ends[e][0] = raster->middle[0] + scale * point[0];
        ends[e][1] = raster->middle[1] + scale * point[1];
        widest = fmax(widest, scale * radius);
        near = fmax(near, point[2] + radius);
    }
    stroke.near = (float)(0.5 - 0.5 * near / camera->depth) - 1e-6f;
    stroke.stadium = oz_stadium_make(ends[0], ends[1], 1.02 * widest + 0.05);
    stroke.rows = oz_stadium_rows(&stroke.stadium, raster->drawn.box.height);
    return stroke;
}

/* The columns about a stroke. */
static OzStadiumSpan columns_of(const OzRaster *raster, const Stroke *stroke)
{
    const OzStadium *s = &stroke->stadium;
    double low = fmin(s->ends[0][0], s->ends[1][0]), high = fmax(s->ends[0][0], s->ends[1][0]);
    return (OzStadiumSpan){oz_stadium_first(low - s->radius),
                           oz_stadium_end(high + s->radius, raster->drawn.box.width)};
}

/* Whether any block about it reaches back to it; deep in a bed most do not. */
static bool may_show(const OzRaster *raster, const Stroke *stroke, const OzStadiumSpan *blocks)
{
    int open = 0;
    for (int band = stroke->rows.first / BAND; band * BAND < stroke->rows.end && !open; band++) {
        const float *far = raster->far + (ptrdiff_t)band * raster->blocks;
        for (int block = blocks->first; block < blocks->end; block++) {
            open |= far[block] > stroke->near;
        }
    }
    return open;
}

/* A row's pixels, without blocks at its ends that others hide. */
static OzRasterRow row_of(const OzRaster *raster, const Stroke *stroke, int y)
{
    const OzDrawn *drawn = &raster->drawn;
    const float *far = raster->far + (ptrdiff_t)(y / BAND) * raster->blocks;
    const OzCamera *camera = raster->bodies->camera;
    OzStadiumSpan span = oz_stadium_row(&stroke->stadium, y, drawn->box.width);
    OzRasterRow row = {drawn->depth + (ptrdiff_t)y * drawn->stride,
                       drawn->colour + 4 * (ptrdiff_t)y * drawn->stride,
                       (float)((y + 0.5 - raster->middle[1]) / (camera->scale * camera->distance)),
                       span.first, span.end};
    while (row.first < row.end && far[row.first / BLOCK] <= stroke->near) {
        row.first = row.first / BLOCK * BLOCK + BLOCK;
    }
    while (row.first < row.end && far[(row.end - 1) / BLOCK] <= stroke->near) {
        row.end = (row.end - 1) / BLOCK * BLOCK;
    }
    return row;
}

/* The same of the pixels of the box about it. */
OZ_WIDE static bool is_open(const OzRaster *raster, const Stroke *stroke, const OzStadiumSpan *box)
{
    for (int y = stroke->rows.first; y < stroke->rows.end; y++) {
        const float *depth = raster->drawn.depth + (ptrdiff_t)y * raster->drawn.stride;
        int open = 0;
        for (int x = box->first; x < box->end; x++) {
            open |= depth[x] > stroke->near;
        }
        if (open) {
            return true;
        }
    }
    return false;
}

static void take_colour(const OzRaster *raster, Stroke *stroke, int64_t k)
{
    oz_bodies_colour(raster->bodies, k, stroke->body.rgb);
}

static void draw_body(OzRaster *raster, int64_t k, DrawRow *draw_row)
{
    Stroke stroke = stroke_of(raster, k);
    OzStadiumSpan columns = columns_of(raster, &stroke);
    OzStadiumSpan blocks = {columns.first / BLOCK, (columns.end + BLOCK - 1) / BLOCK};
    if (!may_show(raster, &stroke, &blocks) || !is_open(raster, &stroke, &columns)) {
        return;
    }
    take_colour(raster, &stroke, k);
    for (int y = stroke.rows.first, any = 0; y < stroke.rows.end; y++) {
        OzRasterRow row = row_of(raster, &stroke, y);
        any |= row.first < row.end && draw_row(&raster->lens, &stroke.body, &row);
        if (any && (y % BAND == BAND - 1 || y + 1 == stroke.rows.end)) {
            note_far(raster, y / BAND, blocks.first, blocks.end);
            any = 0;
        }
    }
}

static void draw_outline(const OzRaster *raster, int64_t k)
{
    Stroke stroke = stroke_of(raster, k);
    stroke.near = -1;
    take_colour(raster, &stroke, k);
    for (int y = stroke.rows.first; y < stroke.rows.end; y++) {
        OzRasterRow row = row_of(raster, &stroke, y);
        oz_raster_row_outlined(&raster->lens, &stroke.body, &row);
    }
}

void oz_raster_draw(OzRaster *raster)
{
    const OzBodies *bodies = raster->bodies;
    DrawRow *const draw_row[] = {
        [OZ_SIDE_BEHIND] = oz_raster_row_whole, [OZ_SIDE_CROSSING] = oz_raster_row_sliced};
    for (int64_t k = 0; k < bodies->count; k++) {
        OzSide side = oz_bodies_side(bodies, raster->view, k);
        if (side != OZ_SIDE_FRONT) {
            draw_body(raster, k, draw_row[side]);
        }
    }
    for (int64_t k = 0; bodies->look->cut_outlines && k < bodies->count; k++) {
        if (oz_bodies_side(bodies, raster->view, k) == OZ_SIDE_FRONT) {
            draw_outline(raster, k);
        }
    }
    clean_frame(raster);
}
