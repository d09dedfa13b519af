/* One key's value: from text into memory, and its place there. */
#pragma once

#include "scene/keys.h"
#include "scene/tree.h"

/* Puts the node's value at the row's place in base (an OzScene or a list's item). Adds a fault and
 * leaves base as it was when the node is not what the row expects. Sections, items and `extends`
 * are not read here. Fails with OZ_ERR_MEMORY alone. */
OzStatus oz_value_read(const OzKey *key, const OzNode *node, void *base, OzFaults *faults);

/* False for 0, no text and an empty list. */
bool oz_value_holds(const OzKey *key, const void *base);

/* The row's place in base. */
void *oz_value_at(const OzKey *key, const void *base);

/* How many elements a list row holds. */
int *oz_value_count(const OzKey *key, const void *base);

/* Whether the values of two rows of one type are the same; for OZ_KEY_CHOICES with their counts. */
bool oz_value_same(const OzKey *key, const void *base, const OzKey *other, const void *other_base);

/* Gives key the value of another row of its type, which owns no memory. */
void oz_value_copy(const OzKey *key, void *base, const OzKey *from, const void *from_base);

/* For base that was copied word by word: gives a text or list row memory of its own, with the same
 * contents. Fails with OZ_ERR_MEMORY alone; the row is empty then. */
OzStatus oz_value_own(const OzKey *key, void *base);

/* Frees what a text or list row owns. */
void oz_value_free(const OzKey *key, void *base);
