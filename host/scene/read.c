/* Walks a tree along the list of keys. Knows the shape of scenes (groups, lists of groups with a
 * kind and a shape, inherited values, rivals) and few keys by name: `model`, `kind`, `shape` and
 * `contact.law`. */
#include "scene/read.h"

#include "base/memory.h"
#include "scene/describe.h"
#include "scene/document.h"
#include "scene/keys.h"
#include "scene/layers.h"
#include "scene/refuse.h"
#include "scene/sweep.h"
#include "scene/value.h"

#include <stdio.h>
#include <string.h>

enum {
    MOST_ITEMS = 10000, /* walls or populations: each costs kernel arguments, not only memory */
    LONGEST_PATH = 256
};

/* What the values of one group belong to: the scene, or one item of a list. */
typedef struct Place {
    void *base;
    const char *prefix; /* of its rows' paths: "" or "grains[]."                    */
    const OzNode *node; /* what was written of it                                   */
    unsigned kind;      /* one bit of the rows' kinds; 0 when unknown, ~0 for none   */
    unsigned shape;     /* the same for the rows' shapes                             */
} Place;

typedef struct Reader {
    OzScene *scene;
    OzFaults *faults;
    const OzNode *root;
    int model; /* what the scene is, or rods while that is unknown  */
    bool model_known;
    bool confused; /* some key is of another model than the unknown one */
    bool contacts; /* some grains touch by the laws of `contact`        */
    bool law_known;
} Reader;

static bool belongs(const Reader *reader, const OzKey *key, const char *prefix)
{
    size_t length = strlen(prefix);
    return oz_keys_serves(key, reader->model) && strncmp(key->path, prefix, length) == 0 &&
           !strstr(key->path + length, "[]");
}

static const OzNode *written(const Place *place, const OzKey *key)
{
    return oz_tree_at((OzNode *)(uintptr_t)place->node, key->path + strlen(place->prefix));
}

static OzStatus read_default(const OzKey *key, void *base)
{
    OzSource source = {.name = key->path};
    OzFaults faults = {0};
    OzNode *node = NULL;
    OzStatus status = OZ_OK;
    OZ_TRY(oz_document_parse(&node, key->fallback, strlen(key->fallback), &source, &faults));
    OZ_TRY(oz_value_read(key, node, base, &faults));
    OZ_TRY(oz_faults_report(&faults));
done:
    oz_tree_free(node);
    oz_faults_free(&faults);
    return status;
}

/* Fills base with the constant defaults. */
static OzStatus read_defaults(const Reader *reader, const char *prefix, void *base)
{
    for (const OzKey *key = oz_keys_all(); key->path; key++) {
        if (key->fallback && belongs(reader, key, prefix)) {
            OZ_PASS(read_default(key, base));
        }
    }
    return OZ_OK;
}

static bool is_known(const char *path)
{
    return oz_keys_find(path) || oz_keys_is_group(path);
}

/* Whether a key that was written below the map but is not known is taken for the wanted one:
 * who is told what was meant need not be told that it is missing. */
static bool is_misspelt(const Reader *reader, const OzNode *map, const OzKey *wanted)
{
    char path[LONGEST_PATH], near[LONGEST_PATH];
    bool found = false;
    for (int i = 0; map->kind == OZ_NODE_MAP && i < map->count && !found; i++) {
        oz_tree_path(map->items[i], true, path, sizeof path);
        found = is_known(path) ? is_misspelt(reader, map->items[i], wanted)
                               : oz_describe_nears(path, wanted) &&
                                     oz_describe_nearest(path, reader->model, near, sizeof near) &&
                                     strcmp(near, wanted->path) == 0;
    }
    return found;
}

/* True when the node's keys are to be read; a fault when it is something else, unless it is an
 * empty group where that is as good as an absent one. */
static bool is_group(const Reader *reader, const OzNode *node, bool may_be_empty)
{
    if (node->kind == OZ_NODE_MAP) {
        return true;
    }
    if (!node->refused && !(may_be_empty && oz_tree_is_empty(node))) {
        char path[LONGEST_PATH], is[128];
        oz_tree_path(node, false, path, sizeof path);
        oz_describe_node(node, is, sizeof is);
        oz_faults_add(reader->faults, node->source, node->line,
                      "%s is %s; expected a group of keys", path, is);
    }
    return false;
}

/* name is "kind" or "shape"; owners and own are bits of that choice. */
static void report_foreign(const Reader *reader, const char *name, unsigned owners, unsigned own,
                           const OzNode *node, const Place *place)
{
    char choice[LONGEST_PATH];
    snprintf(choice, sizeof choice, "%s%s", place->prefix, name);
    oz_refuse_foreign(reader->faults, node, choice, owners, own);
}

static void report_foreign_model(Reader *reader, const OzKey *key, const OzNode *node)
{
    reader->confused |= !reader->model_known;
    oz_refuse_foreign(reader->faults, node, "model", key->models, 1u << reader->model);
}

/* Of two rivals the one written later gets the fault. */
static void check_rival(const Reader *reader, const OzKey *key, const OzNode *node)
{
    const OzNode *rival = key->rival ? oz_tree_child(node->parent, key->rival) : NULL;
    if (rival && rival->index < node->index) {
        char path[LONGEST_PATH];
        oz_tree_path(node, false, path, sizeof path);
        oz_faults_add(reader->faults, node->source, node->line,
                      "%s contradicts %s; expected one of the two", path, key->rival);
    }
}

/* What an item's row takes when not written: the scene's value, or, where the scene itself did not
 * write that but inherits it, the same from the item (a wall's damping follows its stiffness). */
static void inherit_item(const Reader *reader, const OzKey *key, const Place *place)
{
    char path[LONGEST_PATH];
    const OzKey *from = oz_keys_of(key->inherits, reader->model);
    const void *base = reader->scene;
    if (from->inherits && !oz_tree_at((OzNode *)(uintptr_t)reader->root, from->path)) {
        snprintf(path, sizeof path, "%s%s", place->prefix, from->inherits);
        if (!oz_keys_of(path, reader->model)) { /* of materials, without a group */
            snprintf(path, sizeof path, "%s%s", place->prefix, strrchr(from->inherits, '.') + 1);
        }
        from = oz_keys_of(path, reader->model);
        base = place->base;
    }
    oz_value_copy(key, place->base, from, base);
}

static void inherit(const Reader *reader, const Place *place)
{
    for (const OzKey *key = oz_keys_all(); key->path; key++) {
        if (!key->inherits || !belongs(reader, key, place->prefix) || written(place, key)) {
            continue;
        }
        if (place->prefix[0]) {
            inherit_item(reader, key, place);
        } else {
            oz_value_copy(key, place->base, oz_keys_of(key->inherits, reader->model), place->base);
        }
    }
}

static OzStatus read_items(Reader *reader, const OzKey *list, const OzNode *node);
static OzStatus read_map(Reader *reader, const OzNode *map, const Place *place, bool lists);

static OzStatus read_key(Reader *reader, const OzKey *key, const OzNode *node, const Place *place)
{
    if (key->kinds && place->kind && !(key->kinds & place->kind)) {
        report_foreign(reader, "kind", oz_keys_kinds(key->path, reader->model), place->kind, node,
                       place);
        return OZ_OK;
    }
    if (key->shapes && place->shape && !(key->shapes & place->shape)) {
        report_foreign(reader, "shape", key->shapes, place->shape, node, place);
        return OZ_OK;
    }
    if (key->shared) {
        oz_refuse_shared(reader->faults, node, key);
        return OZ_OK;
    }
    check_rival(reader, key, node);
    switch (key->type) {
    case OZ_KEY_SECTION:
        *(bool *)oz_value_at(key, place->base) = true;
        return is_group(reader, node, true) ? read_map(reader, node, place, false) : OZ_OK;
    case OZ_KEY_ITEMS:
        return read_items(reader, key, node);
    case OZ_KEY_SWEEP:
        return oz_sweep_read(oz_value_at(key, place->base), node, reader->model, reader->faults);
    case OZ_KEY_EXTENDS:
        oz_faults_add(reader->faults, node->source, node->line,
                      "extends cannot be set; expected it in the scene file");
        return OZ_OK;
    default:
        return oz_value_read(key, node, place->base, reader->faults);
    }
}

/* Reads the map's lists of groups, or all its other keys: lists inherit from the scene, so they
 * come last. */
static OzStatus read_map(Reader *reader, const OzNode *map, const Place *place, bool lists)
{
    for (int i = 0; i < map->count; i++) {
        const OzNode *node = map->items[i];
        char path[LONGEST_PATH];
        oz_tree_path(node, true, path, sizeof path);
        const OzKey *key = oz_keys_of_kind(path, reader->model, place->kind);
        if (lists != (key && key->type == OZ_KEY_ITEMS)) {
            continue;
        }
        if (key) {
            OZ_PASS(read_key(reader, key, node, place));
        } else if (oz_keys_find(path)) {
            report_foreign_model(reader, oz_keys_find(path), node);
        } else if (!oz_keys_is_group(path)) {
            oz_refuse_unknown(reader->faults, node, reader->model, place->kind, place->shape);
        } else if (is_group(reader, node, true)) {
            OZ_PASS(read_map(reader, node, place, false));
        }
    }
    return OZ_OK;
}

/* False when a group on the way to the row is an optional one that is absent, or is no group. */
static bool is_asked_for(const OzKey *key, const Place *place)
{
    size_t start = strlen(place->prefix);
    char path[LONGEST_PATH];
    for (const char *dot = strchr(key->path + start, '.'); dot; dot = strchr(dot + 1, '.')) {
        snprintf(path, sizeof path, "%.*s", (int)(dot - key->path), key->path);
        const OzNode *group = oz_tree_at((OzNode *)(uintptr_t)place->node, path + start);
        bool absent = !group && oz_keys_find(path);
        if (absent || (group && group->kind != OZ_NODE_MAP && !oz_tree_is_empty(group))) {
            return false;
        }
    }
    return true;
}

/* Whether each material says a value of `contact` itself, and each wall that is of none. */
static bool is_said_by_all(const Reader *reader, const OzKey *key)
{
    const OzNode *materials = oz_tree_child(reader->root, "materials");
    const OzNode *walls = oz_tree_child(reader->root, "walls");
    const char *name = strchr(key->path, '.') + 1;
    bool all = materials && materials->kind == OZ_NODE_LIST && materials->count > 0;
    for (int i = 0; all && i < materials->count; i++) {
        all = oz_tree_child(materials->items[i], name) != NULL;
    }
    for (int w = 0; all && walls && walls->kind == OZ_NODE_LIST && w < walls->count; w++) {
        const OzNode *own = oz_tree_child(walls->items[w], "contact");
        all = oz_tree_child(walls->items[w], "material") || (own && oz_tree_child(own, name));
    }
    return all;
}

static bool is_required(const Reader *reader, const OzKey *key, const Place *place)
{
    return key->required && belongs(reader, key, place->prefix) &&
           (!key->kinds || key->kinds & place->kind) &&
           (!key->shapes || key->shapes & place->shape) &&
           (!key->laws ||
            (reader->contacts && reader->law_known && key->laws >> reader->scene->told.law & 1 &&
             !is_said_by_all(reader, key))) &&
           is_asked_for(key, place);
}

static bool is_there(const Reader *reader, const OzKey *key, const Place *place)
{
    return written(place, key) || is_misspelt(reader, place->node, key);
}

static void check_required(const Reader *reader, const Place *place)
{
    for (const OzKey *key = oz_keys_all(); key->path; key++) {
        if (!is_required(reader, key, place) || is_there(reader, key, place)) {
            continue;
        }
        const char *dot = strrchr(key->path, '.');
        char rival[LONGEST_PATH];
        snprintf(rival, sizeof rival, "%.*s%s", dot ? (int)(dot - key->path) + 1 : 0, key->path,
                 key->rival ? key->rival : "");
        const OzKey *other = key->rival ? oz_keys_find(rival) : NULL;
        if (!other || !is_there(reader, other, place)) {
            oz_refuse_missing(reader->faults, place->node, place->prefix, key);
        }
    }
}

/* The bit of what the choice of that name says; 0 when it is not written or unknown. */
static unsigned read_bit(int model, const char *prefix, const char *name, const OzNode *group)
{
    char path[LONGEST_PATH + 8];
    snprintf(path, sizeof path, "%s%s", prefix, name);
    const OzKey *key = oz_keys_of(path, model);
    const OzNode *node = oz_tree_child(group, name);
    for (int i = 0; key && node && node->text && key->choices[i]; i++) {
        if (key->choices[i][0] && strcmp(key->choices[i], node->text) == 0) {
            return 1u << i;
        }
    }
    return 0;
}

static OzStatus read_item(Reader *reader, const OzKey *list, const char *prefix, const OzNode *node,
                          void *item)
{
    memcpy((char *)item + list->line_offset, &node->line, sizeof node->line);
    if (!is_group(reader, node, false)) {
        return OZ_OK;
    }
    Place place = {item, prefix, node, read_bit(reader->model, prefix, "kind", node),
                   read_bit(reader->model, prefix, "shape", node)};
    OzStatus status = read_map(reader, node, &place, false);
    inherit(reader, &place);
    check_required(reader, &place);
    return status;
}

static OzStatus read_items(Reader *reader, const OzKey *list, const OzNode *node)
{
    char prefix[LONGEST_PATH], is[128], expected[128];
    if (node->kind != OZ_NODE_LIST || node->count > MOST_ITEMS) {
        oz_describe_node(node, is, sizeof is);
        oz_describe_expected(list, expected, sizeof expected);
        oz_faults_add(reader->faults, node->source, node->line, "%s is %s; expected %s, at most %d",
                      list->path, is, expected, MOST_ITEMS);
        return OZ_OK;
    }
    char *items = NULL;
    OZ_PASS(oz_memory_new((void **)&items, (size_t)node->count, list->item_size, list->path));
    *(void **)oz_value_at(list, reader->scene) = items;
    *oz_value_count(list, reader->scene) = node->count;
    snprintf(prefix, sizeof prefix, "%s[].", list->path);
    for (int i = 0; i < node->count; i++) {
        if (i == 0) {
            OZ_PASS(read_defaults(reader, prefix, items));
        } else {
            memcpy(items + (size_t)i * list->item_size, items, list->item_size);
        }
    }
    for (int i = 0; i < node->count; i++) {
        OZ_PASS(
            read_item(reader, list, prefix, node->items[i], items + (size_t)i * list->item_size));
    }
    return OZ_OK;
}

/* What is known of the scene before its values are read. */
static Reader begin(OzScene *scene, const OzNode *root, OzFaults *faults)
{
    const OzNode *grains = oz_tree_child(root, "grains"), *contact = oz_tree_child(root, "contact");
    const unsigned trigrains = 1u << OZ_MODEL_TRIGRAINS, disc = 1u << OZ_SHAPE_DISC;
    unsigned model = read_bit(OZ_MODEL_RODS, "", "model", root);
    bool flat = model == trigrains;
    Reader reader = {.scene = scene,
                     .faults = faults,
                     .root = root,
                     .model = flat ? OZ_MODEL_TRIGRAINS : OZ_MODEL_RODS,
                     .model_known = model != 0,
                     .contacts = !flat};
    for (int i = 0; flat && grains && i < grains->count; i++) {
        reader.contacts |= read_bit(reader.model, "grains[].", "shape", grains->items[i]) == disc;
    }
    reader.law_known = !contact || !oz_tree_child(contact, "law") ||
                       read_bit(reader.model, "contact.", "law", contact) != 0;
    return reader;
}

/* The model's own fault, in place of all others. */
static OzStatus stop_at_model(const Reader *reader, const Place *place)
{
    const OzKey *key = oz_keys_find("model");
    const OzNode *node = written(place, key);
    oz_faults_free(reader->faults);
    if (node) {
        oz_value_read(key, node, place->base, reader->faults);
    } else {
        oz_refuse_missing(reader->faults, place->node, place->prefix, key);
    }
    return OZ_ERR_INPUT;
}

OzStatus oz_read_scene(OzScene *scene, OzNode *root, OzFaults *faults)
{
    Place place = {scene, "", root, ~0u, ~0u};
    Reader reader = begin(scene, root, faults);
    oz_layers_drop(root, reader.model);
    OZ_PASS(read_defaults(&reader, "", scene));
    OZ_PASS(read_map(&reader, root, &place, false));
    inherit(&reader, &place);
    OZ_PASS(read_map(&reader, root, &place, true));
    check_required(&reader, &place);
    if (reader.confused) {
        return stop_at_model(&reader, &place);
    }
    return OZ_OK;
}
