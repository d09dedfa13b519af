/* Reads one value by its row's type. Knows no key by name. */
#include "scene/value.h"

#include "base/file.h"
#include "base/memory.h"
#include "scene/describe.h"
#include "scene/sweep.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MOST_NUMBERS = 100000 }; /* in a list such as snapshots.times */

void *oz_value_at(const OzKey *key, const void *base)
{
    return (char *)(uintptr_t)base + key->offset;
}

int *oz_value_count(const OzKey *key, const void *base)
{
    return (int *)(void *)((char *)(uintptr_t)base + key->count_offset);
}

/* One message for every way to be wrong: what stands there, and what was expected. */
static bool complain(const OzKey *key, const OzNode *node, OzFaults *faults)
{
    if (!node->refused) {
        char path[256], is[128], expected[256];
        oz_tree_path(node, false, path, sizeof path);
        oz_describe_node(node, is, sizeof is);
        oz_describe_expected(key, expected, sizeof expected);
        oz_faults_add(faults, node->source, node->line, "%s is %s; expected %s", path, is,
                      expected);
    }
    return false;
}

/* A decimal number, or a fraction of two such as 2/7. */
static bool parse_number(const char *text, double *number)
{
    char *end = NULL;
    if (!text[0] || text[strspn(text, "+-.0123456789eE/")]) {
        return false;
    }
    *number = strtod(text, &end);
    if (end != text && *end == '/') {
        const char *below = end + 1;
        *number /= strtod(below, &end);
        end = end == below ? (char *)(uintptr_t)text : end;
    }
    return end != text && *end == '\0' && isfinite(*number);
}

static bool read_number(const OzKey *key, const OzNode *node, double *number, OzFaults *faults)
{
    double value = 0;
    bool plain = node->kind == OZ_NODE_SCALAR && !node->quoted && !node->refused;
    if (plain && key->infinite && strcmp(node->text, key->infinite) == 0) {
        *number = INFINITY;
        return true;
    }
    if (!plain || !parse_number(node->text, &value) || value < key->low || value > key->high) {
        return complain(key, node, faults);
    }
    *number = key->scale != 0 ? value * key->scale : value;
    return true;
}

/* Digits alone, exact over all 64 bits; or a number such as 1e6 that is whole. */
static bool parse_whole(const char *text, int64_t *whole)
{
    char *end = NULL;
    errno = 0;
    *whole = strtoll(text, &end, 10);
    if (end != text && *end == '\0') {
        return errno == 0;
    }
    double number = 0;
    bool good = parse_number(text, &number) && number == floor(number) && fabs(number) <= 1e18;
    *whole = good ? (int64_t)number : 0;
    return good;
}

static bool read_whole(const OzKey *key, const OzNode *node, int64_t *whole, OzFaults *faults)
{
    int64_t value = 0;
    bool good = node->kind == OZ_NODE_SCALAR && !node->quoted && !node->refused &&
                parse_whole(node->text, &value) && (double)value >= key->low &&
                (double)value <= key->high;
    if (!good) {
        return complain(key, node, faults);
    }
    *whole = value;
    return true;
}

static bool read_bool(const OzKey *key, const OzNode *node, bool *flag, OzFaults *faults)
{
    bool plain = node->kind == OZ_NODE_SCALAR && !node->quoted && !node->refused;
    bool yes = plain && strcmp(node->text, "true") == 0;
    if (!yes && !(plain && strcmp(node->text, "false") == 0)) {
        return complain(key, node, faults);
    }
    *flag = yes;
    return true;
}

static bool read_choice(const OzKey *key, const OzNode *node, int *choice, OzFaults *faults)
{
    bool plain = node->kind == OZ_NODE_SCALAR && !node->refused;
    bool yes = plain && key->truth && !node->quoted && strcmp(node->text, "true") == 0;
    const char *name = yes ? key->truth : node->text;
    for (int i = 0; plain && key->choices[i]; i++) {
        if (key->choices[i][0] && strcmp(name, key->choices[i]) == 0) {
            *choice = i;
            return true;
        }
    }
    return complain(key, node, faults);
}

static bool has_items(const OzKey *key, const OzNode *node, int low, int high, OzFaults *faults)
{
    bool good =
        node->kind == OZ_NODE_LIST && !node->refused && node->count >= low && node->count <= high;
    return good || complain(key, node, faults);
}

/* A single name counts as a list of one. */
static void read_choices(const OzKey *key, const OzNode *node, void *base, OzFaults *faults)
{
    int choices[8] = {0}, count = 0;
    if (node->kind == OZ_NODE_SCALAR) {
        count = read_choice(key, node, choices, faults);
    } else if (has_items(key, node, 1, key->width, faults)) {
        while (count < node->count &&
               read_choice(key, node->items[count], &choices[count], faults)) {
            count++;
        }
        count = count == node->count ? count : 0;
    }
    if (count) {
        memcpy(oz_value_at(key, base), choices, oz_keys_size(key));
        *oz_value_count(key, base) = count;
    }
}

static void read_vector(const OzKey *key, const OzNode *node, double *vector, OzFaults *faults)
{
    if (!has_items(key, node, key->width, key->width, faults)) {
        return;
    }
    for (int i = 0; i < key->width; i++) {
        OzKey element = *key;
        element.type = OZ_KEY_NUMBER;
        read_number(&element, node->items[i], &vector[i], faults);
    }
}

/* place holds int64_t, or int for a size. */
static void read_counts(const OzKey *key, const OzNode *node, void *place, OzFaults *faults)
{
    if (!has_items(key, node, key->width, key->width, faults)) {
        return;
    }
    for (int i = 0; i < key->width; i++) {
        int64_t whole = 0;
        OzKey element = *key;
        element.type = OZ_KEY_INTEGER;
        if (!read_whole(&element, node->items[i], &whole, faults)) {
            continue;
        }
        if (key->type == OZ_KEY_SIZE) {
            ((int *)place)[i] = (int)whole;
        } else {
            ((int64_t *)place)[i] = whole;
        }
    }
}

static void read_range(const OzKey *key, const OzNode *node, OzRange *range, OzFaults *faults)
{
    double low = 0, high = 0;
    if (node->kind == OZ_NODE_SCALAR) {
        if (read_number(key, node, &low, faults)) {
            *range = (OzRange){low, low};
        }
        return;
    }
    if (!has_items(key, node, 2, 2, faults)) {
        return;
    }
    bool good = read_number(key, node->items[0], &low, faults);
    good = read_number(key, node->items[1], &high, faults) && good;
    if (good && low > high) {
        oz_faults_add(faults, node->source, node->line,
                      "the range [%g, %g] runs downwards; expected [low, high]", low, high);
    } else if (good) {
        *range = (OzRange){low, high};
    }
}

static OzStatus read_numbers(const OzKey *key, const OzNode *node, void *base, OzFaults *faults)
{
    OzStatus status = OZ_OK;
    double *numbers = NULL;
    if (!has_items(key, node, 0, MOST_NUMBERS, faults)) {
        goto done;
    }
    OZ_TRY(OZ_NEW(&numbers, node->count));
    OzKey element = *key;
    element.type = OZ_KEY_NUMBER;
    for (int i = 0; i < node->count; i++) {
        read_number(&element, node->items[i], &numbers[i], faults);
    }
    oz_value_free(key, base);
    *(double **)oz_value_at(key, base) = node->count ? numbers : NULL;
    *oz_value_count(key, base) = node->count;
    if (node->count) {
        numbers = NULL;
    }
done:
    free(numbers);
    return status;
}

/* A text that later becomes a path must not depend on the folder from which it is read. */
static OzStatus make_absolute(char **path, const char *folder, const char *name)
{
    OzStatus status = OZ_OK;
    char *near = NULL, *here = getcwd(NULL, 0);
    OZ_TRY(oz_file_join(&near, folder, name));
    OZ_TRY(oz_file_join(path, here, near));
done:
    free(near);
    free(here);
    return status;
}

static OzStatus read_text(const OzKey *key, const OzNode *node, char **place, OzFaults *faults)
{
    char *text = NULL;
    OzStatus status = OZ_OK;
    if (node->kind != OZ_NODE_SCALAR || node->refused || oz_tree_is_empty(node)) {
        complain(key, node, faults);
        return OZ_OK;
    }
    if (key->type == OZ_KEY_FILE) {
        status = make_absolute(&text, node->source->folder, node->text);
        if (status == OZ_OK && !oz_file_exists(text)) {
            oz_faults_add(faults, node->source, node->line, "there is no file %.200s; expected %s",
                          node->text, key->help);
        }
    } else {
        status = oz_memory_text(&text, node->text);
    }
    if (status == OZ_OK) {
        free(*place);
        *place = text;
    }
    return status;
}

static OzStatus read_names(const OzKey *key, const OzNode *node, char **names, OzFaults *faults)
{
    if (has_items(key, node, key->width, key->width, faults)) {
        for (int i = 0; i < key->width; i++) {
            OZ_PASS(read_text(key, node->items[i], &names[i], faults));
        }
    }
    return OZ_OK;
}

OzStatus oz_value_read(const OzKey *key, const OzNode *node, void *base, OzFaults *faults)
{
    void *place = oz_value_at(key, base);
    if (key->write == OZ_WRITE_MARKED) {
        *(bool *)((char *)base + key->count_offset) = true;
    }
    switch (key->type) {
    case OZ_KEY_NUMBER:
        read_number(key, node, place, faults);
        break;
    case OZ_KEY_INTEGER:
        read_whole(key, node, place, faults);
        break;
    case OZ_KEY_BOOL:
        read_bool(key, node, place, faults);
        break;
    case OZ_KEY_CHOICE:
        read_choice(key, node, place, faults);
        break;
    case OZ_KEY_CHOICES:
        read_choices(key, node, base, faults);
        break;
    case OZ_KEY_VECTOR:
        read_vector(key, node, place, faults);
        break;
    case OZ_KEY_COUNTS:
    case OZ_KEY_SIZE:
        read_counts(key, node, place, faults);
        break;
    case OZ_KEY_RANGE:
        read_range(key, node, place, faults);
        break;
    case OZ_KEY_NUMBERS:
        return read_numbers(key, node, base, faults);
    case OZ_KEY_TEXT:
    case OZ_KEY_FILE:
        return read_text(key, node, place, faults);
    case OZ_KEY_NAMES:
        return read_names(key, node, place, faults);
    default:
        break;
    }
    return OZ_OK;
}

bool oz_value_holds(const OzKey *key, const void *base)
{
    if (key->write == OZ_WRITE_MARKED) {
        return *(const bool *)((const char *)base + key->count_offset);
    }
    switch (key->type) {
    case OZ_KEY_NUMBER:
        return *(const double *)oz_value_at(key, base) != 0;
    case OZ_KEY_TEXT:
    case OZ_KEY_FILE:
        return *(char *const *)oz_value_at(key, base) != NULL;
    case OZ_KEY_SWEEP:
        return ((const OzSweep *)oz_value_at(key, base))->count > 0;
    case OZ_KEY_CHOICES:
    case OZ_KEY_NUMBERS:
    case OZ_KEY_ITEMS:
        return *oz_value_count(key, base) > 0;
    default:
        return true;
    }
}

bool oz_value_same(const OzKey *key, const void *base, const OzKey *other, const void *other_base)
{
    size_t size = oz_keys_size(key);
    if (key->type == OZ_KEY_CHOICES) {
        int count = *oz_value_count(key, base);
        if (count != *oz_value_count(other, other_base)) {
            return false;
        }
        size = (size_t)count * sizeof(int);
    }
    return memcmp(oz_value_at(key, base), oz_value_at(other, other_base), size) == 0;
}

void oz_value_copy(const OzKey *key, void *base, const OzKey *from, const void *from_base)
{
    memcpy(oz_value_at(key, base), oz_value_at(from, from_base), oz_keys_size(key));
    if (key->type == OZ_KEY_CHOICES) {
        *oz_value_count(key, base) = *oz_value_count(from, from_base);
    }
}

/* How many texts a row owns. */
static int texts_of(const OzKey *key)
{
    bool one = key->type == OZ_KEY_TEXT || key->type == OZ_KEY_FILE;
    return one ? 1 : key->type == OZ_KEY_NAMES ? key->width : 0;
}

OzStatus oz_value_own(const OzKey *key, void *base)
{
    void **owned = oz_value_at(key, base);
    int texts = texts_of(key);
    OzStatus status = OZ_OK;
    for (int i = 0; i < texts; i++) {
        const char *text = owned[i];
        owned[i] = NULL;
        OzStatus own = oz_memory_text((char **)&owned[i], text);
        status = status == OZ_OK ? own : status;
    }
    if (key->type == OZ_KEY_NUMBERS && *owned) {
        const void *numbers = *owned;
        size_t count = (size_t)*oz_value_count(key, base);
        *owned = NULL;
        OZ_PASS(oz_memory_new(owned, count, sizeof(double), "numbers"));
        memcpy(*owned, numbers, count * sizeof(double));
    }
    return status;
}

void oz_value_free(const OzKey *key, void *base)
{
    int count = key->type == OZ_KEY_NUMBERS ? 1 : texts_of(key);
    void **owned = oz_value_at(key, base);
    for (int i = 0; i < count; i++) {
        free(owned[i]);
        owned[i] = NULL;
    }
    if (key->type == OZ_KEY_SWEEP) {
        oz_sweep_free(oz_value_at(key, base));
    }
}
