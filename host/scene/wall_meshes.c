/* Meshes of walls. */
#include "scene/wall_meshes.h"

#include "base/file.h"
#include "scene/wall_mesh.h"

#include <stdio.h>

OzStatus oz_wall_meshes_load(OzScene *scene, const OzScene *running, OzNode *root, OzFaults *faults)
{
    for (int w = 0; w < scene->wall_count; w++) {
        OzWall *wall = &scene->walls[w];
        if (wall->kind != OZ_WALL_MESH || !wall->path || !(wall->scale > 0) ||
            !oz_file_exists(wall->path)) {
            continue; /* which was said before */
        }
        char path[64];
        snprintf(path, sizeof path, "walls.%d.path", w);
        OzStatus status = oz_wall_mesh_load(&wall->mesh, wall->path, wall->scale, wall->two_sided);
        if (status == OZ_ERR_MEMORY) {
            return status;
        }
        const OzWall *before = running && w < running->wall_count ? &running->walls[w] : NULL;
        if (status != OZ_OK) {
            oz_tree_fault(root, faults, path, "%s", oz_status_text());
        } else if (before && before->mesh && before->mesh->hash != wall->mesh->hash) {
            oz_tree_fault(root, faults, path,
                          "%s has changed since the run began; expected the same triangles",
                          wall->path);
        }
    }
    return OZ_OK;
}

void oz_wall_meshes_share(OzScene *scene)
{
    for (int w = 0; w < scene->wall_count; w++) {
        oz_wall_mesh_share(scene->walls[w].mesh);
    }
}

void oz_wall_meshes_drop(OzScene *scene)
{
    for (int w = 0; w < scene->wall_count; w++) {
        oz_wall_mesh_drop(scene->walls[w].mesh);
    }
}
