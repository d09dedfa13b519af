/* H5MD 1.1 (de Buyl, Colberg & Hoefling 2014): one HDF5 file. /particles/grains holds, by grain id,
 * every column of export/grain_columns.h: those of time as groups of value, step and time, the
 * others as plain datasets. There is no box: boundaries are "none". */
#include "base/file.h"
#include "base/folder.h"
#include "base/hdf5_library.h"
#include "base/memory.h"
#include "export/format.h"
#include "export/grain_columns.h"

#include <stdlib.h>
#include <string.h>

static const char NAME[] = "grains.h5", GRAINS[] = "/particles/grains";
enum { NAME_MOST = 128 };

typedef struct Writer {
    const OzExport *target;
    const OzHdf5 *h5; /* while in the library */
    hid_t file;       /* -1: not open         */
    int64_t number;   /* of the next frame    */
} Writer;

/* HDF5 names that differ from ours: H5MD's own. */
static const char *name_of(const OzGrainColumn *column)
{
    return strcmp(column->name, "population") == 0 ? "species" : column->name;
}

static OzStatus make_group(const OzHdf5 *h5, hid_t file, const char *path)
{
    OzStatus status = OZ_OK;
    hid_t group = -1;
    OZ_H5_TRY(group = h5->H5Gcreate2(file, path, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
done:
    oz_hdf5_library_close(group);
    return status;
}

/* An attribute of a group or dataset, of one number or (count > 1) a row of them. */
typedef struct Attribute {
    const char *path, *name;
    const char *text;   /* of a text, repeated count times; NULL: numbers */
    const int *numbers; /* count */
    hsize_t count;
} Attribute;

static OzStatus make_type(const OzHdf5 *h5, const char *text, hid_t *type)
{
    OZ_H5_PASS(*type = h5->H5Tcopy(text ? *h5->H5T_C_S1_g : *h5->H5T_NATIVE_INT32_g));
    if (text) {
        OZ_H5_PASS(h5->H5Tset_size(*type, strlen(text) + 1));
    }
    return OZ_OK;
}

/* A data space of one number, or of a row of count. */
static OzStatus make_row(const OzHdf5 *h5, hsize_t count, hid_t *space)
{
    OZ_H5_PASS(*space =
                   count > 1 ? h5->H5Screate_simple(1, &count, NULL) : h5->H5Screate(H5S_SCALAR));
    return OZ_OK;
}

static OzStatus write_attribute(const OzHdf5 *h5, hid_t object, const Attribute *a)
{
    OzStatus status = OZ_OK;
    hid_t type = -1, space = -1, attribute = -1;
    char texts[3][NAME_MOST] = {{0}};
    const void *data = a->numbers;
    if (a->text) { /* texts stand one behind the other, each with its zero */
        for (hsize_t k = 0; k < a->count; k++) {
            memcpy(texts[0] + k * (strlen(a->text) + 1), a->text, strlen(a->text) + 1);
        }
        data = texts[0];
    }
    OZ_TRY(make_type(h5, a->text, &type));
    OZ_TRY(make_row(h5, a->count, &space));
    OZ_H5_TRY(attribute = h5->H5Acreate2(object, a->name, type, space, H5P_DEFAULT, H5P_DEFAULT));
    OZ_H5_TRY(h5->H5Awrite(attribute, type, data));
done:
    oz_hdf5_library_close(attribute);
    oz_hdf5_library_close(space);
    oz_hdf5_library_close(type);
    return status;
}

/* A group with attributes; rows end with one without name. */
static OzStatus make_described(const OzHdf5 *h5, hid_t file, const char *path,
                               const Attribute *rows)
{
    OzStatus status = OZ_OK;
    hid_t group = -1;
    OZ_H5_TRY(group = h5->H5Gcreate2(file, path, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
    for (; rows->name; rows++) {
        OZ_TRY(write_attribute(h5, group, rows));
    }
done:
    oz_hdf5_library_close(group);
    return status;
}

static OzStatus write_head(const OzHdf5 *h5, hid_t file)
{
    static const int version[] = {1, 1}, units[] = {1, 0}, three[] = {3};
    const Attribute h5md[] = {{.name = "version", .numbers = version, .count = 2}, {0}};
    const Attribute author[] = {{.name = "name", .text = "unknown", .count = 1}, {0}};
    const Attribute creator[] = {{.name = "name", .text = "orzo", .count = 1},
                                 {.name = "version", .text = ORZO_VERSION, .count = 1},
                                 {0}};
    const Attribute module[] = {{.name = "version", .numbers = units, .count = 2},
                                {.name = "system", .text = "SI", .count = 1},
                                {0}};
    const Attribute box[] = {{.name = "dimension", .numbers = three, .count = 1},
                             {.name = "boundary", .text = "none", .count = 3},
                             {0}};
    OZ_PASS(make_described(h5, file, "/h5md", h5md));
    OZ_PASS(make_described(h5, file, "/h5md/author", author));
    OZ_PASS(make_described(h5, file, "/h5md/creator", creator));
    OZ_PASS(make_group(h5, file, "/h5md/modules"));
    OZ_PASS(make_described(h5, file, "/h5md/modules/units", module));
    OZ_PASS(make_group(h5, file, "/particles"));
    OZ_PASS(make_group(h5, file, GRAINS));
    return make_described(h5, file, "/particles/grains/box", box);
}

/* A dataset to be filled later; dimensions: its rank and sizes. One that grows has a row a frame,
 * of which there is one at first. */
typedef struct Table {
    char path[NAME_MOST];
    hid_t type;
    int rank;
    bool grows;
    hsize_t size[3];
    const char *unit; /* NULL: none */
} Table;

static OzStatus make_table(const OzHdf5 *h5, hid_t file, const Table *table)
{
    OzStatus status = OZ_OK;
    hid_t space = -1, dataset = -1, made = H5P_DEFAULT;
    hsize_t most[3] = {table->grows ? H5S_UNLIMITED : table->size[0], table->size[1],
                       table->size[2]};
    hsize_t chunk[3] = {table->rank == 1 ? 1024 : 1, table->size[1], table->size[2]};
    const Attribute unit = {.name = "unit", .text = table->unit, .count = 1};
    OZ_H5_TRY(space = h5->H5Screate_simple(table->rank, table->size, most));
    if (table->grows) {
        OZ_H5_TRY(made = h5->H5Pcreate(*h5->H5P_CLS_DATASET_CREATE_ID_g));
        OZ_H5_TRY(h5->H5Pset_chunk(made, table->rank, chunk));
    }
    OZ_H5_TRY(dataset = h5->H5Dcreate2(file, table->path, table->type, space, H5P_DEFAULT, made,
                                       H5P_DEFAULT));
    if (table->unit) {
        OZ_TRY(write_attribute(h5, dataset, &unit));
    }
done:
    oz_hdf5_library_close(made == H5P_DEFAULT ? -1 : made);
    oz_hdf5_library_close(dataset);
    oz_hdf5_library_close(space);
    return status;
}

/* Steps and times, which all columns share by links. */
static OzStatus make_times(const Writer *writer)
{
    const OzHdf5 *h5 = writer->h5;
    Table step = {.type = *h5->H5T_NATIVE_INT64_g, .rank = 1, .size = {1}, .grows = true};
    Table time = {
        .type = *h5->H5T_NATIVE_DOUBLE_g, .rank = 1, .size = {1}, .grows = true, .unit = "s"};
    snprintf(step.path, sizeof step.path, "%s/position/step", GRAINS);
    snprintf(time.path, sizeof time.path, "%s/position/time", GRAINS);
    OZ_PASS(make_table(h5, writer->file, &step));
    return make_table(h5, writer->file, &time);
}

static OzStatus link_times(const Writer *writer, const char *group)
{
    static const char *const names[] = {"step", "time"};
    char from[NAME_MOST], to[NAME_MOST + 8];
    for (int k = 0; k < 2; k++) {
        snprintf(from, sizeof from, "%s/position/%s", GRAINS, names[k]);
        snprintf(to, sizeof to, "%s/%s", group, names[k]);
        OZ_H5_PASS(writer->h5->H5Lcreate_hard(writer->file, from, writer->file, to, H5P_DEFAULT,
                                              H5P_DEFAULT));
    }
    return OZ_OK;
}

/* Of a column: frames x grains x width where it changes, else grains x width; a width of 1 is no
 * dimension. */
static Table table_of(const Writer *writer, const OzGrainColumn *column)
{
    const OzHdf5 *h5 = writer->h5;
    Table table = {.type = column->is_whole ? *h5->H5T_NATIVE_INT32_g : *h5->H5T_NATIVE_FLOAT_g,
                   .unit = column->is_whole ? NULL : column->unit};
    snprintf(table.path, sizeof table.path, "%s/%s%s", GRAINS, name_of(column),
             column->is_lasting ? "" : "/value");
    if (!column->is_lasting) {
        table.grows = true;
        table.size[table.rank++] = 1;
    }
    table.size[table.rank++] = (hsize_t)writer->target->grains->count;
    if (column->width > 1) {
        table.size[table.rank++] = (hsize_t)column->width;
    }
    return table;
}

static OzStatus make_column(const Writer *writer, const OzGrainColumn *column)
{
    char group[NAME_MOST];
    Table table = table_of(writer, column);
    snprintf(group, sizeof group, "%s/%s", GRAINS, name_of(column));
    if (!column->is_lasting) {
        OZ_PASS(make_group(writer->h5, writer->file, group));
    }
    OZ_PASS(make_table(writer->h5, writer->file, &table));
    if (strcmp(column->name, "position") == 0) {
        return make_times(writer);
    }
    return column->is_lasting ? OZ_OK : link_times(writer, group);
}

static OzStatus open_h5md(void **data, const OzExport *target)
{
    OzStatus status = OZ_OK;
    Writer *writer = NULL;
    char *path = NULL;
    if (target->scene->beams.strength.present) {
        return oz_status_fail(OZ_ERR_INPUT,
                              "%s: h5md is for as many grains as at the start; expected vtk, xyz "
                              "or csv with beams.strength",
                              target->scene->path);
    }
    OZ_TRY(OZ_NEW(&writer, 1));
    *data = writer;
    writer->target = target;
    writer->file = -1;
    OZ_TRY(oz_folder_note(target->folder, NAME));
    OZ_TRY(oz_file_join(&path, target->folder, NAME));
    OZ_TRY(oz_hdf5_library_enter(&writer->h5));
    OZ_H5_TRY(writer->file = writer->h5->H5Fcreate(path, OZ_H5_TRUNCATE, H5P_DEFAULT, H5P_DEFAULT));
    OZ_TRY(write_head(writer->h5, writer->file));
done:
    free(path);
    if (writer) {
        oz_hdf5_library_leave(&writer->h5);
    }
    return status;
}

/* Writes numbers of memory's type into row `first` of a table, which ends there. */
static OzStatus write_part(const Writer *writer, const Table *table, hsize_t first, hid_t memory,
                           const void *data)
{
    OzStatus status = OZ_OK;
    const OzHdf5 *h5 = writer->h5;
    hid_t dataset = -1, all = -1, part = -1;
    hsize_t start[3] = {first, 0, 0}, count[3] = {1, table->size[1], table->size[2]};
    hsize_t size[3] = {first + 1, table->size[1], table->size[2]};
    OZ_H5_TRY(dataset = h5->H5Dopen2(writer->file, table->path, H5P_DEFAULT));
    OZ_H5_TRY(h5->H5Dset_extent(dataset, size));
    OZ_H5_TRY(all = h5->H5Dget_space(dataset));
    OZ_H5_TRY(h5->H5Sselect_hyperslab(all, H5S_SELECT_SET, start, NULL, count, NULL));
    OZ_H5_TRY(part = h5->H5Screate_simple(table->rank, count, NULL));
    OZ_H5_TRY(h5->H5Dwrite(dataset, memory, part, all, H5P_DEFAULT, data));
done:
    oz_hdf5_library_close(part);
    oz_hdf5_library_close(all);
    oz_hdf5_library_close(dataset);
    return status;
}

static OzStatus write_all(const Writer *writer, const Table *table, const double *data)
{
    OzStatus status = OZ_OK;
    const OzHdf5 *h5 = writer->h5;
    hid_t dataset = -1;
    OZ_H5_TRY(dataset = h5->H5Dopen2(writer->file, table->path, H5P_DEFAULT));
    OZ_H5_TRY(h5->H5Dwrite(dataset, *h5->H5T_NATIVE_DOUBLE_g, H5S_ALL, H5S_ALL, H5P_DEFAULT, data));
done:
    oz_hdf5_library_close(dataset);
    return status;
}

static OzStatus write_column(const Writer *writer, const OzSnapshot *now,
                             const OzGrainColumn *column)
{
    OzStatus status = OZ_OK;
    Table table = table_of(writer, column);
    double *data = NULL;
    OZ_TRY(OZ_NEW(&data, now->count * column->width));
    for (int64_t i = 0; i < now->count; i++) {
        column->fill(now, i, &data[i * column->width]);
    }
    if (column->is_lasting) {
        OZ_TRY(write_all(writer, &table, data));
    } else {
        OZ_TRY(write_part(writer, &table, (hsize_t)writer->number, *writer->h5->H5T_NATIVE_DOUBLE_g,
                          data));
    }
done:
    free(data);
    return status;
}

static OzStatus write_times(const Writer *writer, const OzSnapshot *now)
{
    const OzHdf5 *h5 = writer->h5;
    hsize_t first = (hsize_t)writer->number;
    Table step = {.rank = 1}, time = {.rank = 1};
    snprintf(step.path, sizeof step.path, "%s/position/step", GRAINS);
    snprintf(time.path, sizeof time.path, "%s/position/time", GRAINS);
    OZ_PASS(write_part(writer, &step, first, *h5->H5T_NATIVE_INT64_g, &now->step));
    return write_part(writer, &time, first, *h5->H5T_NATIVE_DOUBLE_g, &now->time);
}

static OzStatus write_frame(const Writer *writer, const OzSnapshot *now)
{
    for (const OzGrainColumn *c = oz_grain_columns_all(); c->name; c++) {
        bool served = oz_grain_columns_serves(c, now);
        if (served && writer->number == 0) {
            OZ_PASS(make_column(writer, c));
        }
        if (served && (writer->number == 0 || !c->is_lasting)) {
            OZ_PASS(write_column(writer, now, c));
        }
    }
    return write_times(writer, now);
}

static OzStatus add_h5md(void *data, const OzSnapshot *now)
{
    Writer *writer = (Writer *)data;
    OZ_PASS(oz_hdf5_library_enter(&writer->h5));
    OzStatus status = write_frame(writer, now);
    if (status == OZ_OK) {
        status = oz_hdf5_library_check(writer->h5->H5Fflush(writer->file, H5F_SCOPE_GLOBAL),
                                       "H5Fflush", __FILE__, __LINE__);
    }
    oz_hdf5_library_leave(&writer->h5);
    writer->number++;
    return status;
}

static OzStatus finish_h5md(void *data)
{
    Writer *writer = (Writer *)data;
    OzStatus status = OZ_OK;
    if (writer && writer->file >= 0) {
        OZ_TRY(oz_hdf5_library_enter(&writer->h5));
        OZ_H5_TRY(writer->h5->H5Fclose(writer->file));
    }
done:
    if (writer) {
        oz_hdf5_library_leave(&writer->h5);
    }
    free(writer);
    return status;
}

const OzExportFormat oz_export_h5md_format = {"h5md", {NAME}, open_h5md, add_h5md, finish_h5md};
