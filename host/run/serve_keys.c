/* Walks the rows of the list of keys; knows none by name. */
#include "run/serve_keys.h"

#include "base/memory.h"
#include "scene/keys.h"
#include "scene/value.h"
#include "scene/write.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct Table {
    const OzScene *scene;
    OzPageKey *rows;
    size_t count;
} Table;

static bool may_change(const OzKey *key)
{
    return !key->fixed && key->type != OZ_KEY_SECTION && key->type != OZ_KEY_ITEMS &&
           key->type != OZ_KEY_SWEEP && key->type != OZ_KEY_EXTENDS;
}

static bool is_number(const OzKey *key)
{
    return key->high > key->low;
}

/* "walls[].friction" of item 2 is "walls.2.friction"; item -1: of the scene itself. */
static OzStatus print(char **text, const OzKey *key, const void *base, int item, bool value)
{
    size_t length = 0;
    const char *brackets = strstr(key->path, "[]");
    FILE *file = open_memstream(text, &length);
    if (file && value) {
        oz_write_value(key, base, file);
    } else if (file && item >= 0) {
        fprintf(file, "%.*s.%d%s", (int)(brackets - key->path), key->path, item, brackets + 2);
    } else if (file) {
        fputs(key->path, file);
    }
    return file && fclose(file) == 0 ? OZ_OK
                                     : oz_status_fail(OZ_ERR_MEMORY, "out of memory for a key");
}

/* A row that takes its value from another one, which counts. */
static bool inherits(const OzScene *scene, const OzKey *key, const void *base)
{
    const OzKey *from = key->inherits ? oz_keys_of(key->inherits, (int)scene->model) : NULL;
    return from && !key->shared && oz_write_applies(scene, key, base) &&
           oz_write_applies(scene, from, scene);
}

static bool has_value(const OzScene *scene, const OzKey *key, const void *base)
{
    return oz_write_has(scene, key, base) || inherits(scene, key, base);
}

static OzStatus add(Table *table, const OzKey *key, const void *base, int item)
{
    OzStatus status = OZ_OK;
    char *name = NULL, *value = NULL;
    OZ_TRY(print(&name, key, base, item, false));
    OZ_TRY(has_value(table->scene, key, base) ? print(&value, key, base, item, true)
                                              : oz_memory_text(&value, ""));
    OZ_TRY(oz_memory_grow((void **)&table->rows, table->count, table->count + 1,
                          sizeof *table->rows, "keys of the page"));
    table->rows[table->count++] =
        (OzPageKey){.key = name,
                    .value = value,
                    .unit = key->unit,
                    .help = key->help,
                    .low = is_number(key) ? key->low : NAN,
                    .high = is_number(key) ? key->high : NAN,
                    .choices = key->type == OZ_KEY_CHOICE ? key->choices : NULL};
    return OZ_OK;
done:
    free(name);
    free(value);
    return status;
}

/* Of the scene itself also a row without a value, which can be given one. */
static OzStatus add_if_settable(Table *table, const OzKey *key, const void *base, int item)
{
    bool settable =
        item < 0 ? oz_write_applies(table->scene, key, base) : has_value(table->scene, key, base);
    return settable && may_change(key) ? add(table, key, base, item) : OZ_OK;
}

/* The rows of each item of a list together. Returns the row after them. */
static const OzKey *add_items(Table *table, const OzKey *list, OzStatus *status)
{
    size_t length = strlen(list->path);
    const OzKey *end = list + 1;
    while (end->path && strncmp(end->path, list->path, length) == 0 && end->path[length] == '[') {
        end++;
    }
    const char *items = *(char *const *)oz_value_at(list, table->scene);
    for (int i = 0; i < *oz_value_count(list, table->scene); i++) {
        for (const OzKey *key = list + 1; key < end && *status == OZ_OK; key++) {
            *status = add_if_settable(table, key, items + (size_t)i * list->item_size, i);
        }
    }
    return end;
}

/* Whether the optional group that a row lies in is there. */
static bool has_section(const OzScene *scene, const OzKey *key)
{
    char path[128];
    snprintf(path, sizeof path, "%.*s", (int)strcspn(key->path, "."), key->path);
    const OzKey *section = oz_keys_find(path);
    return !section || section->type != OZ_KEY_SECTION ||
           *(const bool *)oz_value_at(section, scene);
}

OzStatus oz_serve_keys_show(OzPage *page, const OzScene *scene)
{
    Table table = {.scene = scene};
    OzStatus status = OZ_OK;
    for (const OzKey *key = oz_keys_all(); key->path && status == OZ_OK;) {
        if (key->type == OZ_KEY_ITEMS) {
            key = add_items(&table, key, &status);
        } else {
            status = has_section(scene, key) ? add_if_settable(&table, key, scene, -1) : OZ_OK;
            key++;
        }
    }
    if (status == OZ_OK) {
        status = oz_page_show_keys(page, table.rows, (int)table.count);
    }
    for (size_t i = 0; i < table.count; i++) {
        free((char *)table.rows[i].key);
        free((char *)table.rows[i].value);
    }
    free(table.rows);
    return status;
}
