/* Planes of pixels. Knows nothing of what is drawn. */
#include "draw/drawn.h"

#include "base/memory.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

void oz_drawn_free(OzDrawnRoom *room)
{
    free(room->colour);
    free(room->depth);
    memset(room, 0, sizeof *room);
}

static OzStatus fit(OzDrawnRoom *room, size_t count)
{
    if (count <= room->capacity) {
        return OZ_OK;
    }
    oz_drawn_free(room);
    OZ_PASS(OZ_NEW(&room->colour, 4 * count));
    OZ_PASS(OZ_NEW(&room->depth, count));
    room->capacity = count;
    return OZ_OK;
}

OzStatus oz_drawn_open(OzDrawn *drawn, OzDrawnRoom *room, const OzBox *box, const float rgb[3])
{
    const int border = OZ_DRAWN_BLOCK;
    int stride = box->width + 2 * border, rows = box->height + 2 * border;
    size_t count = (size_t)stride * (size_t)rows;
    size_t inset = (size_t)border * (size_t)(stride + 1);
    uint8_t rgba[4] = {0}, none[4] = {0};
    for (int k = 0; k < 3; k++) {
        rgba[k] = (uint8_t)lroundf(255 * rgb[k]);
    }
    OZ_PASS(fit(room, count));
    *drawn = (OzDrawn){*box, stride, room->colour + 4 * inset, room->depth + inset};
    for (int x = 0; x < stride; x++) {
        bool inside = x >= border && x < border + box->width;
        room->depth[x] = 1;
        memcpy(room->colour + 4 * x, inside ? rgba : none, 4);
    }
    for (int y = 1; y < rows; y++) {
        size_t place = (size_t)y * (size_t)stride;
        memcpy(room->depth + place, room->depth, sizeof *room->depth * (size_t)stride);
        memcpy(room->colour + 4 * place, room->colour, 4 * (size_t)stride);
    }
    memset(room->colour, 0, 4 * inset);
    memset(room->colour + 4 * (count - inset), 0, 4 * inset);
    return OZ_OK;
}
