/* Rods and spheres on the GPU: one record a grain, each drawn as one rectangle whose pixels are
 * cast as rays. */
#pragma once

#include "draw/camera.h"
#include "draw/gl.h"

typedef struct OzCapsules {
    const OzGl *gl;       /* borrowed                                              */
    GLuint whole, sliced; /* programs: capsules as they are, and cut by the plane  */
    GLuint outlined;      /* program: their outlines alone                         */
    GLuint vertices, buffer;
    GLfloat samples[8]; /* pixels: where the samples of a pixel lie, about its middle */
    int64_t crossing, behind, count; /* records up to `crossing` meet the cut plane, up to `behind`
                                        lie behind it or meet it */
    double low[2], high[2];          /* view coordinates x and y that the grains may reach    */
} OzCapsules;

/* Needs a current context; capsules is zeroed or filled, ready for oz_capsules_free. */
OzStatus oz_capsules_create(OzCapsules *capsules, const OzGl *gl, const char *source_dir);
void oz_capsules_free(OzCapsules *capsules);

/* Takes over the grains of a snapshot, in the look's colours, for all views. */
OzStatus oz_capsules_upload(OzCapsules *capsules, const OzSnapshot *snapshot, const OzLook *look,
                            const OzCamera *camera);

/* Takes the samples' places from the framebuffer that is bound now. */
void oz_capsules_find_samples(OzCapsules *capsules, int sample_count);

/* Draws them into the current viewport of the given width and height, pixels; in the cut view with
 * the outlines of those before the plane, over the others, if the look has cut_outlines. */
void oz_capsules_draw(const OzCapsules *capsules, OzView view, const OzLook *look,
                      const OzCamera *camera, double viewport_width, double viewport_height);
