/* Rods and spheres on the GPU: one record a grain that can be seen, each drawn as one rectangle
 * whose pixels are cast as rays. */
#pragma once

#include "draw/bodies.h"
#include "draw/gl.h"

/* A view's records, one after the other: whole ones, those that the cut plane meets, and those
 * before it, of which outlines are drawn. */
typedef struct OzCapsuleRanges {
    int64_t first, crossing, outlined, end;
} OzCapsuleRanges;

typedef struct OzCapsules {
    const OzGl *gl;       /* borrowed                                              */
    GLuint whole, sliced; /* programs: capsules as they are, and cut by the plane  */
    GLuint outlined;      /* program: their outlines alone                         */
    GLuint vertices, buffer;
    OzCapsuleRanges views[2];
} OzCapsules;

/* Needs a current context; capsules is zeroed or filled, ready for oz_capsules_free. */
OzStatus oz_capsules_create(OzCapsules *capsules, const OzGl *gl, const char *source_dir);
void oz_capsules_free(OzCapsules *capsules);

/* Takes over what each of their look's views shows of its bodies, in the look's colours. */
OzStatus oz_capsules_upload(OzCapsules *capsules, const OzBodies *const bodies[2]);

/* Draws the look's view of that number into the current viewport of the given width and height,
 * pixels; a cut view with the outlines of those before the plane over the others, if the look has
 * cut_outlines. */
void oz_capsules_draw(const OzCapsules *capsules, int view, const OzBodies *bodies,
                      double viewport_width, double viewport_height);
