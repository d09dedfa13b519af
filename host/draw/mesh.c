/* Growing a mesh. Knows nothing of what it shows, and no GL. */
#include "draw/mesh.h"

#include "base/memory.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

void oz_mesh_clear(OzMesh *mesh)
{
    mesh->count = 0;
    mesh->status = OZ_OK;
}

void oz_mesh_free(OzMesh *mesh)
{
    free(mesh->corners);
    memset(mesh, 0, sizeof *mesh);
}

static void add_corner(OzMesh *mesh, const double view[3], const float rgba[4],
                       const double across[2])
{
    if (mesh->status == OZ_OK && mesh->count == mesh->capacity) {
        size_t wanted = mesh->capacity ? 2 * mesh->capacity : 2048;
        mesh->status = oz_memory_grow((void **)&mesh->corners, mesh->capacity, wanted,
                                      sizeof *mesh->corners, "container mesh");
        mesh->capacity = mesh->status == OZ_OK ? wanted : mesh->capacity;
    }
    if (mesh->status == OZ_OK) {
        OzCorner *corner = &mesh->corners[mesh->count++];
        for (int i = 0; i < 3; i++) {
            corner->place[i] = (float)view[i];
        }
        memcpy(corner->rgba, rgba, sizeof corner->rgba);
        corner->across[0] = (float)across[0];
        corner->across[1] = (float)across[1];
    }
}

void oz_mesh_corner(OzMesh *mesh, const double view[3], const float rgba[4])
{
    add_corner(mesh, view, rgba, (const double[2]){0, 1e4});
}

static const int order[6] = {0, 1, 2, 0, 2, 3}; /* of a quad's corners in two triangles */

void oz_mesh_quad(OzMesh *mesh, double view[4][3], const float first_rgba[4],
                  const float second_rgba[4])
{
    for (int i = 0; i < 6; i++) {
        oz_mesh_corner(mesh, view[order[i]], order[i] < 2 ? first_rgba : second_rgba);
    }
}

void oz_mesh_line(OzMesh *mesh, const OzCamera *camera, const double from[3], const double to[3],
                  double width, const float rgba[4])
{
    double ends[2][3], corners[4][3];
    oz_camera_see(camera, from, ends[0]);
    oz_camera_see(camera, to, ends[1]);
    double along[2] = {ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]};
    double length = hypot(along[0], along[1]);
    if (!(length > 1e-9)) {
        return;
    }
    double rim = 0.5 * width + 0.5; /* pixels: where the line has faded away */
    double half = rim / camera->scale / length;
    for (int i = 0; i < 4; i++) {
        double side = i == 0 || i == 3 ? half : -half;
        memcpy(corners[i], ends[i / 2], sizeof corners[i]);
        corners[i][0] -= side * along[1];
        corners[i][1] += side * along[0];
    }
    for (int i = 0; i < 6; i++) {
        bool first = order[i] == 0 || order[i] == 3;
        add_corner(mesh, corners[order[i]], rgba,
                   (const double[2]){first ? rim : -rim, 0.5 * width});
    }
}
