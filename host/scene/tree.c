/* The tree of a scene file: making, finding and freeing values. The YAML itself is read in
 * document.c. */
#include "scene/tree.h"

#include "base/memory.h"

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

OzNode *oz_tree_child(const OzNode *map, const char *key)
{
    for (int i = 0; map->kind == OZ_NODE_MAP && i < map->count; i++) {
        if (strcmp(map->items[i]->key, key) == 0) {
            return map->items[i];
        }
    }
    return NULL;
}

static OzNode *list_item(const OzNode *list, const char *name)
{
    char *end = NULL;
    long index = strtol(name, &end, 10);
    bool whole = name[0] >= '0' && name[0] <= '9' && *end == '\0';
    return whole && index < list->count ? list->items[index] : NULL;
}

/* Goes down path as far as it exists; *rest is the part that does not. */
static OzNode *descend(OzNode *node, const char *path, const char **rest)
{
    *rest = path;
    while (**rest) {
        size_t length = strcspn(*rest, ".");
        char *name = strndup(*rest, length);
        OzNode *next = !name                        ? NULL
                       : node->kind == OZ_NODE_LIST ? list_item(node, name)
                                                    : oz_tree_child(node, name);
        free(name);
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

static void print_path(const OzNode *node, bool as_key, FILE *file)
{
    if (!node->parent) {
        return;
    }
    print_path(node->parent, as_key, file);
    if (node->parent->kind == OZ_NODE_LIST && as_key) {
        fputs("[]", file);
        return;
    }
    const char *dot = node->parent->parent ? "." : "";
    if (node->parent->kind == OZ_NODE_LIST) {
        fprintf(file, "%s%d", dot, node->index);
    } else {
        fprintf(file, "%s%s", dot, node->key);
    }
}

void oz_tree_path(const OzNode *node, bool as_key, char *path, size_t size)
{
    path[0] = '\0';
    FILE *file = fmemopen(path, size, "w");
    if (file) {
        print_path(node, as_key, file);
        fclose(file);
    }
    path[size - 1] = '\0';
}

bool oz_tree_is_empty(const OzNode *node)
{
    return node->kind == OZ_NODE_SCALAR && !node->quoted &&
           (node->text[0] == '\0' || strcmp(node->text, "~") == 0 ||
            strcmp(node->text, "null") == 0);
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
