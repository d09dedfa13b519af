/* A scene file as a tree of values, each knowing where it was written. Knows nothing of keys. */
#pragma once

#include "base/status.h"
#include "scene/faults.h"

#include <stdbool.h>
#include <stddef.h>

enum { OZ_TREE_DEEPEST = 32 }; /* levels; scenes need 5, and all that walks a tree recurses */

typedef enum OzNodeKind { OZ_NODE_SCALAR, OZ_NODE_LIST, OZ_NODE_MAP } OzNodeKind;

typedef struct OzNode OzNode;
struct OzNode {
    OzNodeKind kind;
    const OzSource *source; /* borrowed; outlives the tree                     */
    int line;               /* from 1; of the key where there is one           */
    bool quoted;            /* a scalar in quotes is a text, never a number    */
    bool refused;           /* a fault was added already: say no more about it */
    char *key;              /* its name in the parent map, else NULL           */
    char *text;             /* a scalar's text, else NULL                      */
    OzNode *parent;
    OzNode **items;   /* of a list or map                                */
    int count, index; /* index: its place in the parent                  */
};

/* A new scalar, list or map; key and text may be NULL and are copied. */
OzStatus oz_tree_create(OzNode **node, OzNodeKind kind, const OzSource *source, int line,
                        const char *key, const char *text);

/* Puts child last into parent, which owns it from now on, also when this fails. */
OzStatus oz_tree_add(OzNode *parent, OzNode *child);

/* Takes a child out of its parent; the caller owns it. */
void oz_tree_detach(OzNode *child);

/* The entry of that name, or NULL; a list or scalar has none. */
OzNode *oz_tree_child(const OzNode *map, const char *key);

/* The value at a dotted path (`walls.0.motion`), or NULL. */
OzNode *oz_tree_at(OzNode *root, const char *path);

/* The same, or the deepest value on the way to it: where to complain. */
OzNode *oz_tree_nearest(OzNode *root, const char *path);

/* `walls.0.motion`, or as a key's path `walls[].motion`; cut to size. */
void oz_tree_path(const OzNode *node, bool as_key, char *path, size_t size);

/* Adds a fault where path was written, or at the deepest group on the way to it. */
void oz_tree_fault(OzNode *root, OzFaults *faults, const char *path, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* True for a value left empty: `key:`, `~` or `null`. */
bool oz_tree_is_empty(const OzNode *node);

/* True for a plain `false`: what is left out. */
bool oz_tree_is_false(const OzNode *node);

/* Frees a root or detached node with all below it; NULL is fine. */
void oz_tree_free(OzNode *node);
