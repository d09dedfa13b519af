/* The words for keys that stand where they should not, or do not stand where they should. Each adds
 * one fault. */
#pragma once

#include "scene/keys.h"
#include "scene/tree.h"

/* For a node whose path no row of the model has. Says which key was probably meant; where none is near,
 * which keys its group may hold. In an item of a list these are the keys of its kind and shape (bits, 0
 * when unknown), and the text names the kind. */
void oz_refuse_unknown(OzFaults *faults, const OzNode *node, int model, unsigned kinds,
                       unsigned shapes);

/* For a node that goes with other values of a choice than the one written. choice is the path of that
 * choice, such as "walls[].kind", `own` the value written and `owners` the values that the node goes with,
 * both as bits. */
void oz_refuse_foreign(OzFaults *faults, const OzNode *node, const char *choice, unsigned owners,
                       unsigned own);

/* node may be written for the whole scene only, as the key that its row inherits. */
void oz_refuse_shared(OzFaults *faults, const OzNode *node, const OzKey *key);

/* The group whose rows' paths begin with prefix does not hold the required key, nor its rival. */
void oz_refuse_missing(OzFaults *faults, const OzNode *group, const char *prefix, const OzKey *key);
