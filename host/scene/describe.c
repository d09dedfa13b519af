/* Keys in words. Knows the list of keys and no value of any. */
#include "scene/describe.h"

#include "base/spelling.h"
#include "scene/scene_types.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LONGEST_NAME = 40, EVERY_MODEL = 1 << OZ_MODEL_RODS | 1 << OZ_MODEL_TRIGRAINS };

static void print_choices(const OzKey *key, FILE *file)
{
    const char *lead = "";
    for (int i = 0; key->choices[i]; i++) {
        if (key->choices[i][0]) {
            fprintf(file, "%s%s", lead, key->choices[i]);
            lead = ", ";
        }
    }
}

/* As a person writes it: 1e6 rather than 1e+06. */
static void print_limit(double number, FILE *file)
{
    char text[32];
    snprintf(text, sizeof text, "%g", number);
    char *exponent = strchr(text, 'e');
    if (exponent) {
        snprintf(exponent + 1, sizeof text - (size_t)(exponent + 1 - text), "%d",
                 atoi(exponent + 1));
    }
    fputs(text, file);
}

static void print_limits(const OzKey *key, FILE *file)
{
    fputs("from ", file);
    print_limit(key->low, file);
    fputs(" to ", file);
    print_limit(key->high, file);
    fprintf(file, "%s%s", key->unit[0] ? " " : "", key->unit);
}

/* Whether a list's items have a kind. */
static bool has_kind(const OzKey *list)
{
    char path[96];
    snprintf(path, sizeof path, "%s[].kind", list->path);
    return oz_keys_find(path) != NULL;
}

static const char *noun(const OzKey *key)
{
    switch (key->type) {
    case OZ_KEY_NUMBER:
        return "a number ";
    case OZ_KEY_INTEGER:
        return "a whole number ";
    case OZ_KEY_BOOL:
        return "true or false";
    case OZ_KEY_TEXT:
        return "a text";
    case OZ_KEY_FILE:
    case OZ_KEY_EXTENDS:
        return "a file name";
    case OZ_KEY_CHOICE:
        return "one of ";
    case OZ_KEY_RANGE:
        return "a number or [low, high] ";
    case OZ_KEY_NUMBERS:
        return "a list of numbers ";
    case OZ_KEY_SWEEP:
        return "keys, each with a list of values";
    case OZ_KEY_SECTION:
        return "a group of keys, or false to leave it out";
    case OZ_KEY_ITEMS:
        return has_kind(key) ? "a list of groups, each with its kind" : "a list of groups";
    default:
        return "";
    }
}

static void print_expected(const OzKey *key, FILE *file)
{
    fputs(noun(key), file);
    if (key->type == OZ_KEY_CHOICES) {
        fprintf(file, key->width > 1 ? "a list of 1 to %d of " : "a list of %d of ", key->width);
    } else if (key->type == OZ_KEY_VECTOR) {
        fprintf(file, "a list of %d numbers ", key->width);
    } else if (key->type == OZ_KEY_NAMES) {
        fprintf(file, "a list of %d names", key->width);
    } else if (key->type == OZ_KEY_COUNTS || key->type == OZ_KEY_SIZE) {
        fprintf(file, "a list of %d whole numbers ", key->width);
    }
    if (key->choices) {
        print_choices(key, file);
    } else if (key->high > key->low) {
        print_limits(key, file);
    }
    if (key->infinite) {
        fprintf(file, ", or %s", key->infinite);
    }
}

void oz_describe_expected(const OzKey *key, char *text, size_t size)
{
    text[0] = '\0';
    FILE *file = fmemopen(text, size, "w");
    if (file) {
        print_expected(key, file);
        fclose(file);
    }
    text[size - 1] = '\0';
}

void oz_describe_node(const OzNode *node, char *text, size_t size)
{
    if (node->kind == OZ_NODE_LIST) {
        snprintf(text, size, "a list of %d", node->count);
    } else if (node->kind == OZ_NODE_MAP) {
        snprintf(text, size, "a group of keys");
    } else if (oz_tree_is_empty(node)) {
        snprintf(text, size, "empty");
    } else if (node->quoted) {
        snprintf(text, size, "the text '%.*s'", LONGEST_NAME, node->text);
    } else {
        snprintf(text, size, "%.*s", LONGEST_NAME, node->text);
    }
}

static size_t group_length(const char *path)
{
    const char *dot = strrchr(path, '.');
    return dot ? (size_t)(dot - path) + 1 : 0;
}

/* The next name of a row's path at start, without its dot or brackets. */
static size_t name_at(const char *start, char name[LONGEST_NAME + 1])
{
    size_t length = strcspn(start, ".[");
    snprintf(name, LONGEST_NAME + 1, "%.*s", (int)length, start);
    return length;
}

/* Letters of a path up to the end of its list's name; 0 outside of lists. */
static size_t list_length(const char *path)
{
    const char *brackets = strstr(path, "[]");
    return brackets ? (size_t)(brackets - path) + strlen("[]") : 0;
}

/* How far away the same name is elsewhere: nearest in the same list's items, never in another's, of
 * which a person who writes here has not thought. */
static int how_far_elsewhere(const OzKey *key, const char *path)
{
    size_t own = list_length(path), other = list_length(key->path);
    bool same = own == other && strncmp(path, key->path, own) == 0;
    return own && other && !same ? LONGEST_NAME : own && same ? 0 : 1;
}

/* How far `meant` is from the row's name within the group, which begins at group; *length is that
 * name's end. A name that belongs elsewhere must be spelled right. */
static int how_far(const OzKey *key, const char *path, size_t group, size_t *length)
{
    char name[LONGEST_NAME + 1];
    size_t own = group_length(key->path);
    name_at(key->path + own, name);
    if (strcmp(path + group, name) == 0) {
        *length = own + strlen(name);
        return how_far_elsewhere(key, path);
    }
    if (strncmp(key->path, path, group) != 0) {
        return LONGEST_NAME;
    }
    *length = group + name_at(key->path + group, name);
    int letters = (int)strlen(path + group), more = (int)strlen(name) - letters;
    return abs(more) > oz_spelling_slips((size_t)letters)
               ? LONGEST_NAME
               : oz_spelling_distance(path + group, name);
}

bool oz_describe_nears(const char *path, const OzKey *key)
{
    size_t group = group_length(path), length = 0, letters = strlen(path + group);
    return letters <= LONGEST_NAME &&
           how_far(key, path, group, &length) <= oz_spelling_slips(letters);
}

bool oz_describe_nearest(const char *path, int model, char *nearest, size_t size)
{
    size_t group = group_length(path);
    size_t letters = strlen(path + group);
    if (letters > LONGEST_NAME) {
        return false;
    }
    int best = oz_spelling_slips(letters) + 1;
    bool found = false;
    for (const OzKey *key = oz_keys_all(); key->path; key++) {
        size_t length = 0;
        int away = oz_keys_serves(key, model) ? how_far(key, path, group, &length) : best;
        if (away < best) {
            best = away;
            found = true;
            snprintf(nearest, size, "%.*s", (int)length, key->path);
        }
    }
    return found;
}

void oz_describe_names(const char *group, int model, unsigned kinds, unsigned shapes, char *text,
                       size_t size)
{
    size_t start = strlen(group) + (group[0] != '\0'), used = 0;
    char last[LONGEST_NAME + 1] = "";
    text[0] = '\0';
    for (const OzKey *key = oz_keys_all(); key->path && used < size; key++) {
        char name[LONGEST_NAME + 1];
        bool below = oz_keys_serves(key, model) && strncmp(key->path, group, strlen(group)) == 0 &&
                     (start == 0 || key->path[start - 1] == '.');
        bool fits = (!key->kinds || !kinds || key->kinds & kinds) &&
                    (!key->shapes || !shapes || key->shapes & shapes);
        if (below && fits && name_at(key->path + start, name) && strcmp(name, last) != 0) {
            used += (size_t)snprintf(text + used, size - used, "%s%s", used ? ", " : "", name);
            strcpy(last, name);
        }
    }
}

void oz_describe_bits(unsigned bits, const char *path, char *text, size_t size)
{
    size_t used = 0;
    text[0] = '\0';
    for (int i = 0; i < 32 && used < size; i++) {
        if (bits >> i & 1) {
            used += (size_t)snprintf(text + used, size - used, "%s%s", used ? " or " : "",
                                     oz_keys_choice_name(path, i));
        }
    }
}

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

static void print_row(const OzKey *key, FILE *file)
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
        print_row(key, file);
    }
}

/* Whether a row's path holds the part, or with by_text anything that is printed of it. */
static bool holds(const OzKey *key, const char *part, bool by_text)
{
    if (!part || !by_text) {
        return !part || strstr(key->path, part);
    }
    char *text = NULL;
    size_t size = 0;
    FILE *file = open_memstream(&text, &size);
    if (!file) {
        return false;
    }
    print_path(key, file);
    bool does = fclose(file) == 0 && strcasestr(text, part);
    free(text);
    return does;
}

static bool describe_keys(const char *part, bool by_text, FILE *file)
{
    static const unsigned sections[] = {EVERY_MODEL, 1u << OZ_MODEL_RODS, 1u << OZ_MODEL_TRIGRAINS};
    bool any = false;
    for (size_t i = 0; i < sizeof sections / sizeof *sections; i++) {
        bool begun = false;
        for (const OzKey *key = oz_keys_all(); key->path; key++) {
            if (oz_keys_find(key->path) != key || !holds(key, part, by_text) ||
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

bool oz_describe_keys(const char *part, FILE *file)
{
    return describe_keys(part, false, file) || (part && describe_keys(part, true, file));
}
