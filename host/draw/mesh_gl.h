/* Meshes on the GPU. */
#pragma once

#include "draw/camera.h"
#include "draw/gl.h"
#include "draw/mesh.h"

typedef struct OzMeshGl {
    const OzGl *gl; /* borrowed */
    GLuint program, vertices, buffer;
} OzMeshGl;

/* Needs a current context; it is zeroed or filled, ready for oz_mesh_gl_free. */
OzStatus oz_mesh_gl_create(OzMeshGl *mesh_gl, const OzGl *gl, const char *source_dir);
void oz_mesh_gl_free(OzMeshGl *mesh_gl);

/* Into the current viewport of the given width and height, pixels: where it is nearer than what is
 * there, */
void oz_mesh_gl_draw_solid(const OzMeshGl *mesh_gl, const OzMesh *mesh, const OzCamera *camera,
                           double width, double height);
/* or over what is there, whose depth it leaves alone. */
void oz_mesh_gl_draw_over(const OzMeshGl *mesh_gl, const OzMesh *mesh, const OzCamera *camera,
                          double width, double height);
