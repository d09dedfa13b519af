/* Triangles in a grid. */
#include "scene/wall_mesh.h"

#include "base/file.h"
#include "base/memory.h"
#include "base/stage.h"
#include "scene/mesh_edges.h"
#include "scene/mesh_file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* Of a larger file, in bytes, a person is told when its reading lasts. */
enum { LARGE_FILE = 4000000 };

/* Cells for each triangle: a few triangles are in a cell then. */
static const double cells_a_face = 2;

static void cross(const double a[3], const double b[3], double to[3])
{
    for (int k = 0; k < 3; k++) {
        to[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
    }
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static uint64_t mix(uint64_t hash, const void *bytes, size_t count)
{
    const unsigned char *b = bytes;
    for (size_t k = 0; k < count; k++) {
        hash = (hash ^ b[k]) * 0x100000001b3; /* Fowler, Noll and Vo: FNV-1a */
    }
    return hash;
}

static void bound(OzWallMesh *mesh)
{
    for (int k = 0; k < 3; k++) {
        mesh->low[k] = INFINITY;
        mesh->high[k] = -INFINITY;
    }
    for (size_t c = 0; c < 3 * (size_t)mesh->count; c++) {
        const double *p = mesh->corners + 3 * c;
        for (int k = 0; k < 3; k++) {
            mesh->low[k] = fmin(mesh->low[k], p[k]);
            mesh->high[k] = fmax(mesh->high[k], p[k]);
        }
        mesh->reach = fmax(mesh->reach, sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]));
    }
}

/* Cells, all of one size, that a box reaches into. */
static void cells_of(const OzWallMesh *mesh, const double low[3], const double high[3], int from[3],
                     int to[3])
{
    for (int k = 0; k < 3; k++) {
        double most = mesh->cells[k] - 1;
        from[k] = (int)fmin(fmax(floor((low[k] - mesh->low[k]) / mesh->cell), 0), most);
        to[k] = (int)fmin(fmax(floor((high[k] - mesh->low[k]) / mesh->cell), 0), most);
    }
}

static void bounds_of_face(const OzWallMesh *mesh, int face, double low[3], double high[3])
{
    const double *p = mesh->corners + 9 * (size_t)face;
    for (int k = 0; k < 3; k++) {
        low[k] = fmin(p[k], fmin(p[3 + k], p[6 + k]));
        high[k] = fmax(p[k], fmax(p[3 + k], p[6 + k]));
    }
}

/* What is done with a cell of a box. */
typedef void (*CellVisit)(OzWallMesh *mesh, int cell, int face);

static void count_face(OzWallMesh *mesh, int cell, int face)
{
    (void)face;
    mesh->first[cell + 2]++;
}

static void put_face(OzWallMesh *mesh, int cell, int face)
{
    mesh->face[mesh->first[cell + 1]++] = face;
}

static void visit_faces(OzWallMesh *mesh, CellVisit visit)
{
    for (int face = 0; face < mesh->count; face++) {
        double low[3], high[3];
        int from[3], to[3];
        bounds_of_face(mesh, face, low, high);
        cells_of(mesh, low, high, from, to);
        for (int z = from[2]; z <= to[2]; z++) {
            for (int y = from[1]; y <= to[1]; y++) {
                for (int x = from[0]; x <= to[0]; x++) {
                    visit(mesh, (z * mesh->cells[1] + y) * mesh->cells[0] + x, face);
                }
            }
        }
    }
}

/* Cubes, of which all together are about so many as wanted. */
static OzStatus make_grid(OzWallMesh *mesh)
{
    double size[3], longest = 0, wanted = cells_a_face * mesh->count + 8;
    for (int k = 0; k < 3; k++) {
        size[k] = mesh->high[k] - mesh->low[k];
        longest = fmax(longest, size[k]);
    }
    int cells = 0;
    for (mesh->cell = longest; mesh->cell > 0; mesh->cell /= 1.25) {
        double all = 1;
        for (int k = 0; k < 3; k++) {
            all *= floor(size[k] / mesh->cell) + 1;
        }
        if (all > wanted) {
            break;
        }
    }
    mesh->cell *= 1.25;
    for (int k = 0; k < 3; k++) {
        mesh->cells[k] = (int)floor(size[k] / mesh->cell) + 1;
    }
    cells = mesh->cells[0] * mesh->cells[1] * mesh->cells[2];
    OZ_PASS(OZ_NEW(&mesh->first, cells + 2));
    visit_faces(mesh, count_face);
    for (int c = 2; c < cells + 2; c++) {
        mesh->first[c] += mesh->first[c - 1];
    }
    OZ_PASS(OZ_NEW(&mesh->face, mesh->first[cells + 1]));
    visit_faces(mesh, put_face);
    return OZ_OK;
}

/* Gauss's theorem. */
static double volume_of(const OzWallMesh *mesh)
{
    double sum = 0;
    for (int face = 0; face < mesh->count; face++) {
        const double *a = mesh->corners + 9 * (size_t)face, *b = a + 3, *c = a + 6;
        sum += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
               a[2] * (b[0] * c[1] - b[1] * c[0]);
    }
    return sum / 6;
}

static OzStatus fill(OzWallMesh *mesh, const char *path, double scale, bool two_sided)
{
    OzStatus status = OZ_OK;
    OzMeshFile file = {0};
    char *bytes = NULL;
    size_t length = 0;
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
    OZ_TRY(oz_file_read(&bytes, &length, path));
    OZ_TRY(oz_mesh_file_read(&file, name, bytes, length));
    mesh->hash = mix(mix(0xcbf29ce484222325, bytes, length), &scale, sizeof scale);
    mesh->hash = mix(mesh->hash, two_sided ? "2" : "1", 1);
    mesh->count = file.count;
    mesh->corners = file.corners;
    mesh->two_sided = two_sided;
    file.corners = NULL;
    for (size_t k = 0; k < 9 * (size_t)mesh->count; k++) {
        mesh->corners[k] *= scale;
    }
    bound(mesh);
    if (mesh->reach > 1e6) {
        status =
            oz_status_fail(OZ_ERR_INPUT, "%s: it reaches %g m; expected at most 1e6 m, by scale",
                           name, mesh->reach);
        goto done;
    }
    OZ_TRY(oz_mesh_edges_judge(&mesh->edges, mesh->corners, mesh->count));
    mesh->volume = volume_of(mesh);
    OZ_TRY(make_grid(mesh));
done:
    free(file.corners);
    free(bytes);
    return status;
}

/* A large file's reading is told of while it lasts. */
static OzStatus fill_patiently(OzWallMesh *mesh, const char *path, double scale, bool two_sided)
{
    OzStage stage;
    struct stat file = {0};
    bool is_large = stat(path, &file) == 0 && file.st_size > LARGE_FILE;
    if (is_large) {
        oz_stage_begin(&stage, "reading %s", path);
    }
    OzStatus status = fill(mesh, path, scale, two_sided);
    if (is_large) {
        oz_stage_end(&stage);
    }
    return status;
}

OzStatus oz_wall_mesh_load(OzWallMesh **mesh, const char *path, double scale, bool two_sided)
{
    OZ_PASS(OZ_NEW(mesh, 1));
    (*mesh)->users = 1;
    OzStatus status = fill_patiently(*mesh, path, scale, two_sided);
    if (status != OZ_OK) {
        oz_wall_mesh_drop(*mesh);
        *mesh = NULL;
    }
    return status;
}

void oz_wall_mesh_share(OzWallMesh *mesh)
{
    if (mesh) {
        __atomic_add_fetch(&mesh->users, 1, __ATOMIC_RELAXED);
    }
}

void oz_wall_mesh_drop(OzWallMesh *mesh)
{
    if (mesh && __atomic_sub_fetch(&mesh->users, 1, __ATOMIC_ACQ_REL) == 0) {
        free(mesh->corners);
        free(mesh->edges.creases);
        free(mesh->first);
        free(mesh->face);
        free(mesh);
    }
}

static int compare_ints(const void *a, const void *b)
{
    int one = *(const int *)a, other = *(const int *)b;
    return (one > other) - (one < other);
}

/* Whether two boxes meet. */
static bool boxes_meet(const double low[3], const double high[3], const double other_low[3],
                       const double other_high[3])
{
    bool meet = true;
    for (int k = 0; k < 3; k++) {
        meet &= low[k] <= other_high[k] && other_low[k] <= high[k];
    }
    return meet;
}

/* Adds a cell's triangles that reach into the box. */
static OzStatus add_cell(const OzWallMesh *mesh, int cell, const double low[3],
                         const double high[3], int **faces, int *count, int64_t *capacity)
{
    int begin = mesh->first[cell], end = mesh->first[cell + 1];
    OZ_PASS(OZ_ROOM(faces, capacity, *count + end - begin, "triangles"));
    for (int k = begin; k < end; k++) {
        double own_low[3], own_high[3];
        bounds_of_face(mesh, mesh->face[k], own_low, own_high);
        if (boxes_meet(low, high, own_low, own_high)) {
            (*faces)[(*count)++] = mesh->face[k];
        }
    }
    return OZ_OK;
}

static int sort_once(int *faces, int count)
{
    int kept = 0;
    qsort(faces, (size_t)count, sizeof *faces, compare_ints);
    for (int k = 0; k < count; k++) {
        if (kept == 0 || faces[k] != faces[kept - 1]) {
            faces[kept++] = faces[k];
        }
    }
    return kept;
}

OzStatus oz_wall_mesh_near(const OzWallMesh *mesh, const double low[3], const double high[3],
                           int **faces, int *count)
{
    int from[3], to[3];
    int64_t capacity = 0;
    *faces = NULL;
    *count = 0;
    if (!boxes_meet(low, high, mesh->low, mesh->high)) {
        return OZ_OK;
    }
    cells_of(mesh, low, high, from, to);
    for (int z = from[2]; z <= to[2]; z++) {
        for (int y = from[1]; y <= to[1]; y++) {
            for (int x = from[0]; x <= to[0]; x++) {
                int cell = (z * mesh->cells[1] + y) * mesh->cells[0] + x;
                OZ_PASS(add_cell(mesh, cell, low, high, faces, count, &capacity));
            }
        }
    }
    *count = *count > 0 ? sort_once(*faces, *count) : 0;
    return OZ_OK;
}

/* Of a segment from a, along it; both in m. */
static double on_segment(const double a[3], const double along[3], const double point[3],
                         double nearest[3])
{
    double dot = 0, length2 = 0, distance2 = 0;
    for (int k = 0; k < 3; k++) {
        dot += (point[k] - a[k]) * along[k];
        length2 += along[k] * along[k];
    }
    double share = fmin(fmax(dot / length2, 0), 1);
    for (int k = 0; k < 3; k++) {
        nearest[k] = a[k] + share * along[k];
        distance2 += (point[k] - nearest[k]) * (point[k] - nearest[k]);
    }
    return distance2;
}

double oz_wall_mesh_face_distance(const OzWallMesh *mesh, int face, const double point[3],
                                  double nearest[3])
{
    const double *p = mesh->corners + 9 * (size_t)face;
    double edges[3][3], normal[3], from[3], least = INFINITY;
    for (int e = 0; e < 3; e++) {
        for (int k = 0; k < 3; k++) {
            edges[e][k] = p[3 * ((e + 1) % 3) + k] - p[3 * e + k];
        }
    }
    cross(edges[0], edges[1], normal);
    bool within = true;
    for (int e = 0; e < 3; e++) {
        double inwards[3], at[3];
        cross(normal, edges[e], inwards);
        for (int k = 0; k < 3; k++) {
            from[k] = point[k] - p[3 * e + k];
        }
        within &= dot(from, inwards) > 0;
        double distance2 = on_segment(p + 3 * e, edges[e], point, at);
        if (distance2 < least) {
            least = distance2;
            memcpy(nearest, at, sizeof at);
        }
    }
    if (within) {
        double high = dot(from, normal) / dot(normal, normal);
        for (int k = 0; k < 3; k++) {
            nearest[k] = point[k] - high * normal[k];
        }
        return fabs(high) * sqrt(dot(normal, normal));
    }
    return sqrt(least);
}

double oz_wall_mesh_distance(const OzWallMesh *mesh, const double point[3], double normal[3])
{
    double outside = 0, found = INFINITY, best[3] = {0};
    for (int k = 0; k < 3; k++) {
        double gap = fmax(0, fmax(mesh->low[k] - point[k], point[k] - mesh->high[k]));
        outside += gap * gap;
    }
    for (double size = sqrt(outside) + mesh->cell; !(found <= size); size *= 2) {
        double low[3], high[3];
        int *faces = NULL, count = 0;
        for (int k = 0; k < 3; k++) {
            low[k] = point[k] - size;
            high[k] = point[k] + size;
        }
        if (oz_wall_mesh_near(mesh, low, high, &faces, &count) != OZ_OK) {
            count = 0;
        }
        for (int i = 0; i < count; i++) {
            double at[3], distance = oz_wall_mesh_face_distance(mesh, faces[i], point, at);
            if (distance < found) {
                found = distance;
                memcpy(best, at, sizeof at);
            }
        }
        free(faces);
    }
    for (int k = 0; normal && k < 3; k++) {
        normal[k] = found > 0 ? (point[k] - best[k]) / found : k == 2;
    }
    return found;
}

/* Whether a triangle lies over a point, seen along z. */
static bool is_over(const double *p, const double point[3])
{
    double area[3], sum = 0, high = 0;
    for (int e = 0; e < 3; e++) {
        const double *a = p + 3 * ((e + 1) % 3), *b = p + 3 * ((e + 2) % 3);
        area[e] = (a[0] - point[0]) * (b[1] - point[1]) - (a[1] - point[1]) * (b[0] - point[0]);
        sum += area[e];
        high += area[e] * p[3 * e + 2];
    }
    bool one = area[0] > 0 && area[1] > 0 && area[2] > 0;
    bool other = area[0] < 0 && area[1] < 0 && area[2] < 0;
    return (one || other) && high / sum > point[2];
}

bool oz_wall_mesh_encloses(const OzWallMesh *mesh, const double point[3])
{
    /* off the edges of whoever draws with round numbers */
    double aside = 1e-7 * mesh->cell,
           at[3] = {point[0] + 0.618 * aside, point[1] + 0.414 * aside, point[2]};
    double low[3] = {at[0], at[1], at[2]}, high[3] = {at[0], at[1], mesh->high[2]};
    int *faces = NULL, count = 0, crossed = 0;
    if (!mesh->edges.closed || !(point[2] <= mesh->high[2]) ||
        oz_wall_mesh_near(mesh, low, high, &faces, &count) != OZ_OK) {
        count = 0;
    }
    for (int i = 0; i < count; i++) {
        crossed += is_over(mesh->corners + 9 * (size_t)faces[i], at);
    }
    free(faces);
    return crossed % 2 == 1;
}

bool oz_wall_mesh_is_vessel(const OzWallMesh *mesh)
{
    return mesh->edges.closed && (mesh->two_sided || mesh->volume < 0);
}
