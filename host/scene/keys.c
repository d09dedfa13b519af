/* Looking rows up. Knows their columns and no key by name but where names of
 * choices are shown. */
#include "scene/keys.h"

#include "scene/rows.h"
#include "scene/scene_types.h"

#include <stdint.h>
#include <string.h>

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

const OzKey *oz_keys_of_kind(const char *path, int model, unsigned kinds)
{
    const OzKey *first = oz_keys_of(path, model);
    for (const OzKey *key = first; key && key->path; key++) {
        if (strcmp(key->path, path) == 0 && oz_keys_serves(key, model) &&
            (!key->kinds || key->kinds & kinds)) {
            return key;
        }
    }
    return first;
}

unsigned oz_keys_kinds(const char *path, int model)
{
    unsigned kinds = 0;
    for (const OzKey *key = oz_keys_of(path, model); key && key->path; key++) {
        if (strcmp(key->path, path) == 0 && oz_keys_serves(key, model)) {
            kinds |= key->kinds;
        }
    }
    return kinds;
}

const OzKey *oz_keys_end(const OzKey *first, size_t length)
{
    const OzKey *end = first + 1;
    while (end->path && strncmp(end->path, first->path, length) == 0 &&
           (end->path[length] == '.' || end->path[length] == '[')) {
        end++;
    }
    return end;
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
    case OZ_KEY_NAMES:
        return (size_t)key->width * sizeof(char *);
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
