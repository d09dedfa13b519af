/* The triangles of a wall `kind: mesh`, at rest and seen from the wall's point, with a uniform grid
 * over them. Loaded once and shared by all copies of a scene. */
#pragma once

#include "scene/mesh_edges.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct OzWallMesh {
    int count;       /* triangles                                                       */
    double *corners; /* m, nine a triangle                                              */
    double low[3], high[3];
    double reach; /* m, of the farthest corner from the wall's point                 */
    OzMeshEdges edges;
    bool two_sided; /* grains touch it from behind, too                                */
    double volume;  /* m^3, enclosed by a closed one; < 0 where fronts are inside      */
    uint64_t hash;  /* of the file, the scale and two_sided                            */
    double cell;    /* m, of the grid, which begins at low                             */
    int cells[3];
    int *first, *face; /* triangles that may reach into cell c: face[first[c]] and on     */
    int users;         /* scenes that hold it: oz_wall_mesh_share, oz_wall_mesh_drop      */
} OzWallMesh;

/* Reads a file of triangles, each number times scale in m. The caller drops the mesh. Fails as
 * oz_mesh_file_read does, or with OZ_ERR_FILE. */
OzStatus oz_wall_mesh_load(OzWallMesh **mesh, const char *path, double scale, bool two_sided);

/* One more holder, or one less, any thread; NULL is fine. The last one frees it. */
void oz_wall_mesh_share(OzWallMesh *mesh);
void oz_wall_mesh_drop(OzWallMesh *mesh);

/* Triangles that may reach into a box (m, seen from the wall's point), in their order, each once:
 * *faces, which the caller frees, and their number. */
OzStatus oz_wall_mesh_near(const OzWallMesh *mesh, const double low[3], const double high[3],
                           int **faces, int *count);

/* The distance of a point (seen from the wall's point) from one triangle, and the nearest point. */
double oz_wall_mesh_face_distance(const OzWallMesh *mesh, int face, const double point[3],
                                  double nearest[3]);

/* The distance of a point from the nearest triangle, m, > 0 on both sides; normal, unless NULL,
 * receives the unit vector from there. */
double oz_wall_mesh_distance(const OzWallMesh *mesh, const double point[3], double normal[3]);

/* Whether a point is enclosed by a closed mesh. */
bool oz_wall_mesh_encloses(const OzWallMesh *mesh, const double point[3]);

/* Whether grains are put inside of it: closed, and its fronts are there, or both sides are. */
bool oz_wall_mesh_is_vessel(const OzWallMesh *mesh);
