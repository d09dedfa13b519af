/* What a picture is drawn on: colours and depths, and the finished pixels. */
#pragma once

#include "draw/gl.h"
#include "draw/look.h"

typedef struct OzTargets {
    const OzGl *gl;                      /* borrowed; NULL before the first picture            */
    int width, height;                   /* pixels                                             */
    int sample_count;                    /* of a pixel, in multisample textures; 0: plain ones  */
    GLuint colours, depths, result;      /* textures                                           */
    GLuint sample_target, result_target; /* framebuffers                                       */
} OzTargets;

/* Makes them anew where they are not what the look needs: rods smooth their own edges, flat grains
 * need samples. Fails with OZ_ERR_GRAPHICS. */
OzStatus oz_targets_fit(OzTargets *targets, const OzGl *gl, const OzLook *look);

/* Needs their context; zeroed is fine. */
void oz_targets_free(OzTargets *targets);
