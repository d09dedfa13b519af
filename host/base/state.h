/* The state of a run as named arrays in memory, for any container to hold. Whoever owns state has
 * one function that visits all of it; the same function saves and loads, so that the two cannot
 * drift. It knows no owner, no file and no device. */
#pragma once

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef enum OzStateKind {
    OZ_STATE_INT64,
    OZ_STATE_INT32,
    OZ_STATE_DOUBLE,
    OZ_STATE_FLOAT,
    OZ_STATE_BYTES,
    OZ_STATE_KINDS
} OzStateKind;

typedef struct OzStateEntry {
    char *name; /* like a path, "series/mean_0/value"; every entry has another one; owned */
    char *unit; /* in words, "J"; owned                                                   */
    OzStateKind kind;
    int64_t count; /* items of that kind                                                  */
    void *data;    /* owned; never NULL                                                   */
    bool is_taken; /* somebody has loaded it                                              */
} OzStateEntry;

/* Zeroed is empty. Entries are in the order in which they were added. */
typedef struct OzState {
    OzStateEntry *entries;
    int64_t count, capacity;
} OzState;

void oz_state_free(OzState *state); /* zeroed is fine */

size_t oz_state_kind_bytes(OzStateKind kind);

/* Adds an entry with copies of what is given. Fails with OZ_ERR_INPUT when there is one of that
 * name already. */
OzStatus oz_state_add(OzState *state, const OzStateEntry *entry);

/* NULL when there is none. */
const OzStateEntry *oz_state_find(const OzState *state, const char *name);

/* One pass over all owners, in either direction. */
typedef struct OzStateVisit {
    OzState *state; /* borrowed */
    bool is_loading;
    char path[256]; /* of the owner in hand, ending in "/", or empty */
    int64_t next;   /* loading: where the next entry is looked for first */
} OzStateVisit;

OzStateVisit oz_state_save(OzState *state);
OzStateVisit oz_state_load(OzState *state);

/* After the last owner: fails when nobody loaded an entry, naming it. */
OzStatus oz_state_finish(const OzStateVisit *visit);

/* Every call below saves what it points to, or fills it with what was saved. Loading fails with
 * OZ_ERR_INPUT, naming the entry, when it is missing, of another kind or has another count. What
 * failed to load is half filled: its owner can only be freed. */

/* Names visited until oz_state_leave begin with "name/". The version is an owner's own number, to
 * be raised whenever its entries change; loading refuses another one. */
OzStatus oz_state_enter(OzStateVisit *visit, const char *name, int32_t version);
/* The same for one of several, "name_index/", without a version. */
void oz_state_enter_one(OzStateVisit *visit, const char *name, int64_t index);
void oz_state_leave(OzStateVisit *visit);

OzStatus oz_state_int64(OzStateVisit *visit, const char *name, const char *unit, int64_t *value);
OzStatus oz_state_int(OzStateVisit *visit, const char *name, const char *unit, int *value);
OzStatus oz_state_bool(OzStateVisit *visit, const char *name, bool *value);
OzStatus oz_state_double(OzStateVisit *visit, const char *name, const char *unit, double *values,
                         int64_t count);
OzStatus oz_state_items(OzStateVisit *visit, const char *name, const char *unit, OzStateKind kind,
                        void *items, int64_t count);

/* As oz_state_int64, and refuses to load what lies outside of low ... high, both included. */
OzStatus oz_state_index(OzStateVisit *visit, const char *name, int64_t *value, int64_t low,
                        int64_t high);

/* An array of any length at *items (the address of a pointer to memory of malloc, or to NULL):
 * loading frees it and makes one of the length that was saved. */
OzStatus oz_state_array(OzStateVisit *visit, const char *name, const char *unit, OzStateKind kind,
                        void *items, int64_t *count);

/* A text of malloc, or NULL; loading frees what was there. */
OzStatus oz_state_text(OzStateVisit *visit, const char *name, char **text);
