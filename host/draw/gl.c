/* Fetching GL functions, building programs, naming errors. Knows nothing of what is drawn. */
#include "draw/gl.h"

#include "base/embed.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LOG_LENGTH = 4000 };

static OzStatus fetch(void *slot, OzGlFinder find, const char *name)
{
    OzGlFunction function = find(name);
    if (!function) {
        return oz_status_fail(OZ_ERR_GRAPHICS, "this OpenGL has no %s; OpenGL 3.3 is needed", name);
    }
    memcpy(slot, &function, sizeof function);
    return OZ_OK;
}

OzStatus oz_gl_load(OzGl *gl, OzGlFinder find)
{
#define FETCH(TYPE, name) OZ_PASS(fetch(&gl->name, find, "gl" #name));
    OZ_GL_FUNCTIONS(FETCH)
#undef FETCH
    return OZ_OK;
}

static OzStatus compile(const OzGl *gl, GLuint *shader, GLenum stage, const char *const sources[5],
                        const char *name)
{
    GLint built = 0;
    *shader = gl->CreateShader(stage);
    gl->ShaderSource(*shader, 5, sources, NULL);
    gl->CompileShader(*shader);
    gl->GetShaderiv(*shader, GL_COMPILE_STATUS, &built);
    if (!built) {
        char log[LOG_LENGTH] = "";
        gl->GetShaderInfoLog(*shader, sizeof log, NULL, log);
        return oz_status_fail(OZ_ERR_GRAPHICS,
                              "%s stage of shaders/%s.glsl does not compile "
                              "(source 0 is shaders/lens.glsl, 1 is shaders/%s.glsl):\n%s",
                              stage == GL_VERTEX_SHADER ? "vertex" : "fragment", name, name, log);
    }
    return OZ_OK;
}

static OzStatus link_stages(const OzGl *gl, GLuint program, const GLuint stages[2],
                            const char *name)
{
    GLint linked = 0;
    gl->AttachShader(program, stages[0]);
    gl->AttachShader(program, stages[1]);
    gl->LinkProgram(program);
    gl->GetProgramiv(program, GL_LINK_STATUS, &linked);
    if (!linked) {
        char log[LOG_LENGTH] = "";
        gl->GetProgramInfoLog(program, sizeof log, NULL, log);
        return oz_status_fail(OZ_ERR_GRAPHICS, "shaders/%s.glsl does not link:\n%s", name, log);
    }
    return OZ_OK;
}

OzStatus oz_gl_program(const OzGl *gl, GLuint *program, const char *source_dir, const char *name,
                       const char *defines)
{
    OzStatus status = OZ_OK;
    char file[256], vertex[512], fragment[512];
    char *lens = NULL, *text = NULL;
    GLuint stages[2] = {0, 0};
    *program = 0;
    snprintf(file, sizeof file, "shaders/%s.glsl", name);
    snprintf(vertex, sizeof vertex, "#version 330 core\n#define OZ_VERTEX\n%s", defines);
    snprintf(fragment, sizeof fragment, "#version 330 core\n#define OZ_FRAGMENT\n%s", defines);
    OZ_TRY(oz_embed_read(&lens, source_dir, "shaders/lens.glsl"));
    OZ_TRY(oz_embed_read(&text, source_dir, file));
    const char *sources[5] = {vertex, "#line 1 0\n", lens, "\n#line 1 1\n", text};
    OZ_TRY(compile(gl, &stages[0], GL_VERTEX_SHADER, sources, name));
    sources[0] = fragment;
    OZ_TRY(compile(gl, &stages[1], GL_FRAGMENT_SHADER, sources, name));
    *program = gl->CreateProgram();
    OZ_TRY(link_stages(gl, *program, stages, name));
done:
    gl->DeleteShader(stages[0]);
    gl->DeleteShader(stages[1]);
    if (status != OZ_OK && *program) {
        gl->DeleteProgram(*program);
        *program = 0;
    }
    free(lens);
    free(text);
    return status;
}

static const char *error_name(GLenum code)
{
    switch (code) {
    case GL_INVALID_ENUM:
        return "GL_INVALID_ENUM";
    case GL_INVALID_VALUE:
        return "GL_INVALID_VALUE";
    case GL_INVALID_OPERATION:
        return "GL_INVALID_OPERATION";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
        return "GL_INVALID_FRAMEBUFFER_OPERATION";
    case GL_OUT_OF_MEMORY:
        return "GL_OUT_OF_MEMORY";
    default:
        return "an unknown code";
    }
}

OzStatus oz_gl_check(const OzGl *gl, const char *what)
{
    GLenum code = gl->GetError();
    if (code == GL_NO_ERROR) {
        return OZ_OK;
    }
    for (int i = 0; i < 16 && gl->GetError() != GL_NO_ERROR; i++) {
    }
    return oz_status_fail(OZ_ERR_GRAPHICS, "OpenGL failed while %s: %s (0x%x)", what,
                          error_name(code), code);
}
