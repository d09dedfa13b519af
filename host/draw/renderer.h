/* Draws snapshots off-screen into images. One renderer has one GL context or none, and is used from
 * the thread that made it; several in as many threads draw the same pictures. Both views of a
 * picture may be drawn at once, by a thread that ends with it. */
#pragma once

#include "base/status.h"
#include "draw/image.h"
#include "draw/look.h"
#include "model/snapshot.h"

#include <stdio.h>

typedef struct OzRenderer OzRenderer;

/* Where OpenGL is needed, EGL (surfaceless) is taken, else OSMesa, each refusal logged with its
 * reason; unless the backend names one of them, it is opened by the first picture that needs it.
 * source_dir as in oz_embed_read, borrowed. Fails with OZ_ERR_GRAPHICS. */
OzStatus oz_renderer_create(OzRenderer **renderer, OzGlBackend backend, const char *source_dir);
void oz_renderer_free(OzRenderer *renderer); /* NULL is fine */

/* "EGL surfaceless, OpenGL ... Mesa ..., llvmpipe ...", for logs and metadata; of rods. */
const char *oz_renderer_name(const OzRenderer *renderer);

/* The look for a scene's movie settings (1280x720, both views and angle without any), framing this
 * snapshot's bed and its walls with room above for bouncing. Meant to be taken once, from the
 * settled bed, and kept, so that pictures do not jitter. */
OzLook oz_renderer_look(const OzScene *scene, const OzSnapshot *snapshot);

/* Draws into image, which has the look's size. Fails with OZ_ERR_GRAPHICS, beyond the driver's
 * largest picture too. */
OzStatus oz_renderer_draw(OzRenderer *renderer, const OzSnapshot *snapshot, const OzLook *look,
                          OzImage *image);

/* Draws several states (count > 0) over each other if the look is flat, oldest first, each fainter
 * than the next; walls and heading are the last one's. Otherwise as above. */
OzStatus oz_renderer_draw_states(OzRenderer *renderer, const OzSnapshot *snapshots, int count,
                                 const OzLook *look, OzImage *image);

/* For `orzo devices`: one line for each GL back-end, what it gives or why it is refused. Call it
 * before any renderer or OpenCL device exists in this process: it forks. */
void oz_renderer_describe(FILE *file);
