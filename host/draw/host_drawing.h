/* A view of rods and their container drawn by the host into planes. */
#pragma once

#include "draw/bodies.h"
#include "draw/container.h"
#include "draw/drawn.h"
#include "draw/layer.h"

typedef struct OzHostDrawing {
    OzContainer container; /* of the view in hand */
    OzLayer glass[2][2];   /* of each panel: behind the grains, before them */
} OzHostDrawing;

void oz_host_drawing_free(OzHostDrawing *drawing); /* zeroed is fine */

/* Makes the view's container; box receives what the view may paint. */
OzStatus oz_host_drawing_begin(OzHostDrawing *drawing, const OzBodies *bodies, int view,
                               OzBox *box);

/* Draws it into planes of that box, just opened. Fails with OZ_ERR_MEMORY. */
OzStatus oz_host_drawing_draw(OzHostDrawing *drawing, const OzDrawn *drawn, const OzBodies *bodies,
                              int view);
