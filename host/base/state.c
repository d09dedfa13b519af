/* Entries, and going through them in either direction. */
#include "base/state.h"

#include "base/memory.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

static const struct {
    const char *name;
    size_t bytes;
} kinds[] = {[OZ_STATE_INT64] = {"int64", sizeof(int64_t)},
             [OZ_STATE_INT32] = {"int32", sizeof(int32_t)},
             [OZ_STATE_DOUBLE] = {"double", sizeof(double)},
             [OZ_STATE_FLOAT] = {"float", sizeof(float)},
             [OZ_STATE_BYTES] = {"bytes", 1}};

_Static_assert(sizeof(int) == sizeof(int32_t), "an int is an entry of int32");

size_t oz_state_kind_bytes(OzStateKind kind)
{
    return kinds[kind].bytes;
}

static void free_entry(OzStateEntry *entry)
{
    free(entry->name);
    free(entry->unit);
    free(entry->data);
    *entry = (OzStateEntry){0};
}

void oz_state_free(OzState *state)
{
    for (int64_t i = 0; i < state->count; i++) {
        free_entry(&state->entries[i]);
    }
    free(state->entries);
    *state = (OzState){0};
}

/* The entry of a name, looked for from place `first` on and then before it; -1 without. */
static int64_t find(const OzState *state, const char *name, int64_t first)
{
    for (int64_t k = 0; k < state->count; k++) {
        int64_t i = (first + k) % state->count;
        if (strcmp(state->entries[i].name, name) == 0) {
            return i;
        }
    }
    return -1;
}

const OzStateEntry *oz_state_find(const OzState *state, const char *name)
{
    int64_t at = find(state, name, 0);
    return at < 0 ? NULL : &state->entries[at];
}

static OzStatus copy_entry(OzStateEntry *to, const OzStateEntry *from)
{
    OzStatus status = OZ_OK;
    size_t size = kinds[from->kind].bytes;
    *to = (OzStateEntry){.kind = from->kind, .count = from->count};
    OZ_TRY(oz_memory_text(&to->name, from->name));
    OZ_TRY(oz_memory_text(&to->unit, from->unit));
    OZ_TRY(oz_memory_new(&to->data, (size_t)from->count, size, from->name));
    if (from->count > 0) {
        memcpy(to->data, from->data, (size_t)from->count * size);
    }
done:
    if (status != OZ_OK) {
        free_entry(to);
    }
    return status;
}

/* Without a look at whether the name is there already, which costs a pass over all. */
static OzStatus append(OzState *state, const OzStateEntry *entry)
{
    OZ_PASS(OZ_ROOM(&state->entries, &state->capacity, state->count + 1, "entries of state"));
    OZ_PASS(copy_entry(&state->entries[state->count], entry));
    state->count++;
    return OZ_OK;
}

OzStatus oz_state_add(OzState *state, const OzStateEntry *entry)
{
    if (oz_state_find(state, entry->name)) {
        return oz_status_fail(OZ_ERR_INPUT, "state: %s is there twice", entry->name);
    }
    return append(state, entry);
}

OzStateVisit oz_state_save(OzState *state)
{
    return (OzStateVisit){.state = state};
}

OzStateVisit oz_state_load(OzState *state)
{
    for (int64_t i = 0; i < state->count; i++) {
        state->entries[i].is_taken = false;
    }
    return (OzStateVisit){.state = state, .is_loading = true};
}

OzStatus oz_state_finish(const OzStateVisit *visit)
{
    for (int64_t i = 0; visit->is_loading && i < visit->state->count; i++) {
        if (!visit->state->entries[i].is_taken) {
            return oz_status_fail(OZ_ERR_INPUT, "state: %s belongs to nothing in this run",
                                  visit->state->entries[i].name);
        }
    }
    return OZ_OK;
}

static void push_path(OzStateVisit *visit, const char *name)
{
    size_t used = strlen(visit->path);
    snprintf(visit->path + used, sizeof visit->path - used, "%s/", name);
}

OzStatus oz_state_enter(OzStateVisit *visit, const char *name, int32_t version)
{
    int32_t own = version;
    push_path(visit, name);
    OzStatus status = oz_state_int(visit, "version", "none", &version);
    if (status == OZ_OK && version != own) {
        status = oz_status_fail(OZ_ERR_INPUT,
                                "state: %s is of version %" PRId32 "; expected version %" PRId32
                                ", as this orzo writes it: another one wrote the state",
                                visit->path, version, own);
    }
    return status;
}

void oz_state_enter_one(OzStateVisit *visit, const char *name, int64_t index)
{
    char one[128];
    snprintf(one, sizeof one, "%s_%" PRId64, name, index);
    push_path(visit, one);
}

void oz_state_leave(OzStateVisit *visit)
{
    size_t length = strlen(visit->path);
    while (length > 0 && (visit->path[length - 1] != '/' || visit->path[length] == '\0')) {
        length--; /* to the mark before the last one */
    }
    visit->path[length] = '\0';
}

/* Loading: the entry of a name below the path, of that kind and, unless `count` is negative, of so
 * many items. */
static OzStatus take(OzStateVisit *visit, const OzStateEntry *wanted, OzStateEntry **found)
{
    OzState *state = visit->state;
    int64_t at = find(state, wanted->name, visit->next);
    if (at < 0) {
        return oz_status_fail(OZ_ERR_INPUT, "state: %s is missing", wanted->name);
    }
    OzStateEntry *entry = &state->entries[at];
    if (entry->kind != wanted->kind) {
        return oz_status_fail(OZ_ERR_INPUT, "state: %s is of kind %s; expected %s", wanted->name,
                              kinds[entry->kind].name, kinds[wanted->kind].name);
    }
    if (wanted->count >= 0 && entry->count != wanted->count) {
        return oz_status_fail(OZ_ERR_INPUT, "state: %s holds %" PRId64 " items; expected %" PRId64,
                              wanted->name, entry->count, wanted->count);
    }
    entry->is_taken = true;
    visit->next = at + 1;
    *found = entry;
    return OZ_OK;
}

/* The full name into `full`. */
static OzStatus name_entry(const OzStateVisit *visit, const char *name, char *full, size_t size)
{
    int length = snprintf(full, size, "%s%s", visit->path, name);
    if (length < 0 || (size_t)length >= size) {
        return oz_status_fail(OZ_ERR_INPUT, "state: %s%s: too long a name", visit->path, name);
    }
    return OZ_OK;
}

OzStatus oz_state_items(OzStateVisit *visit, const char *name, const char *unit, OzStateKind kind,
                        void *items, int64_t count)
{
    char full[sizeof visit->path];
    OzStateEntry entry = {
        .name = full, .unit = (char *)unit, .kind = kind, .count = count, .data = items};
    OzStateEntry *found = NULL;
    OZ_PASS(name_entry(visit, name, full, sizeof full));
    if (!visit->is_loading) {
        return append(visit->state, &entry);
    }
    OZ_PASS(take(visit, &entry, &found));
    if (count > 0) {
        memcpy(items, found->data, (size_t)count * kinds[kind].bytes);
    }
    return OZ_OK;
}

OzStatus oz_state_array(OzStateVisit *visit, const char *name, const char *unit, OzStateKind kind,
                        void *items, int64_t *count)
{
    char full[sizeof visit->path];
    void *made = NULL, *old = NULL;
    OzStateEntry wanted = {.name = full, .kind = kind, .count = -1}, *found = NULL;
    memcpy(&old, items, sizeof old);
    if (!visit->is_loading) {
        return oz_state_items(visit, name, unit, kind, old, *count);
    }
    OZ_PASS(name_entry(visit, name, full, sizeof full));
    OZ_PASS(take(visit, &wanted, &found));
    OZ_PASS(oz_memory_new(&made, (size_t)found->count, kinds[kind].bytes, name));
    memcpy(made, found->data, (size_t)found->count * kinds[kind].bytes);
    *count = found->count;
    free(old);
    memcpy(items, &made, sizeof made);
    return OZ_OK;
}

OzStatus oz_state_int64(OzStateVisit *visit, const char *name, const char *unit, int64_t *value)
{
    return oz_state_items(visit, name, unit, OZ_STATE_INT64, value, 1);
}

OzStatus oz_state_int(OzStateVisit *visit, const char *name, const char *unit, int *value)
{
    return oz_state_items(visit, name, unit, OZ_STATE_INT32, value, 1);
}

OzStatus oz_state_double(OzStateVisit *visit, const char *name, const char *unit, double *values,
                         int64_t count)
{
    return oz_state_items(visit, name, unit, OZ_STATE_DOUBLE, values, count);
}

OzStatus oz_state_index(OzStateVisit *visit, const char *name, int64_t *value, int64_t low,
                        int64_t high)
{
    OzStatus status = oz_state_int64(visit, name, "none", value);
    if (status == OZ_OK && (*value < low || *value > high)) {
        status = oz_status_fail(OZ_ERR_INPUT,
                                "state: %s%s is %" PRId64 "; expected %" PRId64 " to %" PRId64,
                                visit->path, name, *value, low, high);
    }
    return status;
}

OzStatus oz_state_bool(OzStateVisit *visit, const char *name, bool *value)
{
    int64_t number = *value;
    OzStatus status = oz_state_index(visit, name, &number, 0, 1);
    *value = number == 1;
    return status;
}

OzStatus oz_state_text(OzStateVisit *visit, const char *name, char **text)
{
    int64_t count = *text ? (int64_t)strlen(*text) + 1 : 0;
    OzStatus status = oz_state_array(visit, name, "text", OZ_STATE_BYTES, text, &count);
    if (status == OZ_OK && visit->is_loading && count == 0) {
        free(*text);
        *text = NULL;
    } else if (status == OZ_OK && visit->is_loading) {
        (*text)[count - 1] = '\0';
    }
    return status;
}
