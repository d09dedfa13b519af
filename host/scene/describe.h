/* Keys in words, for messages and help. */
#pragma once

#include "scene/keys.h"
#include "scene/tree.h"

/* What a row expects, as in "a number from 0 to 1 s"; cut to size. */
void oz_describe_expected(const OzKey *key, char *text, size_t size);

/* What a node is, as in "'fast'", "empty" or "a list of 2"; cut to size. */
void oz_describe_node(const OzNode *node, char *text, size_t size);

/* The model's known path that an unknown one was probably meant to be; false when none is near. */
bool oz_describe_nearest(const char *path, int model, char *nearest, size_t size);

/* Whether the unknown path could be a misspelling of the key: the nearest is one of these. */
bool oz_describe_nears(const char *path, const OzKey *key);

/* The model's names directly below a group ("" is the scene itself), with commas; of a list's items
 * those of the kinds and shapes whose bits are set (0: of any). */
void oz_describe_names(const char *group, int model, unsigned kinds, unsigned shapes, char *text,
                       size_t size);

/* The names of the choice at path whose bits are set, as in "single or lattice"; cut to size. */
void oz_describe_bits(unsigned bits, const char *path, char *text, size_t size);

/* Every key whose path holds this part (NULL: every key), or where there is none, of which anything
 * that is printed does, in small or capital letters; once, those of every model first, then those
 * of one alone: meaning, type, range, unit, default and what it belongs to. False when there is
 * none. */
bool oz_describe_keys(const char *part, FILE *file);
