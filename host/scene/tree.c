/* The tree of a scene file: making, finding and freeing values. The YAML itself is read in
 * document.c. */
#include "scene/tree.h"

#include "base/memory.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

OzStatus oz_tree_create(OzNode **node, OzNodeKind kind, const OzSource *source, int line,
                        const char *key, const char *text)
{
    OzStatus status = OZ_OK;
    OZ_TRY(OZ_NEW(node, 1));
    (*node)->kind = kind;
    (*node)->source = source;
    (*node)->line = line;
    OZ_TRY(oz_memory_text(&(*node)->key, key));
    OZ_TRY(oz_memory_text(&(*node)->text, text));
done:
    if (status != OZ_OK) {
        oz_tree_free(*node);
        *node = NULL;
    }
    return status;
}

/* Room doubles at every power of two, so that long lists stay linear. */
static OzStatus make_room(OzNode *parent)
{
    size_t count = (size_t)parent->count;
    if (count & (count - 1)) {
        return OZ_OK;
    }
    return oz_memory_grow((void **)&parent->items, count, count ? 2 * count : 1,
                          sizeof *parent->items, "a scene file's values");
}

OzStatus oz_tree_add(OzNode *parent, OzNode *child)
{
    OzStatus status = make_room(parent);
    if (status != OZ_OK) {
        oz_tree_free(child);
        return status;
    }
    child->parent = parent;
    child->index = parent->count;
    parent->items[parent->count++] = child;
    return OZ_OK;
}

void oz_tree_detach(OzNode *child)
{
    OzNode *parent = child->parent;
    parent->count--;
    for (int i = child->index; i < parent->count; i++) {
        parent->items[i] = parent->items[i + 1];
        parent->items[i]->index = i;
    }
    child->parent = NULL;
}

/* The entry named by the first length letters of name. */
static OzNode *find_entry(const OzNode *map, const char *name, size_t length)
{
    for (int i = 0; map->kind == OZ_NODE_MAP && i < map->count; i++) {
        const char *key = map->items[i]->key;
        if (strncmp(key, name, length) == 0 && key[length] == '\0') {
            return map->items[i];
        }
    }
    return NULL;
}

OzNode *oz_tree_child(const OzNode *map, const char *key)
{
    return find_entry(map, key, strlen(key));
}

static OzNode *find_item(const OzNode *list, const char *name, size_t length)
{
    char *end = NULL;
    long index = strtol(name, &end, 10);
    bool whole = length > 0 && name[0] >= '0' && name[0] <= '9' && end == name + length;
    return whole && index < list->count ? list->items[index] : NULL;
}

/* Goes down path as far as it exists; *rest is the part that does not. */
static OzNode *descend(OzNode *node, const char *path, const char **rest)
{
    *rest = path;
    while (**rest) {
        size_t length = strcspn(*rest, ".");
        OzNode *next = node->kind == OZ_NODE_LIST ? find_item(node, *rest, length)
                                                  : find_entry(node, *rest, length);
        if (!next) {
            break;
        }
        node = next;
        *rest += length + ((*rest)[length] == '.');
    }
    return node;
}

OzNode *oz_tree_at(OzNode *root, const char *path)
{
    const char *rest = NULL;
    OzNode *node = descend(root, path, &rest);
    return *rest ? NULL : node;
}

OzNode *oz_tree_nearest(OzNode *root, const char *path)
{
    const char *rest = NULL;
    return descend(root, path, &rest);
}

/* Appends text to a path of `used` characters, as much of it as fits; returns the new length. */
static size_t append(char *path, size_t size, size_t used, const char *text)
{
    size_t length = strnlen(text, size - 1 - used);
    memcpy(path + used, text, length);
    path[used + length] = '\0';
    return used + length;
}

/* Writes the path of node; returns its length. */
static size_t write_path(const OzNode *node, bool as_key, char *path, size_t size)
{
    if (!node->parent) {
        return 0;
    }
    size_t used = write_path(node->parent, as_key, path, size);
    bool entry = node->parent->kind == OZ_NODE_MAP;
    char number[16];
    if (!entry && as_key) {
        return append(path, size, used, "[]");
    }
    if (node->parent->parent) {
        used = append(path, size, used, ".");
    }
    if (!entry) {
        snprintf(number, sizeof number, "%d", node->index);
    }
    return append(path, size, used, entry ? node->key : number);
}

void oz_tree_path(const OzNode *node, bool as_key, char *path, size_t size)
{
    path[0] = '\0';
    write_path(node, as_key, path, size);
}

void oz_tree_fault(OzNode *root, OzFaults *faults, const char *path, const char *format, ...)
{
    char text[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    const OzNode *node = oz_tree_nearest(root, path);
    oz_faults_add(faults, node->source, node->line, "%s", text);
}

bool oz_tree_is_empty(const OzNode *node)
{
    return node->kind == OZ_NODE_SCALAR && !node->quoted &&
           (node->text[0] == '\0' || strcmp(node->text, "~") == 0 ||
            strcmp(node->text, "null") == 0);
}

bool oz_tree_is_false(const OzNode *node)
{
    return node->kind == OZ_NODE_SCALAR && !node->quoted && !node->refused &&
           strcmp(node->text, "false") == 0;
}

void oz_tree_free(OzNode *node)
{
    if (!node) {
        return;
    }
    for (int i = 0; i < node->count; i++) {
        oz_tree_free(node->items[i]);
    }
    free(node->items);
    free(node->key);
    free(node->text);
    free(node);
}
