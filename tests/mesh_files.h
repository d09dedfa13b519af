/* Meshes of tests: written into a folder of their own, which goes with the program. */
#ifndef OZ_TESTS_MESH_FILES_H
#define OZ_TESTS_MESH_FILES_H

#include "base/random.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char mesh_folder[] = "/tmp/orzo_meshes_XXXXXX";
static char mesh_paths[16][64];
static int mesh_count;

static inline void remove_meshes(void)
{
    for (int i = 0; i < mesh_count; i++) {
        unlink(mesh_paths[i]);
    }
    rmdir(mesh_folder);
}

/* A file to write, whose path is mesh_paths[mesh_count - 1] from then on. */
static inline FILE *new_mesh(const char *ending)
{
    if (mesh_count == 0) {
        assert_non_null(mkdtemp(mesh_folder));
        atexit(remove_meshes);
    }
    assert_true(mesh_count < 16);
    snprintf(mesh_paths[mesh_count], sizeof mesh_paths[0], "%s/%d.%s", mesh_folder, mesh_count,
             ending);
    FILE *file = fopen(mesh_paths[mesh_count++], "wb");
    assert_non_null(file);
    return file;
}

static inline const char *mesh_of_text(const char *text, const char *ending)
{
    FILE *file = new_mesh(ending);
    fputs(text, file);
    fclose(file);
    return mesh_paths[mesh_count - 1];
}

/* The middle of the floor's corner (i, j), mm; inner ones are moved about within their plane. */
static inline void floor_corner(int i, int j, int cells, double size, float to[3])
{
    OzRandom random = oz_random_stream(11, (uint64_t)(1000 * i + j));
    double cell = size / cells, x = oz_random_uniform(&random, -0.25, 0.25) * cell;
    double y = oz_random_uniform(&random, -0.25, 0.25) * cell;
    to[0] = (float)(i * cell - size / 2 + (i > 0 && i < cells ? x : 0));
    to[1] = (float)(j * cell - size / 2 + (j > 0 && j < cells ? y : 0));
    to[2] = 0;
}

/* A binary STL, in mm: a level square of so many cells each way, two triangles each, of all shapes.
 */
static inline const char *mesh_floor(int cells, double size)
{
    FILE *file = new_mesh("stl");
    char head[80] = "a floor";
    uint32_t count = 2 * (uint32_t)(cells * cells);
    fwrite(head, 1, sizeof head, file);
    fwrite(&count, sizeof count, 1, file);
    for (int k = 0; k < 2 * cells * cells; k++) {
        int i = k / 2 % cells, j = k / 2 / cells, other = (i * 7 + j * 3) % 5 < 2;
        static const int corners[2][2][3] = {{{0, 1, 2}, {0, 2, 3}}, {{0, 1, 3}, {1, 2, 3}}};
        float words[12] = {0, 0, 1};
        uint16_t none = 0;
        for (int c = 0; c < 3; c++) {
            int corner = corners[other][k % 2][c];
            floor_corner(i + (corner == 1 || corner == 2), j + (corner > 1), cells, size,
                         words + 3 + 3 * c);
        }
        fwrite(words, sizeof words, 1, file);
        fwrite(&none, sizeof none, 1, file);
    }
    fclose(file);
    return mesh_paths[mesh_count - 1];
}

/* A box from -1 to 1, fronts inside. */
static const char mesh_box[] = "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\n"
                               "v -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n"
                               "f 1 2 3 4\nf 8 7 6 5\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n";

/* The same with one corner a little further in. */
static const char mesh_moved[] =
    "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\n"
    "v -1 -1 1\nv 1 -1 1\nv 0.9 1 1\nv -1 1 1\n"
    "f 1 2 3 4\nf 8 7 6 5\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n";

/* A fence that stands in the box. */
static const char mesh_fence[] = "v -2 0 -2\nv 0 0.3 -2\nv 0 0.3 0\nv -2 0 0\nf 1 2 3 4\n";

/* A crowd in both, which turn: precision, box, fence. */
static const char mesh_crowd[] =
    "model: rods\nprecision: %s\ntime: {step: 1e-5, duration: 1}\nintegrator: velocity-verlet\n"
    "observe: {ledger: true}\n"
    "contact: {contact_time: 3e-4, restitution: 0.5, friction: 0.4}\ngrains:\n"
    "  - {kind: random, count: 50, diameter: 0.6e-3, aspect: 2, fill: 0.2}\n"
    "  - {kind: random, count: 20, diameter: 0.6e-3, fill: 0.2}\n"
    "walls:\n"
    "  - {kind: mesh, path: '%s', scale: 2.5e-3, point: [0, 0, 1e-3],"
    " motion: {direction: [1, 0, 1], frequency: 200, amplitude: 1e-4, angular_velocity: 70,"
    " axis: [1, 2, -2]}}\n"
    "  - {kind: mesh, path: '%s', scale: 1e-3, point: [0, 0, 1e-3], two_sided: true,"
    " motion: {angular_velocity: -90, axis: [0, 1, 0], point: [0.3e-3, 0, 1e-3]}}\n"
    "  - {kind: rectangle, point: [1e-3, 0.8e-3, 1e-3], normal: [0, 1, 0], size: [2e-3, 1e-3],"
    " motion: {angular_velocity: 80, point: [0, 0, 0]}}\n";

#endif
