/* Lists of triangles by cells. */
#include "sim/mesh_pack.h"

#include "base/memory.h"
#include "base/stage.h"
#include "scene/wall_mesh.h"
#include "sim/scalars.h"
#include "sim/sides.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Cells of a grid at most: so many for each triangle, and some. Fewer cells are larger, with longer
 * lists. */
static const double cells_a_face = 8, cells_more = 4096;

/* Of more, a person is told when it lasts. */
enum { MANY_FACES = 100000 };

/* Grains reach that much farther than they do, in float. */
static const double margin = 1.001;

/* A mesh's grid. */
typedef struct Grid {
    const OzWallMesh *mesh;
    double low[3], cell, reach; /* m */
    int cells[3], count;
    int *first; /* count + 1 */
    int *face;
    int *found; /* cell and triangle of each entry, in the order of triangles, while it is made */
    int64_t entries, capacity;
} Grid;

static void choose_cells(Grid *grid, const OzWallMesh *mesh, double reach)
{
    double volume = 1, most = cells_a_face * mesh->count + cells_more;
    *grid = (Grid){.mesh = mesh, .reach = margin * reach};
    for (int k = 0; k < 3; k++) {
        grid->low[k] = mesh->low[k] - grid->reach;
        volume *= mesh->high[k] - mesh->low[k] + 2 * grid->reach;
    }
    grid->cell = fmax(grid->reach, cbrt(volume / most));
    grid->count = 1;
    for (int k = 0; k < 3; k++) {
        double size = mesh->high[k] - mesh->low[k] + 2 * grid->reach;
        grid->cells[k] = (int)floor(size / grid->cell) + 1;
        grid->count *= grid->cells[k];
    }
}

/* A triangle as seen from cells: its centre, how far its corners are from there, and a unit vector
 * across it, or none. */
typedef struct Face {
    int index;
    double centre[3], radius, normal[3];
} Face;

static Face face_of(const OzWallMesh *mesh, int index)
{
    const double *p = mesh->corners + 9 * (size_t)index;
    Face face = {.index = index};
    for (int k = 0; k < 3; k++) {
        face.centre[k] = (p[k] + p[3 + k] + p[6 + k]) / 3;
    }
    for (int c = 0; c < 3; c++) {
        double x = p[3 * c] - face.centre[0], y = p[3 * c + 1] - face.centre[1];
        double z = p[3 * c + 2] - face.centre[2];
        face.radius = fmax(face.radius, sqrt(x * x + y * y + z * z));
    }
    oz_mesh_edges_normal(p, face.normal);
    return face;
}

/* Whether a grain in a cell may touch a triangle: the cell's corners are so far from its middle.
 * Most cells are too far from its plane already, or are near enough to its centre. */
static bool reaches(const Grid *grid, const int at[3], const Face *face)
{
    double middle[3], nearest[3], off = 0, square = 0;
    double most = grid->reach + margin * sqrt(0.75) * grid->cell;
    for (int k = 0; k < 3; k++) {
        middle[k] = grid->low[k] + (at[k] + 0.5) * grid->cell;
        double away = middle[k] - face->centre[k];
        off += face->normal[k] * away;
        square += away * away;
    }
    if (fabs(off) > margin * most || sqrt(square) > margin * (most + face->radius)) {
        return false;
    }
    return sqrt(square) <= most ||
           oz_wall_mesh_face_distance(grid->mesh, face->index, middle, nearest) <= most;
}

/* Cells that a triangle's box reaches into. */
static void cells_of(const Grid *grid, int face, int from[3], int to[3])
{
    const double *p = grid->mesh->corners + 9 * (size_t)face;
    double more = grid->reach + 1e-3 * grid->cell;
    for (int k = 0; k < 3; k++) {
        double low = fmin(p[k], fmin(p[3 + k], p[6 + k])) - more;
        double high = fmax(p[k], fmax(p[3 + k], p[6 + k])) + more;
        from[k] = (int)fmax(0, floor((low - grid->low[k]) / grid->cell));
        to[k] = (int)fmin(grid->cells[k] - 1, floor((high - grid->low[k]) / grid->cell));
    }
}

/* Counts a triangle into its cells' entries after the next, and notes which they are. */
static OzStatus enter(Grid *grid, int index)
{
    int from[3], to[3], at[3];
    Face face = face_of(grid->mesh, index);
    cells_of(grid, index, from, to);
    for (at[2] = from[2]; at[2] <= to[2]; at[2]++) {
        for (at[1] = from[1]; at[1] <= to[1]; at[1]++) {
            for (at[0] = from[0]; at[0] <= to[0]; at[0]++) {
                int cell = (at[2] * grid->cells[1] + at[1]) * grid->cells[0] + at[0];
                if (!reaches(grid, at, &face)) {
                    continue;
                }
                OZ_PASS(oz_memory_room((void **)&grid->found, &grid->capacity,
                                       2 * grid->entries + 2, sizeof *grid->found,
                                       "triangles of cells"));
                grid->found[2 * grid->entries] = cell;
                grid->found[2 * grid->entries++ + 1] = index;
                grid->first[cell + 2]++;
            }
        }
    }
    return OZ_OK;
}

/* In the order of triangles within each cell. The caller frees first, face and found. */
static OzStatus sort(Grid *grid, const OzWallMesh *mesh, double reach)
{
    const int64_t most = 1000000000;
    choose_cells(grid, mesh, reach);
    OZ_PASS(OZ_NEW(&grid->first, grid->count + 2));
    for (int face = 0; face < mesh->count && grid->entries <= most; face++) {
        OZ_PASS(enter(grid, face));
    }
    for (int c = 2; c < grid->count + 2; c++) {
        grid->first[c] += grid->first[c - 1];
    }
    if (grid->entries > most || grid->count > 1 << 23) {
        return oz_status_fail(OZ_ERR_MEMORY,
                              "a mesh of %d triangles near %.3g m wide grains has %.3g entries in "
                              "%d cells; expected at most 1e9",
                              mesh->count, 2 * reach, (double)grid->entries, grid->count);
    }
    OZ_PASS(OZ_NEW(&grid->face, (size_t)grid->entries));
    for (int64_t entry = 0; entry < grid->entries; entry++) {
        grid->face[grid->first[grid->found[2 * entry] + 1]++] = grid->found[2 * entry + 1];
    }
    return OZ_OK;
}

/* The same; of many triangles it is told while it lasts. */
static OzStatus make(Grid *grid, const OzWallMesh *mesh, double reach)
{
    OzStage stage;
    bool is_large = mesh->count > MANY_FACES;
    if (is_large) {
        oz_stage_begin(&stage, "sorting %d triangles into cells", mesh->count);
    }
    OzStatus status = sort(grid, mesh, reach);
    if (is_large) {
        oz_stage_end(&stage);
    }
    return status;
}

static void release(Grid *grid)
{
    free(grid->first);
    free(grid->face);
    free(grid->found);
}

/* Meshes in the order of kernels' walls, which is the scene's. */
static const OzWall *mesh_wall(const OzScene *scene, int index)
{
    for (int w = 0; w < scene->wall_count; w++) {
        if (scene->walls[w].mesh && index-- == 0) {
            return &scene->walls[w];
        }
    }
    return NULL;
}

OzStatus oz_mesh_pack_sizes(OzSizes *sizes, const OzScene *scene, const OzParameters *parameters)
{
    OzStatus status = OZ_OK;
    const OzWall *wall;
    for (int m = 0; status == OZ_OK && (wall = mesh_wall(scene, m)) != NULL; m++) {
        Grid grid = {0};
        status = make(&grid, wall->mesh, parameters->reach_max + parameters->skin_most);
        if (status == OZ_OK) {
            sizes->mesh_faces += wall->mesh->count;
            sizes->mesh_cells += grid.count + 1;
            sizes->mesh_items += grid.first[grid.count];
        }
        release(&grid);
    }
    return status;
}

/* All arrays of a member while they are filled. */
typedef struct Upload {
    double *grid;
    void *records; /* as the device's words */
    bool is_double;
    int *first, *face;
    int faces, cells, items; /* so far */
} Upload;

/* A coordinate, in units: an integer's bits in single precision. */
static void put_place(Upload *to, size_t word, double units)
{
    if (to->is_double) {
        memcpy((double *)to->records + word, &units, sizeof units);
    } else {
        int32_t place = (int32_t)rint(units);
        memcpy((float *)to->records + word, &place, sizeof place);
    }
}

static void put_edge(Upload *to, size_t word, double length)
{
    char *at = (char *)to->records + word * oz_scalars_bytes(to->is_double);
    oz_scalars_put(at, &length, 1, to->is_double);
}

static void add_face(Upload *to, const OzWall *wall, const double corners[9], const OzParameters *p)
{
    size_t base = OZ_MESH_RECORD * (size_t)to->faces++;
    for (size_t k = 0; k < 3; k++) {
        put_place(to, base + OZ_MESH_R_CORNER + k, (wall->point[k] + corners[k]) / p->length_unit);
        put_edge(to, base + OZ_MESH_R_ONE + k, (corners[3 + k] - corners[k]) / p->units.length);
        put_edge(to, base + OZ_MESH_R_OTHER + k, (corners[6 + k] - corners[k]) / p->units.length);
    }
}

static OzStatus add(Upload *to, int index, const OzWall *wall, const OzParameters *p)
{
    Grid grid = {0};
    const OzWallMesh *mesh = wall->mesh;
    OzStatus status = make(&grid, mesh, p->reach_max + p->skin_most);
    double *words = to->grid + OZ_MESH_GRID * index, metre = 1 / p->units.length;
    for (int k = 0; k < 3; k++) {
        words[OZ_G_LOW + k] = grid.low[k] * metre;
        words[OZ_G_CELLS + k] = grid.cells[k];
    }
    words[OZ_G_INVERSE] = 1 / (grid.cell * metre);
    words[OZ_G_FIRST] = to->cells;
    words[OZ_G_CORNER] = to->faces;
    words[OZ_G_TWO_SIDED] = mesh->two_sided;
    words[OZ_G_SKIN] = p->skin_most * metre;
    for (int c = 0; status == OZ_OK && c <= grid.count; c++) {
        to->first[to->cells++] = to->items + grid.first[c];
    }
    for (int i = 0; status == OZ_OK && i < grid.first[grid.count]; i++) {
        to->face[to->items++] = grid.face[i];
    }
    for (int i = 0; i < mesh->count; i++) {
        add_face(to, wall, mesh->corners + 9 * (size_t)i, p);
    }
    release(&grid);
    return status;
}

/* No grain has a list of triangles any more. */
static OzStatus forget_lists(OzArrays *arrays, int member)
{
    OzStatus status = OZ_OK;
    size_t bytes = oz_arrays_bytes(arrays, OZ_FIELD_mesh_list);
    void *zeros = NULL;
    OZ_TRY(oz_memory_new(&zeros, bytes, 1, "lists of triangles"));
    OZ_TRY(oz_arrays_write(arrays, OZ_FIELD_mesh_list, member, zeros, bytes));
done:
    free(zeros);
    return status;
}

static OzStatus write_all(OzArrays *arrays, int member, const Upload *upload, int meshes)
{
    OZ_PASS(forget_lists(arrays, member));
    OZ_PASS(oz_arrays_write_scalars(arrays, OZ_FIELD_mesh_grid, member, upload->grid,
                                    (size_t)(meshes * OZ_MESH_GRID)));
    OZ_PASS(oz_arrays_write(arrays, OZ_FIELD_mesh_record, member, upload->records,
                            oz_arrays_bytes(arrays, OZ_FIELD_mesh_record)));
    OZ_PASS(oz_arrays_write(arrays, OZ_FIELD_mesh_first, member, upload->first,
                            oz_arrays_bytes(arrays, OZ_FIELD_mesh_first)));
    return oz_arrays_write(arrays, OZ_FIELD_mesh_face, member, upload->face,
                           oz_arrays_bytes(arrays, OZ_FIELD_mesh_face));
}

OzStatus oz_mesh_pack_write(OzArrays *arrays, int member, const OzScene *scene,
                            const OzParameters *parameters)
{
    OzStatus status = OZ_OK;
    const OzSizes *z = oz_rods_fields_sizes(arrays);
    int meshes = oz_rods_fields_switches(arrays)->meshes;
    Upload upload = {.is_double = oz_arrays_switches(arrays)->is_double};
    if (meshes == 0) {
        return OZ_OK;
    }
    OZ_TRY(OZ_NEW(&upload.grid, meshes * OZ_MESH_GRID));
    OZ_TRY(oz_memory_new(&upload.records, oz_arrays_bytes(arrays, OZ_FIELD_mesh_record), 1,
                         "triangles"));
    OZ_TRY(OZ_NEW(&upload.first, z->mesh_cells));
    OZ_TRY(OZ_NEW(&upload.face, z->mesh_items));
    for (int m = 0; m < meshes; m++) {
        OZ_TRY(add(&upload, m, mesh_wall(scene, m), parameters));
    }
    OZ_TRY(write_all(arrays, member, &upload, meshes));
done:
    free(upload.grid);
    free(upload.records);
    free(upload.first);
    free(upload.face);
    return status;
}
