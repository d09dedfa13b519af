/* Draws snapshots off-screen into images. One renderer has one GL context or none, and is used from
 * the thread that made it; several in as many threads draw the same pictures. */
#pragma once

#include "base/status.h"
#include "draw/image.h"
#include "model/snapshot.h"

#include <stdbool.h>
#include <stdio.h>

/* Who draws rods: a GPU by OpenGL where there is one, else the host; one of two OpenGL libraries,
 * whatever they draw with; the host. Flat grains are always drawn by OpenGL. */
typedef enum OzGlBackend { OZ_GL_AUTO, OZ_GL_EGL, OZ_GL_OSMESA, OZ_GL_HOST } OzGlBackend;

/* What a picture shows. Start from oz_renderer_look and change size, views and colour at will: the
 * framing is in metres and holds for any of them. */
typedef struct OzLook {
    int width, height; /* pixels, OZ_PICTURE_SIDE_MIN to _MAX, any aspect */
    OzView views[2];
    int view_count; /* 1, or 2 side by side */
    OzColour colour;
    double height_low, height_high; /* m: the vertical range that the camera frames */
    double speed_high;              /* m/s at the top of the colour bar, for OZ_COLOUR_SPEED */
    double centre[2];               /* m: x and y at the middle of the picture */
    double half_width;    /* m: what is framed to the left and right of the middle, and in depth */
    double cut;           /* m: the cut view shows what lies at y above this */
    double elevation;     /* rad: how far above the horizon the camera stands */
    bool bare;            /* grains alone on white: no container, no overlay */
    bool flat;            /* seen straight on in the plane x-y, as trigrains are: height_low and
                           * height_high are of y, views and cut say nothing */
    bool cut_outlines;    /* the cut view: grains before the plane as faint outlines */
    bool outlines, beams; /* flat: of grains                              */
    const char *caption;  /* above the lower edge; NULL: none; borrowed                    */
    double strobe;        /* flat: s between states that are laid over each other, for the caption;
                           * 0 for a single one */
} OzLook;

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
