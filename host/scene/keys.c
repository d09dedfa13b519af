/* Looking rows up and printing them. Knows their columns and no key by name but where names of
 * choices are shown. */
#include "scene/keys.h"

#include "scene/describe.h"
#include "scene/rows.h"
#include "scene/scene.h"

#include <stdint.h>
#include <string.h>

enum { EVERY_MODEL = 1 << OZ_MODEL_RODS | 1 << OZ_MODEL_TRIGRAINS };

const OzKey *oz_keys_all(void)
{
    return oz_rows_all();
}

bool oz_keys_serves(const OzKey *key, int model)
{
    return !key->models || key->models >> model & 1;
}

const OzKey *oz_keys_find(const char *path)
{
    for (const OzKey *key = oz_rows_all(); key->path; key++) {
        if (strcmp(key->path, path) == 0) {
            return key;
        }
    }
    return NULL;
}

const OzKey *oz_keys_of(const char *path, int model)
{
    for (const OzKey *key = oz_keys_find(path); key && key->path; key++) {
        if (strcmp(key->path, path) == 0 && oz_keys_serves(key, model)) {
            return key;
        }
    }
    return NULL;
}

bool oz_keys_is_group(const char *path)
{
    size_t length = strlen(path);
    for (const OzKey *key = oz_rows_all(); key->path; key++) {
        if (strncmp(key->path, path, length) == 0 && key->path[length] == '.') {
            return true;
        }
    }
    return false;
}

static const char *choice_of(const OzKey *key, int value)
{
    for (int i = 0; key->choices && key->choices[i]; i++) {
        if (i == value && key->choices[i][0]) {
            return key->choices[i];
        }
    }
    return NULL;
}

const char *oz_keys_choice_name(const char *path, int value)
{
    for (const OzKey *key = oz_keys_find(path); key && key->path; key++) {
        const char *name = strcmp(key->path, path) == 0 ? choice_of(key, value) : NULL;
        if (name) {
            return name;
        }
    }
    return "?";
}

size_t oz_keys_size(const OzKey *key)
{
    switch (key->type) {
    case OZ_KEY_NUMBER:
    case OZ_KEY_INTEGER:
        return sizeof(double);
    case OZ_KEY_BOOL:
    case OZ_KEY_SECTION:
        return sizeof(bool);
    case OZ_KEY_CHOICE:
        return sizeof(int);
    case OZ_KEY_CHOICES:
    case OZ_KEY_SIZE:
        return (size_t)key->width * sizeof(int);
    case OZ_KEY_VECTOR:
    case OZ_KEY_COUNTS:
        return (size_t)key->width * sizeof(double);
    case OZ_KEY_RANGE:
        return sizeof(OzRange);
    case OZ_KEY_SWEEP:
        return sizeof(OzSweep);
    case OZ_KEY_EXTENDS:
        return 0;
    default:
        return sizeof(void *);
    }
}

_Static_assert(sizeof(OzIntegrator) == sizeof(int) && sizeof(int64_t) == sizeof(double),
               "enums are stored as int, integers and numbers in eight bytes");

static void print_default(const OzKey *key, FILE *file)
{
    if (key->required) {
        fprintf(file, "required%s%s", key->rival ? ", or " : "", key->rival ? key->rival : "");
    } else if (key->fallback || key->fallback_help) {
        fprintf(file, "default %s", key->fallback ? key->fallback : key->fallback_help);
    } else if (key->inherits) {
        fprintf(file, "%s: %s", key->shared ? "always" : "default", key->inherits);
    } else {
        fprintf(file, "optional%s%s", key->rival ? ", in place of " : "",
                key->rival ? key->rival : "");
    }
}

static void print_bits(unsigned bits, const char *path, const char *lead, FILE *file)
{
    char names[128];
    oz_describe_bits(bits, path, names, sizeof names);
    fprintf(file, "%s%s", bits ? lead : "", names);
}

static void print_owners(const OzKey *key, FILE *file)
{
    bool wall = strncmp(key->path, "walls", 5) == 0;
    print_bits(key->kinds, wall ? "walls[].kind" : "grains[].kind", "; kind ", file);
    print_bits(key->shapes, "grains[].shape", "; shape ", file);
    print_bits(key->laws, "contact.law", "; law ", file);
    bool of_elements = !key->models || (key->models >> OZ_MODEL_TRIGRAINS & 1);
    if (of_elements && strncmp(key->path, "contact.", strlen("contact.")) == 0) {
        fprintf(file, "; trigrains: discs only");
    }
}

/* The next row with the path of `key`, or NULL. */
static const OzKey *next_alike(const OzKey *key)
{
    for (const OzKey *other = key + 1; other->path; other++) {
        if (strcmp(other->path, key->path) == 0) {
            return other;
        }
    }
    return NULL;
}

/* The models that have a key of this path, as bits. */
static unsigned models_of(const char *path)
{
    unsigned models = 0;
    for (const OzKey *key = oz_keys_find(path); key; key = next_alike(key)) {
        models |= key->models ? key->models : ~0u;
    }
    return models & EVERY_MODEL;
}

static void print_expected(const OzKey *key, FILE *file)
{
    char expected[256];
    oz_describe_expected(key, expected, sizeof expected);
    fprintf(file, "%s; ", expected);
    print_default(key, file);
    print_owners(key, file);
    fputc('\n', file);
}

/* All rows of a path: what they mean, said once where they mean the same, and what each model
 * expects. */
static void print_path(const OzKey *first, FILE *file)
{
    const OzKey *second = next_alike(first);
    bool same = !second || strcmp(first->help, second->help) == 0;
    fprintf(file, "%s\n", first->path);
    if (same) {
        fprintf(file, "    %s\n", first->help);
    }
    for (const OzKey *key = first; key; key = next_alike(key)) {
        fputs("    ", file);
        print_bits(second ? key->models : 0, "model", "model ", file);
        fputs(second ? ": " : "", file);
        if (!same) {
            fprintf(file, "%s\n        ", key->help);
        }
        print_expected(key, file);
    }
}

bool oz_keys_print(const char *part, FILE *file)
{
    static const unsigned sections[] = {EVERY_MODEL, 1u << OZ_MODEL_RODS, 1u << OZ_MODEL_TRIGRAINS};
    bool any = false;
    for (size_t i = 0; i < sizeof sections / sizeof *sections; i++) {
        bool begun = false;
        for (const OzKey *key = oz_rows_all(); key->path; key++) {
            if ((part && !strstr(key->path, part)) || oz_keys_find(key->path) != key ||
                models_of(key->path) != sections[i]) {
                continue;
            }
            if (!begun) {
                fprintf(file, "%s== ", any ? "\n" : "");
                print_bits(i ? sections[i] : 0, "model", "only of model ", file);
                fputs(i ? "\n" : "of every model\n", file);
            }
            begun = any = true;
            print_path(key, file);
        }
    }
    return any;
}
