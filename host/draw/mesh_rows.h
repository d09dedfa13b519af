/* A mesh's triangles painted row by row on the host, as shaders/mesh.glsl and OpenGL would: a pixel
 * belongs to the triangle in which its middle lies, and to one alone of those that share an edge.
 */
#pragma once

#include "draw/drawn.h"
#include "draw/mesh.h"

typedef enum OzMeshUse {
    OZ_MESH_SOLID, /* where it is nearer than what is there, with its depth */
    OZ_MESH_OVER,  /* over what is there, by its alpha, leaving depth and outline_code */
    OZ_MESH_LAYER  /* the same without depth, counting in the fourth byte how much it hides */
} OzMeshUse;

/* Into the planes of the panel's view. */
void oz_mesh_rows_paint(const OzDrawn *drawn, const OzMesh *mesh, const OzCamera *camera,
                        const OzLook *look, int panel, OzMeshUse use);

/* The pixels of the panel that hold all of a mesh. */
OzBox oz_mesh_rows_box(const OzMesh *mesh, const OzCamera *camera, const OzLook *look, int panel);
