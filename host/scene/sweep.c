/* Reading, writing and freeing a sweep. Knows which keys there are and nothing of their values. */
#include "scene/sweep.h"

#include "base/memory.h"
#include "scene/describe.h"
#include "scene/keys.h"

#include <ctype.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define EXAMPLE "as in {contact.friction: [0.1, 0.2]}"

/* "walls.0.motion.frequency" as in the list of keys: "walls[].motion.frequency". */
static void as_key(const char *path, char *key, size_t size)
{
    size_t used = 0;
    key[0] = '\0';
    for (const char *part = path; *part && used < size;) {
        size_t length = strcspn(part, ".");
        bool number = length > 0 && strspn(part, "0123456789") == length;
        used += (size_t)(number ? snprintf(key + used, size - used, "[]")
                                : snprintf(key + used, size - used, "%s%.*s", used ? "." : "",
                                           (int)length, part));
        part += length + (part[length] == '.');
    }
}

static void check_key(const OzNode *entry, int model, OzFaults *faults)
{
    char path[256], near[256];
    as_key(entry->key, path, sizeof path);
    const OzKey *key = oz_keys_of(path, model);
    bool vector = strlen(path) > 2 && strcmp(path + strlen(path) - 2, "[]") == 0;
    if (vector) { /* an element of a vector, such as gravity.2 */
        path[strlen(path) - 2] = '\0';
        key = oz_keys_of(path, model);
    }
    if (!key && oz_describe_nearest(path, model, near, sizeof near)) {
        oz_faults_add(faults, entry->source, entry->line,
                      "sweep of an unknown key %.100s; did you mean %s?", entry->key, near);
    } else if (!key || key->type == OZ_KEY_SWEEP || key->type == OZ_KEY_EXTENDS) {
        oz_faults_add(faults, entry->source, entry->line,
                      "sweep of %.100s; expected a key of the scene such as contact.friction",
                      entry->key);
    }
}

/* A value names a folder and stands in tables: no commas, quotes or line ends. */
static bool is_value(const OzNode *node)
{
    return node->kind == OZ_NODE_SCALAR && !node->refused && node->text[0] &&
           strlen(node->text) <= OZ_SWEEP_VALUE_MAX && !strpbrk(node->text, ",\"'\n\r\t:#{}[]") &&
           !isspace((unsigned char)node->text[0]);
}

static bool comes_again(const OzSweepKey *key, const char *text)
{
    for (int k = 0; k < key->count; k++) {
        if (strcmp(key->values[k], text) == 0) {
            return true;
        }
    }
    return false;
}

static OzStatus read_values(OzSweepKey *key, const OzNode *list, bool zip, OzFaults *faults)
{
    OZ_PASS(OZ_NEW(&key->values, list->count));
    for (int i = 0; i < list->count; i++) {
        const OzNode *node = list->items[i];
        if (!is_value(node)) {
            oz_faults_add(faults, node->source, node->line,
                          "a value of the sweep is no number or word; expected numbers or words");
        } else if (!zip && comes_again(key, node->text)) {
            oz_faults_add(faults, node->source, node->line,
                          "%.40s comes twice in the sweep; expected different values", node->text);
        } else {
            OZ_PASS(oz_memory_text(&key->values[key->count], node->text));
            key->count++;
        }
    }
    return OZ_OK;
}

static OzStatus read_key(OzSweepKey *key, const OzNode *entry, int model, bool zip,
                         OzFaults *faults)
{
    if (entry->kind != OZ_NODE_LIST || entry->count < 1 ||
        entry->count > OZ_SWEEP_COMBINATIONS_MAX) {
        char is[128];
        oz_describe_node(entry, is, sizeof is);
        if (!entry->refused) {
            oz_faults_add(faults, entry->source, entry->line,
                          "sweep of %.80s is %s; expected a list of 1 to %d values, " EXAMPLE,
                          entry->key, is, OZ_SWEEP_COMBINATIONS_MAX);
        }
        return OZ_OK;
    }
    check_key(entry, model, faults);
    OZ_PASS(oz_memory_text(&key->path, entry->key));
    if (asprintf(&key->place, "%s:%d", entry->source->name, entry->line) < 0) {
        key->place = NULL;
        return oz_status_fail(OZ_ERR_MEMORY, "out of memory for a sweep");
    }
    return read_values(key, entry, zip, faults);
}

static bool is_zip(const OzNode *entry)
{
    return strcmp(entry->key, "zip") == 0;
}

static bool read_zip(const OzNode *node, OzFaults *faults)
{
    const OzNode *zip = oz_tree_child(node, "zip");
    bool yes = zip && zip->kind == OZ_NODE_SCALAR && strcmp(zip->text, "true") == 0;
    bool no = !zip || (zip->kind == OZ_NODE_SCALAR && strcmp(zip->text, "false") == 0);
    if (!yes && !no && !zip->refused) {
        char is[128];
        oz_describe_node(zip, is, sizeof is);
        oz_faults_add(faults, zip->source, zip->line, "sweep.zip is %s; expected true or false",
                      is);
    }
    return yes;
}

/* How many combinations there are; none, with a fault, where that makes no sense. */
static int count_combinations(const OzSweep *sweep, const OzNode *node, OzFaults *faults)
{
    const OzSweepKey *first = &sweep->keys[0];
    double count = 1;
    for (int k = 0; k < sweep->key_count; k++) {
        const OzSweepKey *key = &sweep->keys[k];
        if (sweep->zip && key->count != first->count) {
            oz_faults_add(faults, node->source, node->line,
                          "sweep of %.80s has %d values and of %.80s %d; expected as many for each "
                          "with zip",
                          first->path, first->count, key->path, key->count);
            return 0;
        }
        count = sweep->zip ? key->count : count * key->count;
    }
    if (count > OZ_SWEEP_COMBINATIONS_MAX) {
        oz_faults_add(faults, node->source, node->line,
                      "sweep has %.6g combinations; expected at most %d", count,
                      OZ_SWEEP_COMBINATIONS_MAX);
        return 0;
    }
    return (int)count;
}

/* Texts of all keys, joined by commas: their paths (i < 0), or their values in combination i. */
static OzStatus join(char **joined, const OzSweep *sweep, int i)
{
    char text[OZ_SWEEP_KEYS_MAX * (OZ_SWEEP_VALUE_MAX + 160)] = "";
    for (int k = 0; k < sweep->key_count; k++) {
        size_t used = strlen(text);
        snprintf(text + used, sizeof text - used, "%s%s", k ? "," : "",
                 i < 0 ? sweep->keys[k].path : oz_sweep_value(sweep, i, k));
    }
    return oz_memory_text(joined, text);
}

static OzStatus combine(OzSweep *sweep, int count)
{
    if (count == 0) {
        return OZ_OK;
    }
    OZ_PASS(join(&sweep->key, sweep, -1));
    OZ_PASS(OZ_NEW(&sweep->values, count));
    for (; sweep->count < count; sweep->count++) {
        OZ_PASS(join(&sweep->values[sweep->count], sweep, sweep->count));
    }
    return OZ_OK;
}

static bool is_sweep(const OzNode *node, OzFaults *faults)
{
    char is[128];
    int keys = node->count - (oz_tree_child(node, "zip") != NULL);
    if (node->kind == OZ_NODE_MAP && keys >= 1 && keys <= OZ_SWEEP_KEYS_MAX) {
        return true;
    }
    oz_describe_node(node, is, sizeof is);
    if (node->kind == OZ_NODE_MAP) {
        snprintf(is, sizeof is, "a group of %d keys", keys);
    }
    if (!node->refused) {
        oz_faults_add(faults, node->source, node->line,
                      "sweep is %s; expected 1 to %d keys, each with a list of values, " EXAMPLE,
                      is, OZ_SWEEP_KEYS_MAX);
    }
    return false;
}

OzStatus oz_sweep_read(OzSweep *sweep, const OzNode *node, int model, OzFaults *faults)
{
    int before = faults->count;
    if (oz_tree_is_empty(node) || !is_sweep(node, faults)) {
        return OZ_OK;
    }
    sweep->zip = read_zip(node, faults);
    OZ_PASS(OZ_NEW(&sweep->keys, node->count));
    for (int i = 0; i < node->count; i++) {
        if (!is_zip(node->items[i])) {
            OZ_PASS(read_key(&sweep->keys[sweep->key_count++], node->items[i], model, sweep->zip,
                             faults));
        }
    }
    if (faults->count == before && !node->refused) {
        OZ_PASS(combine(sweep, count_combinations(sweep, node, faults)));
    }
    return OZ_OK;
}

const char *oz_sweep_value(const OzSweep *sweep, int64_t i, int k)
{
    for (int later = k + 1; !sweep->zip && later < sweep->key_count; later++) {
        i /= sweep->keys[later].count;
    }
    return sweep->keys[k].values[i % sweep->keys[k].count];
}

void oz_sweep_write(const OzSweep *sweep, FILE *file)
{
    for (int k = 0; k < sweep->key_count; k++) {
        const OzSweepKey *key = &sweep->keys[k];
        fprintf(file, "%s%s: [", k ? ", " : "{", key->path);
        for (int i = 0; i < key->count; i++) {
            fprintf(file, "%s%s", i ? ", " : "", key->values[i]);
        }
        fputc(']', file);
    }
    fprintf(file, "%s}", sweep->zip ? ", zip: true" : "");
}

static void free_texts(char **texts, int count)
{
    for (int i = 0; i < count; i++) {
        free(texts[i]);
    }
    free(texts);
}

static OzStatus copy_texts(char ***copy, char *const *texts, int count)
{
    OZ_PASS(OZ_NEW(copy, count));
    for (int i = 0; i < count; i++) {
        OZ_PASS(oz_memory_text(&(*copy)[i], texts[i]));
    }
    return OZ_OK;
}

OzStatus oz_sweep_copy(OzSweep *copy, const OzSweep *sweep)
{
    *copy = (OzSweep){.zip = sweep->zip};
    OZ_PASS(oz_memory_text(&copy->key, sweep->key));
    if (sweep->count > 0) {
        OZ_PASS(copy_texts(&copy->values, sweep->values, sweep->count));
        copy->count = sweep->count;
    }
    if (sweep->key_count > 0) {
        OZ_PASS(OZ_NEW(&copy->keys, sweep->key_count));
    }
    for (; copy->key_count < sweep->key_count; copy->key_count++) {
        OzSweepKey *to = &copy->keys[copy->key_count];
        const OzSweepKey *from = &sweep->keys[copy->key_count];
        OZ_PASS(oz_memory_text(&to->path, from->path));
        OZ_PASS(oz_memory_text(&to->place, from->place));
        OZ_PASS(copy_texts(&to->values, from->values, from->count));
        to->count = from->count;
    }
    return OZ_OK;
}

void oz_sweep_free(OzSweep *sweep)
{
    for (int k = 0; k < sweep->key_count; k++) {
        free_texts(sweep->keys[k].values, sweep->keys[k].count);
        free(sweep->keys[k].path);
        free(sweep->keys[k].place);
    }
    free(sweep->keys);
    free_texts(sweep->values, sweep->count);
    free(sweep->key);
    *sweep = (OzSweep){0};
}
