/* Pictures by OpenGL, up to what is finished on the host: a view's grains and container into
 * planes, flat grains and their walls into an image. Makes what a picture needs when the first one
 * does. */
#pragma once

#include "draw/bodies.h"
#include "draw/capsules.h"
#include "draw/container.h"
#include "draw/context.h"
#include "draw/drawn.h"
#include "draw/mesh_gl.h"
#include "draw/polygons.h"
#include "draw/targets.h"

typedef struct OzGlDrawing {
    OzContext context;
    const char *source_dir; /* as in oz_embed_read; borrowed */
    OzCapsules capsules;
    OzContainer container; /* of the view drawn last                           */
    double high[2];        /* of each view: as far up as its container is seen */
    OzMeshGl mesh_gl;
    OzPolygons polygons;
    GLuint compose, no_vertices;
    OzTargets targets;
} OzGlDrawing;

/* Makes a context, current in the calling thread. Fails as oz_context_create; drawing is zeroed or
 * filled, ready for oz_gl_drawing_free. */
OzStatus oz_gl_drawing_create(OzGlDrawing *drawing, OzGlBackend backend, const char *source_dir);
void oz_gl_drawing_free(OzGlDrawing *drawing); /* zeroed is fine */

/* Whether a program on the processor plays the GPU. */
bool oz_gl_drawing_is_slow(const OzGlDrawing *drawing);

/* All views of rods, each of its bodies, to be read. Fails with OZ_ERR_GRAPHICS, beyond the
 * driver's largest picture too.
 */
OzStatus oz_gl_drawing_views(OzGlDrawing *drawing, const OzBodies *const bodies[2]);

/* What a view may have painted, after that. */
OzBox oz_gl_drawing_box(const OzGlDrawing *drawing, const OzBodies *bodies, int view);

/* What was drawn there, into planes of that box. */
OzStatus oz_gl_drawing_read(const OzGlDrawing *drawing, const OzDrawn *drawn, const OzLook *look);

/* States of flat grains over each other; the first of several is faint, the last is opaque. Fails
 * as oz_gl_drawing_views. */
OzStatus oz_gl_drawing_flat(OzGlDrawing *drawing, const OzSnapshot *snapshots, int count,
                            const OzLook *look, const OzCamera *camera, OzImage *image);
