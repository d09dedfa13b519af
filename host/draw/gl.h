/* The OpenGL functions that the pictures need, fetched from whichever context is current, and what
 * is built with them: programs from shader files, checks with a text. No GL library is linked. */
#pragma once

#include "base/status.h"

#include <GL/glcorearb.h>

/* Every function in use: the name in its header type, and its name without gl. */
#define OZ_GL_FUNCTIONS(X)                                                                         \
    X(ACTIVETEXTURE, ActiveTexture)                                                                \
    X(ATTACHSHADER, AttachShader)                                                                  \
    X(BINDBUFFER, BindBuffer)                                                                      \
    X(BINDFRAMEBUFFER, BindFramebuffer)                                                            \
    X(BINDTEXTURE, BindTexture)                                                                    \
    X(BINDVERTEXARRAY, BindVertexArray)                                                            \
    X(BLENDFUNC, BlendFunc)                                                                        \
    X(BLENDFUNCSEPARATE, BlendFuncSeparate)                                                        \
    X(BUFFERDATA, BufferData)                                                                      \
    X(CHECKFRAMEBUFFERSTATUS, CheckFramebufferStatus)                                              \
    X(CLEAR, Clear)                                                                                \
    X(CLEARCOLOR, ClearColor)                                                                      \
    X(COMPILESHADER, CompileShader)                                                                \
    X(CREATEPROGRAM, CreateProgram)                                                                \
    X(CREATESHADER, CreateShader)                                                                  \
    X(DELETEBUFFERS, DeleteBuffers)                                                                \
    X(DELETEFRAMEBUFFERS, DeleteFramebuffers)                                                      \
    X(DELETEPROGRAM, DeleteProgram)                                                                \
    X(DELETESHADER, DeleteShader)                                                                  \
    X(DELETETEXTURES, DeleteTextures)                                                              \
    X(DELETEVERTEXARRAYS, DeleteVertexArrays)                                                      \
    X(DEPTHMASK, DepthMask)                                                                        \
    X(DISABLE, Disable)                                                                            \
    X(DRAWARRAYS, DrawArrays)                                                                      \
    X(DRAWARRAYSINSTANCED, DrawArraysInstanced)                                                    \
    X(ENABLE, Enable)                                                                              \
    X(ENABLEVERTEXATTRIBARRAY, EnableVertexAttribArray)                                            \
    X(FRAMEBUFFERTEXTURE2D, FramebufferTexture2D)                                                  \
    X(GENBUFFERS, GenBuffers)                                                                      \
    X(GENFRAMEBUFFERS, GenFramebuffers)                                                            \
    X(GENTEXTURES, GenTextures)                                                                    \
    X(GENVERTEXARRAYS, GenVertexArrays)                                                            \
    X(GETERROR, GetError)                                                                          \
    X(GETINTEGERV, GetIntegerv)                                                                    \
    X(GETPROGRAMINFOLOG, GetProgramInfoLog)                                                        \
    X(GETPROGRAMIV, GetProgramiv)                                                                  \
    X(GETSHADERINFOLOG, GetShaderInfoLog)                                                          \
    X(GETSHADERIV, GetShaderiv)                                                                    \
    X(GETSTRING, GetString)                                                                        \
    X(GETUNIFORMLOCATION, GetUniformLocation)                                                      \
    X(LINKPROGRAM, LinkProgram)                                                                    \
    X(PIXELSTOREI, PixelStorei)                                                                    \
    X(READPIXELS, ReadPixels)                                                                      \
    X(SCISSOR, Scissor)                                                                            \
    X(SHADERSOURCE, ShaderSource)                                                                  \
    X(TEXIMAGE2D, TexImage2D)                                                                      \
    X(TEXIMAGE2DMULTISAMPLE, TexImage2DMultisample)                                                \
    X(TEXPARAMETERI, TexParameteri)                                                                \
    X(UNIFORM1F, Uniform1f)                                                                        \
    X(UNIFORM1I, Uniform1i)                                                                        \
    X(UNIFORM2FV, Uniform2fv)                                                                      \
    X(UNIFORM4F, Uniform4f)                                                                        \
    X(USEPROGRAM, UseProgram)                                                                      \
    X(VERTEXATTRIBDIVISOR, VertexAttribDivisor)                                                    \
    X(VERTEXATTRIBPOINTER, VertexAttribPointer)                                                    \
    X(VIEWPORT, Viewport)

typedef struct OzGl {
#define OZ_GL_MEMBER(TYPE, name) PFNGL##TYPE##PROC name;
    OZ_GL_FUNCTIONS(OZ_GL_MEMBER)
#undef OZ_GL_MEMBER
} OzGl;

typedef void (*OzGlFunction)(void);
typedef OzGlFunction (*OzGlFinder)(const char *name);

/* Fetches every function of the current context. Fails with OZ_ERR_GRAPHICS, naming the missing. */
OzStatus oz_gl_load(OzGl *gl, OzGlFinder find);

/* *program receives shaders/<name>.glsl built with both stages (OZ_VERTEX or OZ_FRAGMENT is
 * defined, shaders/lens.glsl stands before it). defines: further #define lines, or "". source_dir
 * as in oz_embed_read. Fails with OZ_ERR_GRAPHICS and the driver's log. Freed with DeleteProgram.
 */
OzStatus oz_gl_program(const OzGl *gl, GLuint *program, const char *source_dir, const char *name,
                       const char *defines);

/* Fails with OZ_ERR_GRAPHICS when GL has recorded an error since the last check. what: the work
 * just done, for the text. */
OzStatus oz_gl_check(const OzGl *gl, const char *what);
