/* Writes a scene by walking the list of keys. Knows the types of values and no key by name. */
#include "scene/write.h"

#include "scene/keys.h"
#include "scene/sweep.h"
#include "scene/value.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { INDENT = 2 };

typedef struct Writer {
    const OzScene *scene;
    FILE *file;
    int indent;
    bool dash; /* the next line begins a list's item */
} Writer;

/* The shortest of the usual spellings that reads back to number, which is stored after
 * multiplication by scale. */
static bool spell(double written, double number, double scale, char *text, size_t size)
{
    for (int digits = 6; digits <= 17; digits++) {
        snprintf(text, size, "%.*g", digits, written);
        if (strtod(text, NULL) * scale == number) {
            return true;
        }
    }
    return false;
}

/* The quotient may miss what was written by its last bits, so its neighbours are tried too. */
static void print_number(double number, double scale, FILE *file)
{
    enum { NEIGHBOURS = 4 };
    char text[32];
    double written = number / scale;
    double below = written, above = written;
    bool found = spell(written, number, scale, text, sizeof text);
    for (int i = 0; i < NEIGHBOURS && !found; i++) {
        below = nextafter(below, -INFINITY);
        above = nextafter(above, INFINITY);
        found = spell(below, number, scale, text, sizeof text) ||
                spell(above, number, scale, text, sizeof text);
    }
    fputs(text, file);
}

/* Letters that a YAML reader neither refuses nor folds stay; the rest is escaped. */
static bool is_plain(uint32_t letter)
{
    return letter != '"' && letter != '\\' &&
           ((letter >= 0x20 && letter < 0x7f) || (letter > 0xa0 && letter < 0x2000) ||
            (letter >= 0x2030 && letter < 0xd800));
}

/* The next letter of UTF-8 (libyaml lets nothing else through, but a folder's name may be
 * anything). */
static int decode(const unsigned char *text, uint32_t *letter)
{
    int length = text[0] < 0x80 ? 1 : text[0] < 0xe0 ? 2 : text[0] < 0xf0 ? 3 : 4;
    *letter = length == 1 ? text[0] : text[0] & (0x7fu >> length);
    for (int i = 1; i < length && text[i]; i++) {
        *letter = *letter << 6 | (text[i] & 0x3fu);
    }
    return (int)strnlen((const char *)text, (size_t)length);
}

static void print_text(const char *text, FILE *file)
{
    fputc('"', file);
    while (*text) {
        uint32_t letter = 0;
        int length = decode((const unsigned char *)text, &letter);
        if (is_plain(letter)) {
            fwrite(text, 1, (size_t)length, file);
        } else {
            fprintf(file, "\\U%08" PRIX32, letter);
        }
        text += length;
    }
    fputc('"', file);
}

/* Element i of a row that holds several, or its one value. */
static void print_element(const OzKey *key, const void *place, int i, FILE *file)
{
    switch (key->type) {
    case OZ_KEY_INTEGER:
    case OZ_KEY_COUNTS:
        fprintf(file, "%" PRId64, ((const int64_t *)place)[i]);
        break;
    case OZ_KEY_SIZE:
        fprintf(file, "%d", ((const int *)place)[i]);
        break;
    case OZ_KEY_CHOICE:
    case OZ_KEY_CHOICES:
        fputs(key->choices[((const int *)place)[i]], file);
        break;
    case OZ_KEY_BOOL:
        fputs(*(const bool *)place ? "true" : "false", file);
        break;
    case OZ_KEY_TEXT:
    case OZ_KEY_FILE:
    case OZ_KEY_NAMES:
        print_text(((char *const *)place)[i], file);
        break;
    default:
        if (key->infinite && isinf(((const double *)place)[i])) {
            fputs(key->infinite, file);
            break;
        }
        print_number(((const double *)place)[i], key->scale != 0 ? key->scale : 1, file);
        break;
    }
}

static void print_list(const OzKey *key, const void *place, int count, FILE *file)
{
    fputc('[', file);
    for (int i = 0; i < count; i++) {
        fputs(i ? ", " : "", file);
        print_element(key, place, i, file);
    }
    fputc(']', file);
}

void oz_write_value(const OzKey *key, const void *base, FILE *file)
{
    const void *place = oz_value_at(key, base);
    const OzRange *range = place;
    switch (key->type) {
    case OZ_KEY_VECTOR:
    case OZ_KEY_COUNTS:
    case OZ_KEY_SIZE:
    case OZ_KEY_NAMES:
        print_list(key, place, key->width, file);
        break;
    case OZ_KEY_CHOICES:
        print_list(key, place, *oz_value_count(key, base), file);
        break;
    case OZ_KEY_NUMBERS:
        print_list(key, *(double *const *)place, *oz_value_count(key, base), file);
        break;
    case OZ_KEY_RANGE:
        if (range->low != range->high) {
            print_list(key, place, 2, file);
            break;
        }
        print_number(range->low, 1, file);
        break;
    case OZ_KEY_SWEEP:
        oz_sweep_write(place, file);
        break;
    default:
        print_element(key, place, 0, file);
        break;
    }
}

static const OzKey *neighbour(const OzKey *key, const char *name)
{
    char path[128];
    const char *dot = strrchr(key->path, '.');
    snprintf(path, sizeof path, "%.*s%s", dot ? (int)(dot - key->path) + 1 : 0, key->path, name);
    return oz_keys_find(path);
}

/* True when bits is 0, or the item's choice of that name ("kind", "shape") is one of bits. */
static bool is_of(const OzKey *key, unsigned bits, const char *name, const void *base)
{
    char path[128];
    const char *brackets = strstr(key->path, "[]");
    if (!bits || !brackets) {
        return !bits;
    }
    snprintf(path, sizeof path, "%.*s[].%s", (int)(brackets - key->path), key->path, name);
    const OzKey *choice = oz_keys_find(path);
    return !choice || bits >> *(const int *)oz_value_at(choice, base) & 1;
}

/* Whether some grains touch by the laws of `contact`, which are then asked for. */
static bool has_contacts(const OzScene *scene)
{
    bool any = scene->model == OZ_MODEL_RODS;
    for (int i = 0; i < scene->population_count; i++) {
        any |= scene->populations[i].shape == OZ_SHAPE_DISC;
    }
    return any;
}

/* Whether a material, or a wall that is of none, has the scene's own value, which need not be there
 * otherwise. */
static bool is_taken(const OzScene *scene, const OzKey *key)
{
    char path[64];
    const char *name = strchr(key->path, '.') + 1;
    snprintf(path, sizeof path, "materials[].%s", name);
    for (int i = 0; i < scene->material_count; i++) {
        if (oz_value_same(oz_keys_find(path), &scene->materials[i], key, scene)) {
            return true;
        }
    }
    snprintf(path, sizeof path, "walls[].contact.%s", name);
    for (int w = 0; w < scene->wall_count; w++) {
        if (!scene->walls[w].material &&
            oz_value_same(oz_keys_find(path), &scene->walls[w], key, scene)) {
            return true;
        }
    }
    return scene->material_count == 0;
}

/* A law's values: of that law alone, and where they are not asked for those that are there. */
static bool is_of_law(const OzScene *scene, const OzKey *key, const void *base)
{
    return !key->laws ||
           (key->laws >> scene->contact.law & 1 &&
            ((has_contacts(scene) && is_taken(scene, key)) || oz_value_holds(key, base)));
}

bool oz_write_applies(const OzScene *scene, const OzKey *key, const void *base)
{
    return key->type != OZ_KEY_EXTENDS && oz_keys_serves(key, (int)scene->model) &&
           is_of(key, key->kinds, "kind", base) && is_of(key, key->shapes, "shape", base) &&
           is_of_law(scene, key, base);
}

bool oz_write_has(const OzScene *scene, const OzKey *key, const void *base)
{
    bool in_item = strstr(key->path, "[]") != NULL;
    if (!oz_write_applies(scene, key, base)) {
        return false;
    }
    if (key->type == OZ_KEY_SECTION) {
        return *(const bool *)oz_value_at(key, base);
    }
    if (in_item && key->inherits) {
        return !oz_value_same(key, base, oz_keys_find(key->inherits), scene);
    }
    switch (key->write) {
    case OZ_WRITE_NONZERO:
        return oz_value_holds(key, base);
    case OZ_WRITE_UNLESS_RIVAL:
        return !oz_value_holds(neighbour(key, key->rival), base) &&
               (key->required || oz_value_holds(key, base));
    case OZ_WRITE_UNLESS_INHERITED:
        return !oz_value_same(key, base, oz_keys_of(key->inherits, (int)scene->model), scene);
    case OZ_WRITE_MARKED:
        return *(const bool *)((const char *)base + key->count_offset);
    default:
        return true;
    }
}

static void begin_line(Writer *writer, const char *name, size_t length)
{
    int indent = writer->indent - (writer->dash ? INDENT : 0);
    fprintf(writer->file, "%*s%s%.*s:", indent, "", writer->dash ? "- " : "", (int)length, name);
    writer->dash = false;
}

static void write_rows(Writer *writer, const OzKey *key, const OzKey *end, size_t start,
                       const void *base);

static void write_items(Writer *writer, const OzKey *list, const OzKey *end, const void *base)
{
    const char *items = *(char *const *)oz_value_at(list, base);
    int count = *oz_value_count(list, base);
    fputs(count ? "\n" : " []\n", writer->file);
    writer->indent += 2 * INDENT;
    for (int i = 0; i < count; i++) {
        writer->dash = true;
        write_rows(writer, list + 1, end, strlen(list->path) + strlen("[]."),
                   items + (size_t)i * list->item_size);
    }
    writer->indent -= 2 * INDENT;
}

static bool any_written(const Writer *writer, const OzKey *key, const OzKey *end, const void *base)
{
    for (; key < end; key++) {
        if (oz_write_has(writer->scene, key, base)) {
            return true;
        }
    }
    return false;
}

/* One name: a value, a list of groups, or a group of further names. */
static void write_name(Writer *writer, const OzKey *key, const OzKey *end, size_t start,
                       const void *base)
{
    size_t length = strcspn(key->path + start, ".[");
    bool whole = key->path[start + length] == '\0';
    if (whole ? !oz_write_has(writer->scene, key, base) : !any_written(writer, key, end, base)) {
        return;
    }
    begin_line(writer, key->path + start, length);
    if (whole && key->type == OZ_KEY_ITEMS) {
        write_items(writer, key, end, base);
    } else if (whole && key->type != OZ_KEY_SECTION) {
        fputc(' ', writer->file);
        oz_write_value(key, base, writer->file);
        fputc('\n', writer->file);
    } else {
        fputc('\n', writer->file);
        writer->indent += INDENT;
        write_rows(writer, whole ? key + 1 : key, end, start + length + 1, base);
        writer->indent -= INDENT;
    }
}

/* Rows from key to end whose paths agree up to start; base is the scene or a list's item. */
static void write_rows(Writer *writer, const OzKey *key, const OzKey *end, size_t start,
                       const void *base)
{
    while (key < end) {
        const OzKey *next = oz_keys_end(key, start + strcspn(key->path + start, ".["));
        write_name(writer, key, next, start, base);
        key = next;
    }
}

void oz_write_scene(const OzScene *scene, FILE *file)
{
    Writer writer = {.scene = scene, .file = file};
    const OzKey *first = oz_keys_all(), *end = first;
    while (end->path) {
        end++;
    }
    write_rows(&writer, first, end, 0, scene);
}
