/* VTK: polygonal data by frame of grains (points of rods and spheres, polygons of flat grains), of
 * walls, and of contacts where they were kept (lines between centres, or to the point on a wall),
 * each with a .pvd that names its files with their times. */
#include "base/folder.h"
#include "base/memory.h"
#include "export/format.h"
#include "export/grain_columns.h"
#include "export/part_file.h"
#include "export/surface.h"
#include "export/vtk_file.h"
#include "export/vtk_index.h"

#include <stdlib.h>
#include <string.h>

enum { ARRAYS_MOST = 16 };

typedef enum Kind { GRAINS, CONTACTS, WALLS, KINDS } Kind;
static const char *const KIND_NAMES[] = {
    [GRAINS] = "grains", [CONTACTS] = "contacts", [WALLS] = "walls"};

typedef struct Writer {
    const OzExport *target;
    int64_t number;     /* of the next frame          */
    FILE *index[KINDS]; /* .pvd, at the end of its entries; NULL: not begun yet */
} Writer;

static const char PART[] = "vtk.part";

/* The arrays of one file. */
typedef struct Arrays {
    OzVtkArray array[ARRAYS_MOST];
    float *data[ARRAYS_MOST]; /* owned */
    int count;
} Arrays;

static void free_arrays(Arrays *arrays)
{
    for (int k = 0; k < arrays->count; k++) {
        free(arrays->data[k]);
    }
}

/* A further array, zeroed, for the caller to fill. */
static OzStatus add_array(Arrays *arrays, const char *name, int width, int64_t rows, float **data)
{
    OZ_PASS(OZ_NEW(&arrays->data[arrays->count], rows * width));
    *data = arrays->data[arrays->count];
    arrays->array[arrays->count++] = (OzVtkArray){name, width, *data};
    return OZ_OK;
}

static OzStatus begin_index(Writer *writer, Kind kind)
{
    char name[64];
    snprintf(name, sizeof name, "%s.pvd", KIND_NAMES[kind]);
    return oz_vtk_index_create(&writer->index[kind], writer->target->folder, name);
}

static OzStatus write_file(Writer *writer, Kind kind, const OzVtkFile *vtk)
{
    char name[64];
    FILE *file = NULL;
    if (!writer->index[kind]) {
        OZ_PASS(begin_index(writer, kind));
    }
    snprintf(name, sizeof name, "%s_%05lld.vtp", KIND_NAMES[kind], (long long)writer->number);
    OZ_PASS(oz_part_file_create(&file, writer->target->folder, PART));
    oz_vtk_file_write(vtk, file);
    OZ_PASS(oz_part_file_place(file, writer->target->folder, PART, name));
    return oz_vtk_index_add(writer->index[kind], vtk->time, name);
}

/* Every column of grains but their position; row i is of the grain owner[i], without one of i. */
static OzStatus add_columns(Arrays *arrays, const OzSnapshot *now, const int64_t *owner,
                            int64_t rows)
{
    for (const OzGrainColumn *c = oz_grain_columns_all(); c->name; c++) {
        double values[OZ_GRAIN_COLUMN_WIDTH];
        float *data = NULL;
        if (!oz_grain_columns_serves(c, now) || strcmp(c->name, "position") == 0) {
            continue;
        }
        OZ_PASS(add_array(arrays, c->name, c->width, rows, &data));
        for (int64_t i = 0; i < rows; i++) {
            c->fill(now, owner ? owner[i] : i, values);
            for (int k = 0; k < c->width; k++) {
                data[i * c->width + k] = (float)values[k];
            }
        }
    }
    return OZ_OK;
}

/* Cells of `each` points, one after the other: what is said of them is said of each point where
 * that is the whole cell. */
static OzStatus write_cells(Writer *writer, Kind kind, double time, int each, int64_t count,
                            const float *points, const Arrays *arrays)
{
    OzStatus status = OZ_OK;
    int64_t *corners = NULL, *ends = NULL;
    OzVtkFile vtk = {.time = time,
                     .points = points,
                     .point_count = each * count,
                     .cells = each == 1 ? OZ_VTK_VERTICES : OZ_VTK_LINES,
                     .cell_count = count};
    *(each == 1 ? &vtk.point_arrays : &vtk.cell_arrays) = arrays->array;
    *(each == 1 ? &vtk.point_array_count : &vtk.cell_array_count) = arrays->count;
    OZ_TRY(OZ_NEW(&corners, each * count));
    OZ_TRY(OZ_NEW(&ends, count));
    for (int64_t i = 0; i < each * count; i++) {
        corners[i] = i;
        ends[i / each] = i + 1;
    }
    vtk.corners = corners;
    vtk.ends = ends;
    OZ_TRY(write_file(writer, kind, &vtk));
done:
    free(corners);
    free(ends);
    return status;
}

static OzStatus write_rods(Writer *writer, const OzSnapshot *now)
{
    OzStatus status = OZ_OK;
    Arrays arrays = {0};
    float *points = NULL;
    OZ_TRY(OZ_NEW(&points, 3 * now->count));
    OZ_TRY(add_columns(&arrays, now, NULL, now->count));
    for (int64_t i = 0; i < 3 * now->count; i++) {
        points[i] = (float)now->position[i];
    }
    OZ_TRY(write_cells(writer, GRAINS, now->time, 1, now->count, points, &arrays));
done:
    free_arrays(&arrays);
    free(points);
    return status;
}

static OzStatus write_surface(Writer *writer, Kind kind, double time, const OzSurface *s,
                              const Arrays *arrays)
{
    return write_file(writer, kind,
                      &(OzVtkFile){.time = time,
                                   .points = s->points,
                                   .point_count = s->point_count,
                                   .cells = OZ_VTK_POLYGONS,
                                   .corners = s->corners,
                                   .ends = s->ends,
                                   .cell_count = s->cell_count,
                                   .cell_arrays = arrays->array,
                                   .cell_array_count = arrays->count});
}

static OzStatus write_flat(Writer *writer, const OzSnapshot *now)
{
    OzStatus status = OZ_OK;
    OzSurface surface = {0};
    Arrays arrays = {0};
    OZ_TRY(oz_surface_add_flat_grains(&surface, now));
    OZ_TRY(add_columns(&arrays, now, surface.owner, surface.cell_count));
    OZ_TRY(write_surface(writer, GRAINS, now->time, &surface, &arrays));
done:
    oz_surface_free(&surface);
    free_arrays(&arrays);
    return status;
}

static OzStatus write_walls(Writer *writer, const OzSnapshot *now)
{
    OzStatus status = OZ_OK;
    OzSurface surface = {0};
    Arrays arrays = {0};
    float *number = NULL;
    OZ_TRY(oz_surface_add_walls(&surface, now));
    OZ_TRY(add_array(&arrays, "wall", 1, surface.cell_count, &number));
    for (int64_t i = 0; i < surface.cell_count; i++) {
        number[i] = (float)surface.owner[i];
    }
    OZ_TRY(write_surface(writer, WALLS, now->time, &surface, &arrays));
done:
    oz_surface_free(&surface);
    free_arrays(&arrays);
    return status;
}

/* THE list of what is said of a contact: X(name, width, value k of entry e). */
#define CONTACT_ARRAYS(X)                                                                          \
    X(a, 1, (double)e->a)                                                                          \
    X(b, 1, (double)e->b)                                                                          \
    X(normal, 3, e->normal[k])                                                                     \
    X(point, 3, e->point[k])                                                                       \
    X(overlap, 1, e->overlap)                                                                      \
    X(fn, 1, e->push)                                                                              \
    X(ft, 3, e->tangential[k])                                                                     \
    X(force, 3, e->push * e->normal[k] + e->tangential[k])                                         \
    X(slips, 1, (double)e->slips)

static OzStatus add_contact_arrays(Arrays *arrays, const OzContactList *list)
{
    float *data = NULL;
#define FILL(name, width, value)                                                                   \
    OZ_PASS(add_array(arrays, #name, width, list->count, &data));                                  \
    for (int64_t i = 0; i < list->count; i++) {                                                    \
        const OzContactEntry *e = &list->entry[i];                                                 \
        for (int k = 0; k < (width); k++) {                                                        \
            data[i * (width) + k] = (float)(value);                                                \
        }                                                                                          \
    }
    CONTACT_ARRAYS(FILL)
#undef FILL
    return OZ_OK;
}

/* Lines between both ends of every contact: the centre of a; the centre of b, or the point on the
 * wall. */
static OzStatus write_contacts(Writer *writer, const OzSnapshot *now)
{
    OzStatus status = OZ_OK;
    Arrays arrays = {0};
    float *points = NULL;
    int64_t count = now->contacts.count;
    OZ_TRY(OZ_NEW(&points, 6 * count));
    OZ_TRY(add_contact_arrays(&arrays, &now->contacts));
    for (int64_t i = 0; i < count; i++) {
        const OzContactEntry *e = &now->contacts.entry[i];
        const double *to = e->b >= 0 ? &now->position[3 * e->b] : e->point;
        for (int k = 0; k < 3; k++) {
            points[6 * i + k] = (float)now->position[3 * e->a + k];
            points[6 * i + 3 + k] = (float)to[k];
        }
    }
    OZ_TRY(write_cells(writer, CONTACTS, now->time, 2, count, points, &arrays));
done:
    free_arrays(&arrays);
    free(points);
    return status;
}

static OzStatus open_vtk(void **data, const OzExport *target)
{
    Writer *writer = NULL;
    OZ_PASS(OZ_NEW(&writer, 1));
    *data = writer;
    writer->target = target;
    return OZ_OK;
}

static OzStatus add_vtk(void *data, const OzSnapshot *now)
{
    Writer *writer = (Writer *)data;
    OZ_PASS((now->grains->elements ? write_flat : write_rods)(writer, now));
    if (now->has_contacts) {
        OZ_PASS(write_contacts(writer, now));
    }
    if (now->scene->wall_count > 0) {
        OZ_PASS(write_walls(writer, now));
    }
    writer->number++;
    return OZ_OK;
}

static OzStatus finish_vtk(void *data)
{
    Writer *writer = (Writer *)data;
    OzStatus status = OZ_OK;
    for (int k = 0; writer && k < KINDS; k++) {
        if (writer->index[k]) {
            OZ_AFTER(status, oz_folder_finish_file(writer->index[k], KIND_NAMES[k]));
        }
    }
    free(writer);
    return status;
}

const OzExportFormat oz_export_vtk_format = {
    "vtk", {"*.vtp", "*.pvd", PART}, open_vtk, add_vtk, finish_vtk};
