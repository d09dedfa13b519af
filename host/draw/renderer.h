/* Draws snapshots off-screen into images. One renderer is one GL context, used from the thread that
 * made it. */
#ifndef OZ_DRAW_RENDERER_H
#define OZ_DRAW_RENDERER_H

#include "base/status.h"
#include "draw/image.h"
#include "observe/snapshot.h"

typedef enum OzGlBackend { OZ_GL_AUTO, OZ_GL_EGL, OZ_GL_OSMESA } OzGlBackend;

/* What a picture shows. */
typedef struct OzLook {
    int width, height;  /* pixels */
    OzView views[2];
    int view_count;     /* 1, or 2 side by side */
    OzColour colour;
    double height_low, height_high; /* m: the vertical range that the camera frames */
    double speed_high;  /* m/s at the top of the colour bar, for OZ_COLOUR_SPEED */
} OzLook;

typedef struct OzRenderer OzRenderer;

/* OZ_GL_AUTO takes EGL (surfaceless), else OSMesa, logging each refusal with its reason. source_dir
 * as in oz_embed_read. Fails with OZ_ERR_GRAPHICS. */
OzStatus oz_renderer_create(OzRenderer **renderer, OzGlBackend backend, const char *source_dir);
void oz_renderer_free(OzRenderer *renderer); /* NULL is fine */

/* "EGL, Mesa ..., llvmpipe ...", for logs and metadata. */
const char *oz_renderer_name(const OzRenderer *renderer);

/* The look for a scene's movie settings, framing this snapshot's bed. */
OzLook oz_renderer_look(const OzScene *scene, const OzSnapshot *snapshot);

/* Draws into image, which has the look's size. */
OzStatus oz_renderer_draw(OzRenderer *renderer, const OzSnapshot *snapshot, const OzLook *look,
                          OzImage *image);

#endif
