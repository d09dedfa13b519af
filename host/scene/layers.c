/* Merging for `extends` and `--set`. Knows rivals from the list of keys, nothing of values. */
#include "scene/layers.h"

#include "base/memory.h"
#include "scene/document.h"
#include "scene/keys.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const OzKey *key_of(const OzNode *map, const char *name)
{
    char path[256];
    oz_tree_path(map, true, path, sizeof path);
    size_t used = strlen(path);
    snprintf(path + used, sizeof path - used, "%s%s", used ? "." : "", name);
    return oz_keys_find(path);
}

/* The entry of map that says in another way what `name` would, or NULL: also where it says only
 * that it is left out. */
static OzNode *rival_of(const OzNode *map, const char *name)
{
    const OzKey *key = key_of(map, name);
    OzNode *rival = key && key->rival ? oz_tree_child(map, key->rival) : NULL;
    return rival && !oz_tree_is_false(rival) ? rival : NULL;
}

/* A group of keys; a sweep is one value, whose keys go together. */
static bool is_group(const OzNode *map, const OzNode *entry)
{
    const OzKey *key = key_of(map, entry->key);
    return entry->kind == OZ_NODE_MAP && !(key && key->type == OZ_KEY_SWEEP);
}

OzStatus oz_layers_merge(OzNode *upper, OzNode *lower)
{
    for (int i = lower->count - 1; i >= 0; i--) {
        OzNode *entry = lower->items[i];
        OzNode *over = oz_tree_child(upper, entry->key);
        OzStatus status = OZ_OK;
        if (over && is_group(upper, over) && entry->kind == OZ_NODE_MAP) {
            status = oz_layers_merge(over, entry);
        } else if (!over) {
            OzNode *rival = rival_of(upper, entry->key);
            if (!rival || rival->source == entry->source) {
                oz_tree_detach(entry);
                status = oz_tree_add(upper, entry);
            }
        }
        if (status != OZ_OK) {
            return status;
        }
    }
    return OZ_OK;
}

static OzStatus put_entry(OzNode *map, const char *name, OzNode *value)
{
    OzNode *old = oz_tree_child(map, name);
    OzNode *rival = oz_tree_is_false(value) ? NULL : rival_of(map, name);
    OzNode *gone[] = {old, rival && !rival->source->setting ? rival : NULL};
    for (int i = 0; i < 2; i++) {
        if (gone[i]) {
            oz_tree_detach(gone[i]);
            oz_tree_free(gone[i]);
        }
    }
    free(value->key);
    OzStatus status = oz_memory_text(&value->key, name);
    if (status != OZ_OK) {
        oz_tree_free(value);
        return status;
    }
    return oz_tree_add(map, value);
}

/* The entry of a name, which may be empty: there is none of that name, and a path of no names would
 * be the node itself. */
static OzNode *entry_of(OzNode *node, const char *name)
{
    return name[0] ? oz_tree_at(node, name) : NULL;
}

/* Puts value at place `name` of a list; a list never grows by a setting. */
static void put_item(OzNode *list, const char *name, OzNode *value, OzFaults *faults)
{
    OzNode *old = entry_of(list, name);
    char path[256];
    oz_tree_path(list, false, path, sizeof path);
    if (!old) {
        oz_faults_add(faults, value->source, 1,
                      "%s has no entry %.40s; expected one of its %d, counted from 0", path, name,
                      list->count);
        oz_tree_free(value);
        return;
    }
    value->parent = list;
    value->index = old->index;
    list->items[old->index] = value;
    oz_tree_free(old);
}

/* What stands at `name` of map before anything was written there: a list's default, so that
 * gravity.2 can be set alone, else an empty group. */
static OzStatus make_entry(OzNode **entry, OzNode *map, const char *name, const OzSource *source,
                           OzFaults *faults)
{
    const OzKey *key = key_of(map, name);
    if (key && key->fallback && key->fallback[0] == '[') {
        OZ_PASS(oz_document_parse(entry, key->fallback, strlen(key->fallback), source, faults));
    } else {
        OZ_PASS(oz_tree_create(entry, OZ_NODE_MAP, source, 1, NULL, NULL));
    }
    return put_entry(map, name, *entry);
}

/* The group or list in which the path's next name is looked up: the entry `name` of node, made if
 * missing. *next stays NULL, with a fault, where there is no way. */
static OzStatus enter(OzNode *node, const char *name, const OzSource *source, OzNode **next,
                      OzFaults *faults)
{
    OzNode *child = entry_of(node, name);
    bool scalar = child && child->kind == OZ_NODE_SCALAR;
    *next = NULL;
    if (node->kind == OZ_NODE_MAP && (!child || scalar)) {
        OZ_PASS(make_entry(&child, node, name, source, faults));
    }
    if (!child || child->kind == OZ_NODE_SCALAR) {
        char path[256];
        oz_tree_path(node, false, path, sizeof path);
        oz_faults_add(faults, source, 1,
                      "%s has no group %.40s; expected one of its %d, counted from 0", path, name,
                      node->count);
        child = NULL;
    }
    *next = child;
    return OZ_OK;
}

static bool is_too_deep(const char *path)
{
    int names = 1;
    for (; *path; path++) {
        names += *path == '.';
    }
    return names > OZ_TREE_DEEPEST;
}

OzStatus oz_layers_set(OzNode *root, const char *path, OzNode *value, OzFaults *faults)
{
    OzStatus status = OZ_OK;
    OzNode *node = root;
    char *copy = NULL, *rest = NULL;
    if (is_too_deep(path)) {
        oz_faults_add(faults, value->source, 1, "%.40s... names more than %d groups; expected a key",
                      path, OZ_TREE_DEEPEST);
        goto done;
    }
    OZ_TRY(oz_memory_text(&copy, path));
    rest = copy;
    const char *name = strsep(&rest, ".");
    while (rest && node) {
        OZ_TRY(enter(node, name, value->source, &node, faults));
        name = strsep(&rest, ".");
    }
    if (node && node->kind == OZ_NODE_LIST) {
        put_item(node, name, value, faults);
        value = NULL;
    } else if (node) {
        OzNode *entry = value;
        value = NULL;
        OZ_TRY(put_entry(node, name, entry));
    }
done:
    oz_tree_free(value);
    free(copy);
    return status;
}

static bool may_be_missing(const OzKey *key)
{
    return !key->required && !key->fallback && !key->shared;
}

/* Whether `false` at path means that nothing stands there. */
static bool is_optional(const char *path, int model)
{
    const OzKey *key = oz_keys_of(path, model);
    size_t length = strlen(path);
    bool any = false;
    if (key) {
        return key->type == OZ_KEY_SECTION ||
               (may_be_missing(key) && !key->inherits && key->type != OZ_KEY_EXTENDS);
    }
    for (key = oz_keys_all(); key->path; key++) {
        if (strncmp(key->path, path, length) == 0 && key->path[length] == '.' &&
            oz_keys_serves(key, model)) {
            if (key->required || key->fallback) {
                return false;
            }
            any = true;
        }
    }
    return any;
}

/* Whether the node is an item of a list of groups. */
static bool is_item(const OzNode *node)
{
    char path[256];
    oz_tree_path(node->parent, true, path, sizeof path);
    const OzKey *list = oz_keys_find(path);
    return list && list->type == OZ_KEY_ITEMS;
}

void oz_layers_drop(OzNode *root, int model)
{
    for (int i = root->count - 1; i >= 0; i--) {
        OzNode *node = root->items[i];
        char path[256];
        oz_tree_path(node, true, path, sizeof path);
        if (oz_tree_is_false(node) && (is_item(node) || is_optional(path, model))) {
            oz_tree_detach(node);
            oz_tree_free(node);
        } else {
            oz_layers_drop(node, model);
        }
    }
}
