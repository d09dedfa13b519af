/* The words for keys that stand where they should not, or do not stand where they should. Each adds
 * one fault. */
#ifndef OZ_SCENE_REFUSE_H
#define OZ_SCENE_REFUSE_H

#include "scene/keys.h"
#include "scene/tree.h"

/* No row of the model has node's path: says what was probably meant, else what the group may hold,
 * of a list's item that of its kind and shape (bits, 0 when unknown) with the words on kinds. */
void oz_refuse_unknown(OzFaults *faults, const OzNode *node, int model, unsigned kinds,
                       unsigned shapes);

/* node belongs to the values `owners` (bits) of the choice at a key's path such as "walls[].kind",
 * which is `own`. */
void oz_refuse_foreign(OzFaults *faults, const OzNode *node, const char *choice, unsigned owners,
                       unsigned own);

/* node may be written for the whole scene only, as the key that its row inherits. */
void oz_refuse_shared(OzFaults *faults, const OzNode *node, const OzKey *key);

/* The group whose rows' paths begin with prefix does not hold the required key, nor its rival. */
void oz_refuse_missing(OzFaults *faults, const OzNode *group, const char *prefix, const OzKey *key);

#endif
