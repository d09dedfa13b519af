/* Textures and framebuffers by a look's size. Knows nothing of what is drawn on them. */
#include "draw/targets.h"

#include <string.h>

enum {
    SAMPLES = 4,          /* of a pixel: smooth edges, and no cracks between triangles    */
    MANY_PIXELS = 1 << 24 /* above this a pixel has one sample: 4 would take gigabytes    */
};

void oz_targets_free(OzTargets *targets)
{
    const OzGl *gl = targets->gl;
    if (gl) {
        gl->DeleteFramebuffers(1, &targets->sample_target);
        gl->DeleteFramebuffers(1, &targets->result_target);
        gl->DeleteTextures(1, &targets->colours);
        gl->DeleteTextures(1, &targets->depths);
        gl->DeleteTextures(1, &targets->result);
    }
    memset(targets, 0, sizeof *targets);
}

/* What its samples of one pixel are kept in. */
static GLenum kind_of(const OzTargets *targets)
{
    return targets->sample_count > 0 ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D;
}

static GLuint plain_texture(const OzTargets *targets, GLint format, GLenum parts, GLenum type)
{
    const OzGl *gl = targets->gl;
    GLuint texture = 0;
    gl->GenTextures(1, &texture);
    gl->BindTexture(GL_TEXTURE_2D, texture);
    gl->TexImage2D(GL_TEXTURE_2D, 0, format, targets->width, targets->height, 0, parts, type, NULL);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return texture;
}

static GLuint sample_texture(const OzTargets *targets, GLenum format)
{
    const OzGl *gl = targets->gl;
    GLuint texture = 0;
    gl->GenTextures(1, &texture);
    gl->BindTexture(GL_TEXTURE_2D_MULTISAMPLE, texture);
    gl->TexImage2DMultisample(GL_TEXTURE_2D_MULTISAMPLE, targets->sample_count, format,
                              targets->width, targets->height, GL_TRUE);
    return texture;
}

static OzStatus check_target(const OzTargets *targets)
{
    GLenum state = targets->gl->CheckFramebufferStatus(GL_FRAMEBUFFER);
    if (state != GL_FRAMEBUFFER_COMPLETE) {
        return oz_status_fail(OZ_ERR_GRAPHICS, "no framebuffer of %d x %d pixels to be had (0x%x)",
                              targets->width, targets->height, state);
    }
    return OZ_OK;
}

static void make_textures(OzTargets *targets)
{
    if (targets->sample_count > 0) {
        targets->colours = sample_texture(targets, GL_RGBA8);
        targets->depths = sample_texture(targets, GL_DEPTH_COMPONENT32F);
    } else {
        targets->colours = plain_texture(targets, GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE);
        targets->depths =
            plain_texture(targets, GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT);
    }
    targets->result = plain_texture(targets, GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE);
}

static OzStatus attach(OzTargets *targets)
{
    const OzGl *gl = targets->gl;
    gl->GenFramebuffers(1, &targets->result_target);
    gl->BindFramebuffer(GL_FRAMEBUFFER, targets->result_target);
    gl->FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, targets->result,
                             0);
    OZ_PASS(check_target(targets));
    gl->GenFramebuffers(1, &targets->sample_target);
    gl->BindFramebuffer(GL_FRAMEBUFFER, targets->sample_target);
    gl->FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, kind_of(targets),
                             targets->colours, 0);
    gl->FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, kind_of(targets), targets->depths,
                             0);
    return check_target(targets);
}

OzStatus oz_targets_fit(OzTargets *targets, const OzGl *gl, const OzLook *look)
{
    OzStatus status = OZ_OK;
    int sample_count = !look->flat ? 0 : look->width * look->height > MANY_PIXELS ? 1 : SAMPLES;
    if (targets->width == look->width && targets->height == look->height &&
        targets->sample_count == sample_count) {
        return OZ_OK;
    }
    oz_targets_free(targets);
    *targets = (OzTargets){gl, look->width, look->height, sample_count, 0, 0, 0, 0, 0};
    make_textures(targets);
    OZ_TRY(oz_gl_check(gl, "making room for a picture"));
    OZ_TRY(attach(targets));
done:
    if (status != OZ_OK) {
        oz_targets_free(targets);
    }
    return status;
}
