/* THE list of scene keys. A row says where a key's value lives, what it may be, what it is when not
 * written and what it means; loading, unknown-key hints, `--set`, writing a scene back and
 * `orzo keys` all walk the rows. A new key is a new row in rows.c. A key that means different
 * things to different models has a row for each. */
#pragma once

#include "scene/key.h"

/* The rows, ending with one whose path is NULL; rows of one group are neighbours. */
const OzKey *oz_keys_all(void);

/* The first row with this path, or NULL. */
const OzKey *oz_keys_find(const char *path);

/* The row with this path that belongs to the model (an OzModelKind), or NULL. */
const OzKey *oz_keys_of(const char *path, int model);

/* The row with this path for items of a kind (a bit of kinds, or 0 where it is not known); where
 * none is, the first of the model, or NULL. */
const OzKey *oz_keys_of_kind(const char *path, int model, unsigned kinds);

/* The kinds of items that rows of this path serve, as bits; 0: all. */
unsigned oz_keys_kinds(const char *path, int model);

/* True when the row belongs to the model. */
bool oz_keys_serves(const OzKey *key, int model);

/* The first row after this one that does not lie below the first `length` letters of its path. */
const OzKey *oz_keys_end(const OzKey *first, size_t length);

/* True when rows live below this path. */
bool oz_keys_is_group(const char *path);

/* The name of a choice's value ("symplectic-euler" of "integrator" 1) in any model, "?" when there
 * is none. */
const char *oz_keys_choice_name(const char *path, int value);

/* The bytes that a row's value takes at its offset, without what it points to. */
size_t oz_keys_size(const OzKey *key);
