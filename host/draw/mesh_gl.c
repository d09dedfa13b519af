/* Sending meshes and drawing them. Knows nothing of what they show. */
#include "draw/mesh_gl.h"

#include <stddef.h>
#include <stdint.h>
#include <string.h>

OzStatus oz_mesh_gl_create(OzMeshGl *mesh_gl, const OzGl *gl, const char *source_dir)
{
    const void *colour = (const void *)(uintptr_t)offsetof(OzCorner, rgba);
    const void *across = (const void *)(uintptr_t)offsetof(OzCorner, across);
    memset(mesh_gl, 0, sizeof *mesh_gl);
    mesh_gl->gl = gl;
    OZ_PASS(oz_gl_program(gl, &mesh_gl->program, source_dir, "mesh", ""));
    gl->GenVertexArrays(1, &mesh_gl->vertices);
    gl->BindVertexArray(mesh_gl->vertices);
    gl->GenBuffers(1, &mesh_gl->buffer);
    gl->BindBuffer(GL_ARRAY_BUFFER, mesh_gl->buffer);
    gl->EnableVertexAttribArray(0);
    gl->EnableVertexAttribArray(1);
    gl->EnableVertexAttribArray(2);
    gl->VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(OzCorner), NULL);
    gl->VertexAttribPointer(1, 4, GL_FLOAT, GL_FALSE, sizeof(OzCorner), colour);
    gl->VertexAttribPointer(2, 2, GL_FLOAT, GL_FALSE, sizeof(OzCorner), across);
    return oz_gl_check(gl, "preparing the container's buffer");
}

void oz_mesh_gl_free(OzMeshGl *mesh_gl)
{
    if (mesh_gl->gl) {
        mesh_gl->gl->DeleteProgram(mesh_gl->program);
        mesh_gl->gl->DeleteBuffers(1, &mesh_gl->buffer);
        mesh_gl->gl->DeleteVertexArrays(1, &mesh_gl->vertices);
    }
    memset(mesh_gl, 0, sizeof *mesh_gl);
}

void oz_mesh_gl_draw_solid(const OzMeshGl *mesh_gl, const OzMesh *mesh, const OzCamera *camera,
                           double width, double height)
{
    const OzGl *gl = mesh_gl->gl;
    if (!mesh->count) {
        return;
    }
    gl->UseProgram(mesh_gl->program);
    gl->Uniform4f(gl->GetUniformLocation(mesh_gl->program, "lens"),
                  (float)(2 * camera->scale / width), (float)(2 * camera->scale / height),
                  (float)camera->distance, (float)camera->depth);
    gl->BindVertexArray(mesh_gl->vertices);
    gl->BindBuffer(GL_ARRAY_BUFFER, mesh_gl->buffer);
    gl->BufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(mesh->count * sizeof *mesh->corners),
                   mesh->corners, GL_STREAM_DRAW);
    gl->DrawArrays(GL_TRIANGLES, 0, (GLsizei)mesh->count);
}

void oz_mesh_gl_draw_over(const OzMeshGl *mesh_gl, const OzMesh *mesh, const OzCamera *camera,
                          double width, double height)
{
    const OzGl *gl = mesh_gl->gl;
    gl->DepthMask(GL_FALSE);
    gl->Disable(GL_DEPTH_TEST);
    gl->Enable(GL_BLEND);
    gl->BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
    oz_mesh_gl_draw_solid(mesh_gl, mesh, camera, width, height);
    gl->Disable(GL_BLEND);
    gl->Enable(GL_DEPTH_TEST);
    gl->DepthMask(GL_TRUE);
}
