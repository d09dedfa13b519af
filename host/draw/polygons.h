/* Flat grains and walls on the GPU: filled triangles and discs, their outlines and beams, laid over
 * each other in the order in which they are added. */
#pragma once

#include "draw/camera.h"
#include "draw/gl.h"
#include "draw/pressed.h"

#include <stddef.h>

/* A corner of a triangle as the vertex shader reads it. */
typedef struct OzPolygonCorner {
    GLfloat place[2]; /* view coordinates                                                */
    GLfloat rgba[4];
    GLfloat ink[3];    /* of the outline                                                  */
    GLfloat inside[3]; /* pixels from each edge that has an outline, far for the others  */
} OzPolygonCorner;

typedef struct OzPolygons {
    const OzGl *gl; /* borrowed */
    GLuint program, vertices, buffer;
    OzPolygonCorner *corners; /* three for each triangle           */
    size_t count, capacity;
    OzPressed pressed; /* of the state added last       */
    OzStatus status;   /* remembers that memory ran out */
} OzPolygons;

/* Needs a current context; polygons is zeroed or filled, ready for oz_polygons_free. */
OzStatus oz_polygons_create(OzPolygons *polygons, const OzGl *gl, const char *source_dir);
void oz_polygons_free(OzPolygons *polygons);

/* Empties the picture, keeping its memory. */
void oz_polygons_clear(OzPolygons *polygons);

/* The walls that are there at the snapshot's time. */
void oz_polygons_add_walls(OzPolygons *polygons, const OzSnapshot *snapshot, const OzLook *look,
                           const OzCamera *camera);

/* The grains in the look's colours, and their beams if it shows them; presence: 1 is opaque, less
 * lets through what was added before. The first triangle of a grain of two to four is darker, and a
 * disc has a line along a radius, so that turning is seen. */
void oz_polygons_add_grains(OzPolygons *polygons, const OzSnapshot *snapshot, const OzLook *look,
                            const OzCamera *camera, double presence);

/* The chains of the state whose grains were added last, if the look has them. */
void oz_polygons_add_chains(OzPolygons *polygons, const OzSnapshot *snapshot, const OzLook *look,
                            const OzCamera *camera);

/* Draws what was added into the current viewport of the given width and height, pixels. */
OzStatus oz_polygons_draw(const OzPolygons *polygons, const OzLook *look, const OzCamera *camera,
                          double viewport_width, double viewport_height);
