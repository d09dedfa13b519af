/* What a mesh lays over a view, kept as long as the mesh stays as it is: glass is the same in every
 * picture of a movie, and many triangles. */
#pragma once

#include "draw/drawn.h"
#include "draw/mesh.h"

/* Freed with oz_layer_free. */
typedef struct OzLayer {
    uint8_t
        *pixels; /* of the box, with a block beside each row: colours times what they hide, that */
    OzCorner *corners; /* of the mesh that it is of     */
    size_t count;
    OzBox box;
    OzPanel panel; /* and what else it depends on */
    double scale;
    int height;
} OzLayer;

void oz_layer_free(OzLayer *layer); /* zeroed is fine */

/* The mesh over what is drawn of the panel's view. Fails with OZ_ERR_MEMORY. */
OzStatus oz_layer_draw(OzLayer *layer, const OzDrawn *drawn, const OzMesh *mesh,
                       const OzCamera *camera, const OzLook *look, int panel);
