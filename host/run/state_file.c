/* States in files. What of it is HDF5 happens in memory, so every byte is read and written here. */
#include "run/state_file.h"

#include "base/file.h"
#include "base/hdf5_library.h"
#include "base/memory.h"
#include "observe/bytes.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

static const char MAGIC[8] = {'o', 'z', 's', 't', 'a', 't', 'e', '\n'};
enum { HEAD = 512, BYTE_ORDER_MARK = 0x01020304, VERSION = 1 };

static const OzHdf5 *h5; /* of who is in the library */

static hid_t type_of(OzStateKind kind)
{
    hid_t *const types[] = {[OZ_STATE_INT64] = h5->H5T_NATIVE_INT64_g,
                            [OZ_STATE_INT32] = h5->H5T_NATIVE_INT32_g,
                            [OZ_STATE_DOUBLE] = h5->H5T_NATIVE_DOUBLE_g,
                            [OZ_STATE_FLOAT] = h5->H5T_NATIVE_FLOAT_g,
                            [OZ_STATE_BYTES] = h5->H5T_NATIVE_UINT8_g};
    return *types[kind];
}

/* A file in memory, made or (image) opened. */
static OzStatus open_image(hid_t *file, void *image, size_t bytes)
{
    OzStatus status = OZ_OK;
    hid_t access = -1;
    *file = -1;
    OZ_H5_TRY(access = h5->H5Pcreate(*h5->H5P_CLS_FILE_ACCESS_ID_g));
    OZ_H5_TRY(h5->H5Pset_fapl_core(access, (size_t)1 << 20, 0));
    if (image) {
        OZ_H5_TRY(h5->H5Pset_file_image(access, image, bytes));
        OZ_H5_TRY(*file = h5->H5Fopen("state", OZ_H5_READ, access));
    } else {
        OZ_H5_TRY(*file = h5->H5Fcreate("state", OZ_H5_TRUNCATE, H5P_DEFAULT, access));
    }
done:
    oz_hdf5_library_close(access);
    return status;
}

static OzStatus write_unit(hid_t dataset, const char *unit)
{
    OzStatus status = OZ_OK;
    hid_t type = -1, space = -1, attribute = -1;
    OZ_H5_TRY(type = h5->H5Tcopy(*h5->H5T_C_S1_g));
    OZ_H5_TRY(h5->H5Tset_size(type, strlen(unit) + 1));
    OZ_H5_TRY(space = h5->H5Screate(H5S_SCALAR));
    OZ_H5_TRY(attribute = h5->H5Acreate2(dataset, "unit", type, space, H5P_DEFAULT, H5P_DEFAULT));
    OZ_H5_TRY(h5->H5Awrite(attribute, type, unit));
done:
    oz_hdf5_library_close(attribute);
    oz_hdf5_library_close(space);
    oz_hdf5_library_close(type);
    return status;
}

static OzStatus write_entry(hid_t file, const OzStateEntry *entry)
{
    OzStatus status = OZ_OK;
    hid_t links = -1, space = -1, dataset = -1, type = type_of(entry->kind);
    hsize_t count = (hsize_t)entry->count;
    OZ_H5_TRY(links = h5->H5Pcreate(*h5->H5P_CLS_LINK_CREATE_ID_g));
    OZ_H5_TRY(h5->H5Pset_create_intermediate_group(links, 1));
    OZ_H5_TRY(space = h5->H5Screate_simple(1, &count, NULL));
    OZ_H5_TRY(dataset =
                  h5->H5Dcreate2(file, entry->name, type, space, links, H5P_DEFAULT, H5P_DEFAULT));
    OZ_H5_TRY(h5->H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, entry->data));
    OZ_TRY(write_unit(dataset, entry->unit));
done:
    oz_hdf5_library_close(dataset);
    oz_hdf5_library_close(space);
    oz_hdf5_library_close(links);
    return status;
}

/* The names of all entries, a line each; the caller frees. */
static OzStatus list_names(const OzState *state, char **names)
{
    size_t length = 1;
    for (int64_t i = 0; i < state->count; i++) {
        length += strlen(state->entries[i].name) + 1;
    }
    OzStatus status = OZ_NEW(names, length);
    char *at = *names;
    for (int64_t i = 0; status == OZ_OK && i < state->count; i++) {
        at += sprintf(at, "%s\n", state->entries[i].name);
    }
    return status;
}

static OzStatus write_entries(hid_t file, const OzState *state)
{
    OzStatus status = OZ_OK;
    char *names = NULL, name[] = "entries", unit[] = "names, a line each";
    OZ_TRY(list_names(state, &names));
    for (int64_t i = 0; i < state->count; i++) {
        OZ_TRY(write_entry(file, &state->entries[i]));
    }
    OzStateEntry list = {.name = name,
                         .unit = unit,
                         .kind = OZ_STATE_BYTES,
                         .count = (int64_t)strlen(names),
                         .data = names};
    OZ_TRY(write_entry(file, &list));
done:
    free(names);
    return status;
}

static uint64_t checksum(unsigned char *bytes, size_t length)
{
    unsigned char *at = bytes + HEAD - sizeof(uint64_t);
    memset(at, 0, sizeof(uint64_t));
    return oz_bytes_sum(bytes, length);
}

/* The whole file in new memory, head included. */
static OzStatus make_bytes(const OzState *state, unsigned char **bytes, size_t *length)
{
    OzStatus status = OZ_OK;
    hid_t file = -1;
    ssize_t image = 0;
    uint32_t marks[2] = {BYTE_ORDER_MARK, VERSION};
    OZ_TRY(open_image(&file, NULL, 0));
    OZ_TRY(write_entries(file, state));
    OZ_H5_TRY(h5->H5Fflush(file, H5F_SCOPE_GLOBAL));
    OZ_H5_TRY(image = h5->H5Fget_file_image(file, NULL, 0));
    *length = HEAD + (size_t)image;
    OZ_TRY(OZ_NEW(bytes, *length));
    OZ_H5_TRY(h5->H5Fget_file_image(file, *bytes + HEAD, (size_t)image));
    uint64_t whole = *length, sum;
    OzBytes at = *bytes;
    oz_bytes_pack(&at, MAGIC, sizeof MAGIC);
    oz_bytes_pack(&at, marks, sizeof marks);
    oz_bytes_pack(&at, &whole, sizeof whole);
    sum = checksum(*bytes, *length);
    memcpy(*bytes + HEAD - sizeof sum, &sum, sizeof sum);
done:
    if (file >= 0) {
        h5->H5Fclose(file);
    }
    return status;
}

static OzStatus file_failure(const char *path)
{
    return oz_status_fail(OZ_ERR_FILE, "cannot write %s: %s", path, strerror(errno));
}

static OzStatus write_whole(const char *path, const unsigned char *bytes, size_t length)
{
    OzStatus status = OZ_OK;
    FILE *file = fopen(path, "wb");
    if (!file) {
        return file_failure(path);
    }
    if (fwrite(bytes, 1, length, file) != length || fflush(file) != 0 || fsync(fileno(file)) != 0) {
        status = file_failure(path);
    }
    if (fclose(file) != 0 && status == OZ_OK) {
        status = file_failure(path);
    }
    if (status != OZ_OK) {
        remove(path);
    }
    return status;
}

/* A rename lasts when its folder is on the disk. */
static void sync_folder(const char *path)
{
    char folder[4096];
    const char *slash = strrchr(path, '/');
    snprintf(folder, sizeof folder, "%.*s", slash ? (int)(slash - path) + 1 : 1,
             slash ? path : ".");
    int handle = open(folder, O_RDONLY | O_DIRECTORY);
    if (handle >= 0) {
        fsync(handle);
        close(handle);
    }
}

static OzStatus put_in_place(const char *part, const char *path)
{
    char previous[4096];
    int length = snprintf(previous, sizeof previous, "%s.previous", path);
    if (length < 0 || (size_t)length >= sizeof previous) {
        return oz_status_fail(OZ_ERR_FILE, "%s: too long a name", path);
    }
    bool had = oz_file_exists(path);
    if ((had && rename(path, previous) != 0) || rename(part, path) != 0) {
        return file_failure(path);
    }
    sync_folder(path);
    return OZ_OK;
}

OzStatus oz_state_file_write(const OzState *state, const char *path)
{
    OzStatus status = OZ_OK;
    unsigned char *bytes = NULL;
    size_t length = 0;
    const OzHdf5 *library = NULL;
    char part[4096];
    snprintf(part, sizeof part, "%s.part", path);
    OZ_TRY(oz_hdf5_library_enter(&library));
    h5 = library;
    OZ_TRY(make_bytes(state, &bytes, &length));
    OZ_TRY(write_whole(part, bytes, length));
    OZ_TRY(put_in_place(part, path));
done:
    oz_hdf5_library_leave(&library);
    free(bytes);
    return status;
}

static OzStatus refuse(const char *path, const char *why)
{
    return oz_status_fail(OZ_ERR_INPUT, "%s: %s; expected a state of orzo, version %d", path, why,
                          VERSION);
}

/* Whether the head vouches for the rest. */
static OzStatus check_head(unsigned char *bytes, size_t length, const char *path)
{
    uint32_t marks[2];
    uint64_t whole, sum;
    OzBytes at = bytes + sizeof MAGIC;
    if (length < HEAD || memcmp(bytes, MAGIC, sizeof MAGIC) != 0) {
        return refuse(path, length < HEAD ? "too short" : "no state of a run");
    }
    oz_bytes_unpack(&at, marks, sizeof marks);
    oz_bytes_unpack(&at, &whole, sizeof whole);
    memcpy(&sum, bytes + HEAD - sizeof sum, sizeof sum);
    if (marks[0] != BYTE_ORDER_MARK) {
        return refuse(path, "written on a machine with another byte order");
    }
    if (marks[1] != VERSION) {
        return refuse(path, marks[1] > VERSION ? "written by a newer orzo" : "of another version");
    }
    if (whole != length) {
        return refuse(path, whole > length ? "cut short" : "longer than it was written");
    }
    return sum == checksum(bytes, length) ? OZ_OK : refuse(path, "damaged");
}

/* Its kind, or OZ_STATE_KINDS. */
static OzStateKind kind_of(hid_t type)
{
    int kind = 0;
    while (kind < OZ_STATE_KINDS && h5->H5Tequal(type, type_of((OzStateKind)kind)) <= 0) {
        kind++;
    }
    return (OzStateKind)kind;
}

static OzStatus read_unit(hid_t dataset, char **unit)
{
    OzStatus status = OZ_OK;
    hid_t attribute = -1, type = -1;
    OZ_H5_TRY(attribute = h5->H5Aopen(dataset, "unit", H5P_DEFAULT));
    OZ_H5_TRY(type = h5->H5Aget_type(attribute));
    OZ_TRY(OZ_NEW(unit, h5->H5Tget_size(type) + 1));
    OZ_H5_TRY(h5->H5Aread(attribute, type, *unit));
done:
    oz_hdf5_library_close(type);
    oz_hdf5_library_close(attribute);
    return status;
}

/* Data and unit in new memory. */
static OzStatus read_entry(hid_t file, OzStateEntry *entry)
{
    OzStatus status = OZ_OK;
    hid_t dataset = -1, space = -1, type = -1;
    OZ_H5_TRY(dataset = h5->H5Dopen2(file, entry->name, H5P_DEFAULT));
    OZ_H5_TRY(space = h5->H5Dget_space(dataset));
    OZ_H5_TRY(type = h5->H5Dget_type(dataset));
    OZ_H5_TRY(entry->count = (int64_t)h5->H5Sget_simple_extent_npoints(space));
    entry->kind = kind_of(type);
    OZ_H5_TRY(entry->kind == OZ_STATE_KINDS ? -1 : 0);
    OZ_TRY(oz_memory_new(&entry->data, (size_t)entry->count + 1, oz_state_kind_bytes(entry->kind),
                         entry->name));
    OZ_H5_TRY(
        h5->H5Dread(dataset, type_of(entry->kind), H5S_ALL, H5S_ALL, H5P_DEFAULT, entry->data));
    OZ_TRY(read_unit(dataset, &entry->unit));
done:
    oz_hdf5_library_close(type);
    oz_hdf5_library_close(space);
    oz_hdf5_library_close(dataset);
    return status;
}

static OzStatus read_named(OzState *state, hid_t file, char *name)
{
    OzStatus status = OZ_OK;
    OzStateEntry entry = {.name = name};
    OZ_TRY(read_entry(file, &entry));
    OZ_TRY(oz_state_add(state, &entry));
done:
    free(entry.unit);
    free(entry.data);
    return status;
}

static OzStatus read_entries(OzState *state, hid_t file)
{
    OzStatus status = OZ_OK;
    char name[] = "entries";
    OzStateEntry list = {.name = name};
    OZ_TRY(read_entry(file, &list)); /* its memory ends with a zero */
    for (char *line = list.data, *end; (end = strchr(line, '\n')) != NULL; line = end + 1) {
        *end = '\0';
        OZ_TRY(read_named(state, file, line));
    }
done:
    free(list.unit);
    free(list.data);
    return status;
}

OzStatus oz_state_file_read(OzState *state, const char *path)
{
    OzStatus status = OZ_OK;
    char *bytes = NULL;
    size_t length = 0;
    hid_t file = -1;
    const OzHdf5 *library = NULL;
    *state = (OzState){0};
    OZ_TRY(oz_file_read(&bytes, &length, path));
    OZ_TRY(check_head((unsigned char *)bytes, length, path));
    OZ_TRY(oz_hdf5_library_enter(&library));
    h5 = library;
    OZ_TRY(open_image(&file, bytes + HEAD, length - HEAD));
    OZ_TRY(read_entries(state, file));
done:
    if (file >= 0) {
        h5->H5Fclose(file);
    }
    oz_hdf5_library_leave(&library);
    free(bytes);
    if (status != OZ_OK) {
        oz_state_free(state);
    }
    return status;
}
