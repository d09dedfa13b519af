/* A YAML text made into a tree with the line of every value. */
#pragma once

#include "scene/tree.h"

/* Reads length bytes of YAML; *root receives the tree, NULL for an empty file; the caller frees it.
 * Refuses by name what scenes do not have: aliases, anchors, tags, `<<`, duplicate keys, further
 * documents. Fails with OZ_ERR_INPUT when reading cannot go on (wrong syntax, nesting deeper than
 * 32): faults then holds that alone. */
OzStatus oz_document_parse(OzNode **root, const char *text, size_t length, const OzSource *source,
                           OzFaults *faults);
