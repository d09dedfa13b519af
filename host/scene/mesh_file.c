/* Readers of STL and OBJ. */
#include "scene/mesh_file.h"

#include "base/memory.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { STL_HEAD = 84, STL_FACE = 50, LINE_MOST = 1024 };

/* A text on its way. */
typedef struct Text {
    const char *path, *at;
    int line;
} Text;

static bool is_flat(const double corners[9])
{
    double a[3], b[3], area2 = 0, longest2 = 0;
    for (int k = 0; k < 3; k++) {
        a[k] = corners[3 + k] - corners[k];
        b[k] = corners[6 + k] - corners[k];
        longest2 = fmax(longest2, fmax(fabs(a[k]), fabs(b[k])));
    }
    for (int k = 0; k < 3; k++) {
        double n = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
        area2 += n * n;
    }
    return !(sqrt(area2) > 1e-12 * longest2 * longest2);
}

static OzStatus add(OzMeshFile *mesh, const char *path, const double corners[9])
{
    for (int k = 0; k < 9; k++) {
        if (!(fabs(corners[k]) <= 1e12)) {
            return oz_status_fail(OZ_ERR_INPUT,
                                  "%s: a corner is at %g; expected numbers up to 1e12", path,
                                  corners[k]);
        }
    }
    if (is_flat(corners)) {
        return OZ_OK;
    }
    if (mesh->count == OZ_MESH_FACES_MAX) {
        return oz_status_fail(OZ_ERR_INPUT, "%s: more triangles; expected at most %d", path,
                              OZ_MESH_FACES_MAX);
    }
    if (mesh->count == mesh->capacity) {
        int capacity = mesh->capacity > 0 ? 2 * mesh->capacity : 256;
        double *grown = realloc(mesh->corners, 9 * (size_t)capacity * sizeof *grown);
        if (!grown) {
            return oz_status_fail(OZ_ERR_MEMORY, "out of memory for the triangles of %s", path);
        }
        mesh->corners = grown;
        mesh->capacity = capacity;
    }
    memcpy(mesh->corners + 9 * (size_t)mesh->count++, corners, 9 * sizeof *corners);
    return OZ_OK;
}

static uint32_t little_word(const char *bytes)
{
    const unsigned char *b = (const unsigned char *)bytes;
    return (uint32_t)b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
}

static OzStatus read_binary(OzMeshFile *mesh, const char *path, const char *bytes, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        double corners[9];
        for (int k = 0; k < 9; k++) {
            float number;
            uint32_t word = little_word(bytes + STL_HEAD + STL_FACE * (size_t)i + 12 + 4 * k);
            memcpy(&number, &word, sizeof number);
            corners[k] = (double)number;
        }
        OZ_PASS(add(mesh, path, corners));
    }
    return OZ_OK;
}

/* The next line that says something, without blanks in front; false at the end. */
static bool next_line(Text *text, char line[LINE_MOST])
{
    while (*text->at) {
        size_t length = strcspn(text->at, "\r\n"), skipped = strspn(text->at, " \t");
        const char *from = text->at + (skipped < length ? skipped : length);
        size_t held = (size_t)(text->at + length - from);
        bool is_return = text->at[length] == '\r' && text->at[length + 1] == '\n';
        held = held < LINE_MOST - 1 ? held : LINE_MOST - 1;
        memcpy(line, from, held);
        line[held] = '\0';
        text->line++;
        text->at += length + (text->at[length] ? (is_return ? 2 : 1) : 0);
        if (held > 0) {
            return true;
        }
    }
    return false;
}

/* The words that a line begins with; NULL where it begins otherwise. */
static const char *after(const char *line, const char *words)
{
    for (; *words; words++) {
        if (*words == ' ') {
            size_t blanks = strspn(line, " \t");
            if (blanks == 0) {
                return NULL;
            }
            line += blanks;
        } else if ((*line | 32) != *words) {
            return NULL;
        } else {
            line++;
        }
    }
    return *line == '\0' || *line == ' ' || *line == '\t' ? line : NULL;
}

static OzStatus wrong(const Text *text, const char *line, const char *expected)
{
    return oz_status_fail(OZ_ERR_INPUT, "%s:%d: `%.40s`; expected %s", text->path, text->line, line,
                          expected);
}

static bool read_numbers(const char *from, double *to, int count)
{
    for (int k = 0; k < count; k++) {
        char *end;
        to[k] = strtod(from, &end);
        if (end == from || !isfinite(to[k])) {
            return false;
        }
        from = end;
    }
    return true;
}

/* One facet of an STL's text, whose first line has been read. */
static OzStatus read_facet(OzMeshFile *mesh, Text *text)
{
    char line[LINE_MOST] = "";
    double corners[9];
    if (!next_line(text, line) || !after(line, "outer loop")) {
        return wrong(text, line, "outer loop");
    }
    for (int k = 0; k < 3; k++) {
        const char *numbers = next_line(text, line) ? after(line, "vertex") : NULL;
        if (!numbers || !read_numbers(numbers, corners + 3 * k, 3)) {
            return wrong(text, line, "vertex and three numbers");
        }
    }
    if (!next_line(text, line) || !after(line, "endloop")) {
        return wrong(text, line, "endloop after three corners");
    }
    if (!next_line(text, line) || !after(line, "endfacet")) {
        return wrong(text, line, "endfacet");
    }
    return add(mesh, text->path, corners);
}

static OzStatus read_stl(OzMeshFile *mesh, Text *text)
{
    char line[LINE_MOST] = "";
    if (!next_line(text, line) || !after(line, "solid")) {
        return wrong(text, line,
                     "solid, or a binary STL of 84 + 50 x its number of triangles bytes");
    }
    while (next_line(text, line)) {
        if (after(line, "endsolid") || after(line, "solid")) {
            continue;
        }
        if (!after(line, "facet")) {
            return wrong(text, line, "facet or endsolid");
        }
        OZ_PASS(read_facet(mesh, text));
    }
    return OZ_OK;
}

/* Corners of an OBJ. */
typedef struct Places {
    double *place;
    long count, capacity;
} Places;

static OzStatus add_place(Places *places, const Text *text, const double place[3])
{
    if (places->count == places->capacity) {
        long capacity = places->capacity > 0 ? 2 * places->capacity : 256;
        double *grown = realloc(places->place, 3 * (size_t)capacity * sizeof *grown);
        if (!grown) {
            return oz_status_fail(OZ_ERR_MEMORY, "out of memory for the corners of %s", text->path);
        }
        places->place = grown;
        places->capacity = capacity;
    }
    memcpy(places->place + 3 * places->count++, place, 3 * sizeof *place);
    return OZ_OK;
}

/* A polygon becomes a fan of triangles. */
static OzStatus read_polygon(OzMeshFile *mesh, const Text *text, const Places *places,
                             const char *line, const char *numbers)
{
    double corners[9];
    int count = 0;
    for (const char *at = numbers; *(at += strspn(at, " \t"));) {
        char *end;
        long index = strtol(at, &end, 10);
        index = index < 0 ? places->count + index : index - 1;
        if (end == at || index < 0 || index >= places->count) {
            return wrong(text, line, "numbers of corners before it");
        }
        if (count > 2) {
            memcpy(corners + 3, corners + 6, 3 * sizeof *corners);
        }
        memcpy(corners + 3 * (count < 3 ? count : 2), places->place + 3 * index,
               3 * sizeof *corners);
        if (++count > 2) {
            OZ_PASS(add(mesh, text->path, corners));
        }
        at = end + strcspn(end, " \t");
    }
    return count > 2 ? OZ_OK : wrong(text, line, "three corners or more");
}

static OzStatus read_obj_line(OzMeshFile *mesh, const Text *text, Places *places, const char *line)
{
    static const char *const others[] = {"#", "vt", "vn", "vp",     "o",      "g",
                                         "s", "l",  "p",  "usemtl", "mtllib", NULL};
    double place[3];
    const char *rest = after(line, "v");
    if (rest) {
        return read_numbers(rest, place, 3) ? add_place(places, text, place)
                                            : wrong(text, line, "v and three numbers");
    }
    rest = after(line, "f");
    if (rest) {
        return read_polygon(mesh, text, places, line, rest);
    }
    for (int k = 0; others[k]; k++) {
        if (line[0] == '#' || after(line, others[k])) {
            return OZ_OK;
        }
    }
    return wrong(text, line, "v, f, or another line of an OBJ");
}

static OzStatus read_obj(OzMeshFile *mesh, Text *text)
{
    OzStatus status = OZ_OK;
    char line[LINE_MOST];
    Places places = {0};
    while (next_line(text, line)) {
        OZ_TRY(read_obj_line(mesh, text, &places, line));
    }
done:
    free(places.place);
    return status;
}

OzStatus oz_mesh_file_read(OzMeshFile *mesh, const char *path, const char *bytes, size_t length)
{
    Text text = {.path = path, .at = bytes};
    size_t name = strlen(path);
    uint32_t count = length >= STL_HEAD ? little_word(bytes + STL_HEAD - 4) : 0;
    if (name > 4 && strcasecmp(path + name - 4, ".obj") == 0) {
        OZ_PASS(read_obj(mesh, &text));
    } else if (count > 0 && length == STL_HEAD + STL_FACE * (size_t)count) {
        OZ_PASS(read_binary(mesh, path, bytes, count));
    } else {
        OZ_PASS(read_stl(mesh, &text));
    }
    return mesh->count > 0
               ? OZ_OK
               : oz_status_fail(OZ_ERR_INPUT, "%s: no triangle with an area; expected at least one",
                                path);
}
