/* Painting a layer once and laying it over many pictures. */
#include "draw/layer.h"

#include "base/memory.h"
#include "draw/mesh_rows.h"
#include "draw/wide.h"

#include <stdlib.h>
#include <string.h>

void oz_layer_free(OzLayer *layer)
{
    free(layer->pixels);
    free(layer->corners);
    memset(layer, 0, sizeof *layer);
}

static bool is_of(const OzLayer *layer, const OzDrawn *drawn, const OzMesh *mesh, double scale)
{
    return layer->pixels && layer->count == mesh->count && layer->scale == scale &&
           memcmp(&layer->box, &drawn->box, sizeof layer->box) == 0 &&
           memcmp(layer->corners, mesh->corners, mesh->count * sizeof *mesh->corners) == 0;
}

static int stride_of(const OzBox *box)
{
    return box->width + OZ_DRAWN_BLOCK;
}

static OzStatus make(OzLayer *layer, const OzDrawn *drawn, const OzMesh *mesh,
                     const OzCamera *camera, const OzLook *look, int panel)
{
    int stride = stride_of(&drawn->box);
    oz_layer_free(layer);
    OZ_PASS(OZ_NEW(&layer->pixels, 4 * (size_t)stride * (size_t)drawn->box.height));
    OZ_PASS(OZ_NEW(&layer->corners, mesh->count));
    memcpy(layer->corners, mesh->corners, mesh->count * sizeof *mesh->corners);
    layer->count = mesh->count;
    layer->box = drawn->box;
    layer->scale = camera->scale;
    OzDrawn own = {drawn->box, stride, layer->pixels, NULL};
    oz_mesh_rows_paint(&own, mesh, camera, look, panel, OZ_MESH_LAYER);
    return OZ_OK;
}

/* The fourth byte of the target stays. */
OZ_WIDE static void lay_row(const uint8_t *restrict over, uint8_t *restrict rgba, int width)
{
    for (int x = 0; x < width; x++) {
        uint32_t old, top, mixed = 0;
        memcpy(&old, rgba + 4 * x, sizeof old);
        memcpy(&top, over + 4 * x, sizeof top);
        uint32_t open = 255 - (top >> OZ_WIDE_SHIFT(3) & 255);
        for (int k = 0; k < 3; k++) {
            uint32_t through = (old >> OZ_WIDE_SHIFT(k) & 255) * open + 128;
            uint32_t sum = (top >> OZ_WIDE_SHIFT(k) & 255) + ((through + (through >> 8)) >> 8);
            mixed |= (sum < 255 ? sum : 255) << OZ_WIDE_SHIFT(k);
        }
        mixed |= old & (uint32_t)255 << OZ_WIDE_SHIFT(3);
        memcpy(rgba + 4 * x, &mixed, sizeof mixed);
    }
}

OzStatus oz_layer_draw(OzLayer *layer, const OzDrawn *drawn, const OzMesh *mesh,
                       const OzCamera *camera, const OzLook *look, int panel)
{
    if (mesh->count == 0) {
        return OZ_OK;
    }
    if (!is_of(layer, drawn, mesh, camera->scale)) {
        OZ_PASS(make(layer, drawn, mesh, camera, look, panel));
    }
    for (int y = 0; y < drawn->box.height; y++) {
        lay_row(layer->pixels + 4 * (size_t)y * (size_t)stride_of(&drawn->box),
                drawn->colour + 4 * (ptrdiff_t)y * drawn->stride, drawn->box.width);
    }
    return OZ_OK;
}
