/* An off-screen OpenGL 3.3 core context: EGL (surfaceless, else a bare EGL device), else OSMesa,
 * both opened at run time. */
#pragma once

#include "base/status.h"
#include "draw/gl.h"
#include "draw/look.h"

#include <stdio.h>

typedef struct OzContext {
    OzGl gl;                /* the functions of this context                              */
    char name[256];         /* "EGL surfaceless, Mesa ..., llvmpipe ..."                   */
    void *display, *handle; /* EGL: display and context; OSMesa: handle alone             */
    unsigned char *pixels;  /* OSMesa: the drawing surface that it insists on; not used   */
} OzContext;

/* Makes a context, current in the calling thread. OZ_GL_AUTO tries EGL, then OSMesa, and logs each
 * refusal with its reason. Fails with OZ_ERR_GRAPHICS; the text says what to install or try. The
 * library stays open until the process ends, since drivers do not unload cleanly. */
OzStatus oz_context_create(OzContext *context, OzGlBackend backend);

/* Makes it current again, after another context was used in this thread. */
OzStatus oz_context_use(const OzContext *context);

void oz_context_free(OzContext *context); /* zeroed is fine */

/* One line for each back-end: what it would give, or why it is refused. Each is tried in a process
 * of its own, since two Mesa libraries should not share one. */
void oz_context_describe(FILE *file);
