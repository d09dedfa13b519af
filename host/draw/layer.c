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

static int stride_of(const OzBox *box)
{
    return box->width + OZ_DRAWN_BLOCK;
}

static OzStatus make(OzLayer *layer, const OzMesh *mesh, const OzCamera *camera, const OzLook *look,
                     int panel)
{
    OzBox box = oz_mesh_rows_box(mesh, camera, look, panel);
    oz_layer_free(layer);
    OZ_PASS(OZ_NEW(&layer->pixels, 4 * (size_t)stride_of(&box) * (size_t)box.height));
    OZ_PASS(OZ_NEW(&layer->corners, mesh->count));
    memcpy(layer->corners, mesh->corners, mesh->count * sizeof *mesh->corners);
    layer->count = mesh->count;
    layer->box = box;
    layer->panel = camera->panels[panel];
    layer->scale = camera->scale;
    layer->height = look->height;
    OzDrawn own = {box, stride_of(&box), layer->pixels, NULL};
    oz_mesh_rows_paint(&own, mesh, camera, look, panel, OZ_MESH_LAYER);
    return OZ_OK;
}

/* Whether painting it anew would give the same. */
static bool is_of(const OzLayer *layer, const OzMesh *mesh, const OzCamera *camera,
                  const OzLook *look, int panel)
{
    const OzPanel *own = &layer->panel, *p = &camera->panels[panel];
    return layer->pixels && layer->count == mesh->count && layer->scale == camera->scale &&
           layer->height == look->height && own->x == p->x && own->width == p->width &&
           own->middle_x == p->middle_x && own->middle_y == p->middle_y &&
           memcmp(layer->corners, mesh->corners, mesh->count * sizeof *mesh->corners) == 0;
}

static int least(int a, int b)
{
    return a < b ? a : b;
}

static int most(int a, int b)
{
    return a > b ? a : b;
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
    if (!is_of(layer, mesh, camera, look, panel)) {
        OZ_PASS(make(layer, mesh, camera, look, panel));
    }
    const OzBox *own = &layer->box, *box = &drawn->box;
    int left = most(own->x, box->x), right = least(own->x + own->width, box->x + box->width);
    int top = most(own->y, box->y), bottom = least(own->y + own->height, box->y + box->height);
    for (int y = top; y < bottom && left < right; y++) {
        ptrdiff_t row = own->y + own->height - 1 - y, target = box->y + box->height - 1 - y;
        lay_row(layer->pixels + 4 * (row * stride_of(own) + left - own->x),
                drawn->colour + 4 * (target * drawn->stride + left - box->x), right - left);
    }
    return OZ_OK;
}
