/* The walls as glass, floor and lines, so that one sees the grains inside. Part of it lies behind
 * the grains and is drawn before them, part in front and is drawn after. */
#pragma once

#include "draw/camera.h"
#include "draw/gl.h"
#include "draw/mesh.h"

typedef struct OzContainer {
    const OzGl *gl; /* borrowed */
    GLuint program, vertices, buffer;
    OzMesh floors; /* opaque, behind the grains, with depth */
    OzMesh behind; /* glass and lines behind the grains     */
    OzMesh before; /* glass and lines in front of them      */
    double high;   /* view coordinate y up to which they are seen */
} OzContainer;

/* Needs a current context; container is zeroed or filled, ready for oz_container_free. */
OzStatus oz_container_create(OzContainer *container, const OzGl *gl, const char *source_dir);
void oz_container_free(OzContainer *container);

/* Makes the meshes of the snapshot's walls where they are now, for this view; they end above the
 * highest grain, or where the picture does. */
OzStatus oz_container_build(OzContainer *container, const OzSnapshot *snapshot, const OzLook *look,
                            const OzCamera *camera, OzView view);

/* Draw into the current viewport of the given width and height, pixels: first this, then the
 * grains, */
void oz_container_draw_behind(const OzContainer *container, const OzCamera *camera, double width,
                              double height);
/* then this. */
void oz_container_draw_before(const OzContainer *container, const OzCamera *camera, double width,
                              double height);
