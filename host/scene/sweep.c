/* Reading, writing and freeing a sweep. Knows which keys there are and nothing of their values. */
#include "scene/sweep.h"

#include "base/memory.h"
#include "scene/describe.h"
#include "scene/keys.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_VALUES = 10000 };

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
           !strpbrk(node->text, ",\"'\n\r\t:#{}[]") && !isspace((unsigned char)node->text[0]);
}

static OzStatus read_values(OzSweep *sweep, const OzNode *list, OzFaults *faults)
{
    OzStatus status = OZ_OK;
    OZ_TRY(OZ_NEW(&sweep->values, list->count));
    for (int i = 0; i < list->count; i++) {
        const OzNode *node = list->items[i];
        bool again = false;
        if (!is_value(node)) {
            oz_faults_add(faults, node->source, node->line,
                          "a value of the sweep is no number or word; expected numbers or words");
            continue;
        }
        for (int k = 0; k < sweep->count; k++) {
            again |= strcmp(sweep->values[k], node->text) == 0;
        }
        if (again) {
            oz_faults_add(faults, node->source, node->line,
                          "%.40s comes twice in the sweep; expected different values", node->text);
            continue;
        }
        OZ_TRY(oz_memory_text(&sweep->values[sweep->count], node->text));
        sweep->count++;
    }
done:
    return status;
}

/* What is no sweep: anything but one key and a list of values. */
static void complain(const OzNode *node, OzFaults *faults)
{
    char is[128], what[512];
    const OzNode *entry = node->kind == OZ_NODE_MAP && node->count > 0 ? node->items[0] : NULL;
    oz_describe_node(entry ? entry : node, is, sizeof is);
    if (!entry) {
        snprintf(what, sizeof what, "sweep is %s; expected one key and its values", is);
    } else if (node->count > 1) {
        snprintf(what, sizeof what, "sweep has %d keys, %.80s and %.80s%s; expected one",
                 node->count, entry->key, node->items[1]->key, node->count > 2 ? ", ..." : "");
    } else {
        snprintf(what, sizeof what, "sweep of %.80s is %s; expected a list of 1 to %d values",
                 entry->key, is, MOST_VALUES);
    }
    oz_faults_add(faults, node->source, node->line, "%s, as in {contact.friction: [0.1, 0.2]}",
                  what);
}

OzStatus oz_sweep_read(OzSweep *sweep, const OzNode *node, int model, OzFaults *faults)
{
    OzStatus status = OZ_OK;
    const OzNode *entry = node->kind == OZ_NODE_MAP && node->count == 1 ? node->items[0] : NULL;
    if (oz_tree_is_empty(node)) {
        return OZ_OK;
    }
    if (!entry || entry->kind != OZ_NODE_LIST || entry->count < 1 || entry->count > MOST_VALUES) {
        if (!node->refused && !(entry && entry->refused)) {
            complain(node, faults);
        }
        return OZ_OK;
    }
    check_key(entry, model, faults);
    OZ_TRY(oz_memory_text(&sweep->key, entry->key));
    OZ_TRY(read_values(sweep, entry, faults));
done:
    return status;
}

void oz_sweep_write(const OzSweep *sweep, FILE *file)
{
    fprintf(file, "{%s: [", sweep->key);
    for (int i = 0; i < sweep->count; i++) {
        fprintf(file, "%s%s", i ? ", " : "", sweep->values[i]);
    }
    fputs("]}", file);
}

void oz_sweep_free(OzSweep *sweep)
{
    for (int i = 0; i < sweep->count; i++) {
        free(sweep->values[i]);
    }
    free(sweep->values);
    free(sweep->key);
    *sweep = (OzSweep){0};
}
