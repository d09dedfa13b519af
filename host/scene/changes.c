/* Comparing scenes by what would be written of them. It knows no key by name. */
#include "scene/changes.h"

#include "base/memory.h"
#include "scene/keys.h"
#include "scene/trace.h"
#include "scene/value.h"
#include "scene/write.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct Search {
    OzChanges *changes;
    const OzScene *running, *next;
} Search;

/* What a difference is told to: a row, its path with the item's number, both values. */
typedef OzStatus (*Told)(void *context, const OzKey *key, OzChange *change);

static void free_change(OzChange *change)
{
    free(change->path);
    free(change->old);
    free(change->now);
}

void oz_changes_free(OzChanges *changes)
{
    for (int i = 0; i < changes->count; i++) {
        free_change(&changes->rows[i]);
    }
    free(changes->rows);
    *changes = (OzChanges){0};
}

/* Whether a row takes its value from another one: it is not written then, but has one. */
static bool inherits(const OzKey *key, const OzScene *scene, const void *base)
{
    return key->inherits && oz_keys_serves(key, (int)scene->model) &&
           !oz_write_has(scene, key, base) &&
           oz_value_same(key, base, oz_keys_of(key->inherits, (int)scene->model), scene);
}

/* The value as text; empty when the scene says nothing of it. */
static OzStatus print(char **text, const OzKey *key, const OzScene *scene, const void *base)
{
    size_t length = 0;
    *text = NULL;
    FILE *file = open_memstream(text, &length);
    if (file && (oz_write_has(scene, key, base) || inherits(key, scene, base))) {
        if (key->type == OZ_KEY_SECTION) {
            fputs("true", file);
        } else if (key->type == OZ_KEY_ITEMS) {
            fprintf(file, "%d", *oz_value_count(key, base));
        } else {
            oz_write_value(key, base, file);
        }
    }
    if (!file || fclose(file) != 0 || !*text) {
        return oz_status_fail(OZ_ERR_MEMORY, "out of memory for a value");
    }
    return OZ_OK;
}

/* "walls[].motion" of item 2 is "walls.2.motion". */
static OzStatus name(char **path, const OzKey *key, int item)
{
    const char *brackets = strstr(key->path, "[]");
    int length = brackets ? asprintf(path, "%.*s.%d%s", (int)(brackets - key->path), key->path,
                                     item, brackets + 2)
                          : asprintf(path, "%s", key->path);
    if (length < 0) {
        *path = NULL;
        return oz_status_fail(OZ_ERR_MEMORY, "out of memory for a key");
    }
    return OZ_OK;
}

/* A row in both scenes, or in an item of both. The change is told, and then freed if it is still
 * there. */
static OzStatus compare_row(const Search *s, const OzKey *key, int item, const void *running,
                            const void *next, Told told, void *context)
{
    OzStatus status = OZ_OK;
    OzChange change = {0};
    if (inherits(key, s->running, running) && inherits(key, s->next, next)) {
        return OZ_OK;
    }
    OZ_TRY(print(&change.old, key, s->running, running));
    OZ_TRY(print(&change.now, key, s->next, next));
    if (strcmp(change.old, change.now) != 0) {
        OZ_TRY(name(&change.path, key, item));
        OZ_TRY(told(context, key, &change));
    }
done:
    free_change(&change);
    return status;
}

static bool is_missing(const OzKey *key, const void *running, const void *next)
{
    return key->type == OZ_KEY_SECTION &&
           (!*(const bool *)oz_value_at(key, running) || !*(const bool *)oz_value_at(key, next));
}

/* Rows up to end, of the scenes or of an item; those of a section that is missing in one are passed
 * over, the section itself is not. */
static OzStatus compare_rows(const Search *s, const OzKey *key, const OzKey *end, int item,
                             const void *running, const void *next, Told told, void *context);

static OzStatus compare_items(const Search *s, const OzKey *list, Told told, void *context)
{
    const char *running = *(char *const *)oz_value_at(list, s->running);
    const char *next = *(char *const *)oz_value_at(list, s->next);
    int count = *oz_value_count(list, s->running);
    for (int i = 0; i < count && count == *oz_value_count(list, s->next); i++) {
        size_t at = (size_t)i * list->item_size;
        OZ_PASS(compare_rows(s, list + 1, oz_keys_end(list, strlen(list->path)), i, running + at,
                             next + at, told, context));
    }
    return OZ_OK;
}

static OzStatus compare_rows(const Search *s, const OzKey *key, const OzKey *end, int item,
                             const void *running, const void *next, Told told, void *context)
{
    while (key < end) {
        OZ_PASS(compare_row(s, key, item, running, next, told, context));
        if (key->type == OZ_KEY_ITEMS) {
            OZ_PASS(compare_items(s, key, told, context));
            key = oz_keys_end(key, strlen(key->path));
        } else {
            bool serves = oz_keys_serves(key, (int)s->running->model);
            key = serves && is_missing(key, running, next) ? oz_keys_end(key, strlen(key->path))
                                                           : key + 1;
        }
    }
    return OZ_OK;
}

static OzStatus compare(const Search *s, Told told, void *context)
{
    const OzKey *first = oz_keys_all(), *end = first;
    while (end->path) {
        end++;
    }
    return compare_rows(s, first, end, 0, s->running, s->next, told, context);
}

static OzStatus keep(void *context, const OzKey *key, OzChange *change)
{
    OzChanges *changes = context;
    size_t count = (size_t)changes->count;
    (void)key;
    OZ_PASS(oz_memory_grow((void **)&changes->rows, count, count + 1, sizeof *changes->rows,
                           "changes of a scene"));
    changes->rows[changes->count++] = *change;
    *change = (OzChange){0};
    return OZ_OK;
}

OzStatus oz_changes_find(OzChanges *changes, const OzScene *running, const OzScene *next)
{
    const Search search = {changes, running, next};
    *changes = (OzChanges){0};
    return compare(&search, keep, changes);
}

typedef struct Refusal {
    const OzSweep *sweep; /* of the running scene */
    OzNode *root;
    OzFaults *faults;
} Refusal;

static bool is_swept(const OzSweep *sweep, const char *path)
{
    for (int k = 0; k < sweep->key_count; k++) {
        if (strcmp(sweep->keys[k].path, path) == 0) {
            return true;
        }
    }
    return false;
}

static OzStatus refuse(void *context, const OzKey *key, OzChange *change)
{
    Refusal *r = context;
    const char *why = is_swept(r->sweep, change->path) ? "members differ in it" : key->fixed;
    const char *old = change->old[0] ? change->old : "not written";
    if (why && key->type == OZ_KEY_ITEMS) {
        oz_tree_fault(r->root, r->faults, change->path,
                      "%s has %.20s entries and runs with %.20s, which cannot change: %s",
                      change->path, change->now, old, why);
    } else if (why) {
        oz_tree_fault(r->root, r->faults, change->path,
                      "%s runs with %.100s, which cannot change: %s", change->path, old, why);
    }
    return OZ_OK;
}

OzStatus oz_changes_refuse(const OzScene *running, const OzScene *next, OzNode *root,
                           OzFaults *faults)
{
    const Search search = {NULL, running, next};
    Refusal refusal = {&running->sweep, root, faults};
    for (int w = 0; w < next->wall_count && w < running->wall_count; w++) {
        const OzTrace *old = running->walls[w].motion.trace, *now = next->walls[w].motion.trace;
        char path[64];
        snprintf(path, sizeof path, "walls.%d.motion.file", w);
        if (old && now && old->digest != now->digest) {
            oz_tree_fault(root, faults, path,
                          "%s holds another trace than the one that runs, which "
                          "cannot change: the way so far would be another one",
                          path);
        }
    }
    return compare(&search, refuse, &refusal);
}

OzStatus oz_changes_settings(char ***settings, const OzChanges *changes)
{
    OZ_PASS(OZ_NEW(settings, changes->count));
    for (int i = 0; i < changes->count; i++) {
        const OzChange *change = &changes->rows[i];
        int length = change->now[0] ? asprintf(&(*settings)[i], "%s=%s", change->path, change->now)
                                    : asprintf(&(*settings)[i], "-%s", change->path);
        if (length < 0) {
            (*settings)[i] = NULL;
            for (int k = 0; k < i; k++) {
                free((*settings)[k]);
            }
            free(*settings);
            *settings = NULL;
            return oz_status_fail(OZ_ERR_MEMORY, "out of memory for a setting");
        }
    }
    return OZ_OK;
}
