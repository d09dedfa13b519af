/* Loading a scene from beginning to end: the file, what it extends, the settings over both, the
 * keys, the checks. Knows no key by name but `extends`. */
#include "scene/scene.h"

#include "base/file.h"
#include "base/memory.h"
#include "scene/changes.h"
#include "scene/check.h"
#include "scene/document.h"
#include "scene/faults.h"
#include "scene/keys.h"
#include "scene/layers.h"
#include "scene/read.h"
#include "scene/sweep.h"
#include "scene/trace.h"
#include "scene/value.h"
#include "scene/wall_meshes.h"
#include "scene/wall_shape.h"
#include "scene/write.h"

#include <stdlib.h>
#include <string.h>

enum { LONGEST_LABEL = 200 }; /* letters of a setting in its faults */

typedef struct Loader {
    const OzScene *running; /* that the scene shall take over from; NULL: none      */
    OzSource *sources;      /* the scene, what it extends, then one for each setting */
    int source_count;
    char **labels; /* of the settings and the extended file                 */
    OzFaults faults;
    OzNode *root;
} Loader;

/* The folder part of a path in a new text; NULL for the working folder. */
static OzStatus folder_of(char **folder, const char *path)
{
    const char *slash = strrchr(path, '/');
    *folder = NULL;
    if (!slash) {
        return OZ_OK;
    }
    OzStatus status = oz_memory_text(folder, path);
    if (status == OZ_OK) {
        (*folder)[slash == path ? 1 : slash - path] = '\0';
    }
    return status;
}

OzStatus oz_scene_name(char **name, const char *path)
{
    const char *slash = strrchr(path, '/');
    OzStatus status = oz_memory_text(name, slash ? slash + 1 : path);
    char *dot = status == OZ_OK ? strrchr(*name, '.') : NULL;
    if (dot && dot != *name && (strcmp(dot, ".yaml") == 0 || strcmp(dot, ".yml") == 0)) {
        *dot = '\0';
    }
    return status;
}

static OzStatus loader_create(Loader *loader, const char *path, int setting_count)
{
    loader->source_count = setting_count + 2;
    OZ_PASS(OZ_NEW(&loader->sources, loader->source_count));
    OZ_PASS(OZ_NEW(&loader->labels, loader->source_count));
    for (int i = 0; i < loader->source_count; i++) {
        loader->sources[i].rank = i;
        loader->sources[i].setting = i >= 2;
    }
    loader->sources[0].name = path;
    return folder_of(&loader->sources[0].folder, path);
}

static void loader_free(Loader *loader)
{
    for (int i = 0; i < loader->source_count; i++) {
        if (loader->sources) {
            free(loader->sources[i].folder);
        }
        if (loader->labels) {
            free(loader->labels[i]);
        }
    }
    free(loader->sources);
    free(loader->labels);
    oz_faults_free(&loader->faults);
    oz_tree_free(loader->root);
}

/* Reads one file into a map; *map stays NULL, with a fault, when it holds something else. */
static OzStatus parse_file(Loader *loader, OzNode **map, const char *text, size_t length,
                           const OzSource *source)
{
    OzNode *node = NULL;
    OZ_PASS(oz_document_parse(&node, text, length, source, &loader->faults));
    if (!node || oz_tree_is_empty(node)) {
        oz_faults_add(&loader->faults, source, 1,
                      "the file is empty; expected the keys of a scene");
    } else if (node->kind != OZ_NODE_MAP) {
        oz_faults_add(&loader->faults, source, node->line,
                      "the file is no group of keys; expected keys such as `model: rods`");
    } else {
        *map = node;
        node = NULL;
    }
    oz_tree_free(node);
    return OZ_OK;
}

/* Without what it extends a scene cannot be judged: the fault stands alone. */
#define STOP(loader, node, ...)                                                                    \
    (oz_faults_free(&(loader)->faults),                                                            \
     oz_faults_add(&(loader)->faults, (node)->source, (node)->line, __VA_ARGS__), OZ_ERR_INPUT)

/* *base receives what the scene extends; it stays NULL, with a fault, when that is no scene. */
static OzStatus parse_base(Loader *loader, OzNode **base, const OzNode *extends)
{
    OzStatus status = OZ_OK;
    OzSource *source = &loader->sources[1];
    char *text = NULL;
    size_t length = 0;
    OZ_TRY(oz_file_join(&loader->labels[1], loader->sources[0].folder, extends->text));
    source->name = loader->labels[1];
    OZ_TRY(folder_of(&source->folder, source->name));
    status = oz_file_read(&text, &length, source->name);
    if (status == OZ_ERR_FILE) {
        status = STOP(loader, extends, "%s; expected a scene file", oz_status_text());
    }
    OZ_TRY(status);
    OZ_TRY(parse_file(loader, base, text, length, source));
done:
    free(text);
    return status;
}

/* Takes the `extends` entry out of the map; NULL when there is none. */
static OzNode *take_extends(OzNode *map)
{
    OzNode *extends = oz_tree_child(map, "extends");
    if (extends) {
        oz_tree_detach(extends);
    }
    return extends;
}

static OzStatus extend(Loader *loader)
{
    OzStatus status = OZ_OK;
    OzNode *base = NULL, *deeper = NULL, *extends = take_extends(loader->root);
    if (!extends || oz_tree_is_false(extends)) {
        goto done;
    }
    if (extends->kind != OZ_NODE_SCALAR || extends->refused || oz_tree_is_empty(extends)) {
        status = STOP(loader, extends, "extends is no file name; expected one other scene file");
        goto done;
    }
    OZ_TRY(parse_base(loader, &base, extends));
    if (!base) {
        status = OZ_ERR_INPUT;
        goto done;
    }
    deeper = take_extends(base);
    if (deeper && !oz_tree_is_false(deeper)) {
        status = STOP(loader, deeper,
                      "extends in a file that is itself extended, by %s; expected one level only",
                      loader->sources[0].name);
        goto done;
    }
    OZ_TRY(oz_layers_merge(loader->root, base));
done:
    oz_tree_free(extends);
    oz_tree_free(deeper);
    oz_tree_free(base);
    return status;
}

/* Takes out what stands at a path; nothing there is fine. */
static void take_out(OzNode *root, const char *path)
{
    OzNode *node = oz_tree_at(root, path);
    if (node && node->parent) {
        oz_tree_detach(node);
        oz_tree_free(node);
    }
}

static OzStatus parse_setting(Loader *loader, const char *setting, int i)
{
    OzStatus status = OZ_OK;
    OzSource *source = &loader->sources[i + 2];
    OzNode *value = NULL;
    const char *equals = strchr(setting, '=');
    char *path = NULL;
    const char *cut = strlen(setting) > LONGEST_LABEL ? "..." : "";
    if (asprintf(&loader->labels[i + 2], "--set %.*s%s", LONGEST_LABEL, setting, cut) < 0) {
        loader->labels[i + 2] = NULL;
        return oz_status_fail(OZ_ERR_MEMORY, "out of memory for a setting");
    }
    source->name = loader->labels[i + 2];
    if (setting[0] == '-') { /* of a program, never of a person */
        take_out(loader->root, setting + 1);
        return OZ_OK;
    }
    if (!equals || equals == setting) {
        oz_faults_add(&loader->faults, source, 1, "no key and value; expected --set key=value");
        return OZ_OK;
    }
    OZ_TRY(oz_document_parse(&value, equals + 1, strlen(equals + 1), source, &loader->faults));
    if (!value) {
        OZ_TRY(oz_tree_create(&value, OZ_NODE_SCALAR, source, 1, NULL, ""));
    }
    OZ_TRY(oz_memory_text(&path, setting));
    path[equals - setting] = '\0';
    OzNode *given = value;
    value = NULL;
    OZ_TRY(oz_layers_set(loader->root, path, given, &loader->faults));
done:
    oz_tree_free(value);
    free(path);
    return status;
}

static OzStatus read_all(Loader *loader, OzScene *scene, const char *text, size_t length,
                         char *const *settings, int setting_count)
{
    OZ_PASS(parse_file(loader, &loader->root, text, length, &loader->sources[0]));
    if (!loader->root) {
        return OZ_OK;
    }
    OZ_PASS(extend(loader));
    for (int i = 0; i < setting_count; i++) {
        OZ_PASS(parse_setting(loader, settings[i], i));
    }
    OZ_PASS(oz_read_scene(scene, loader->root, &loader->faults));
    if (loader->faults.misspelt > 0) {
        return OZ_OK; /* what else does not fit may be no more than the lack of these keys */
    }
    oz_wall_shape_meet(scene);
    OZ_PASS(oz_trace_load_walls(scene, &loader->faults));
    OZ_PASS(oz_wall_meshes_load(scene, loader->running, loader->root, &loader->faults));
    OZ_PASS(oz_check_scene(scene, loader->root, &loader->faults));
    return loader->running
               ? oz_changes_refuse(loader->running, scene, loader->root, &loader->faults)
               : OZ_OK;
}

/* Where a text came from, to be named in messages; NULL: from the file at path. */
static OzStatus load_text(OzScene *scene, const OzScene *running, const char *path,
                          const char *text, size_t length, char *const *settings, int setting_count)
{
    OzStatus status = OZ_OK;
    Loader loader = {.running = running};
    *scene = (OzScene){0};
    OZ_TRY(loader_create(&loader, path, setting_count));
    OZ_TRY(oz_memory_text(&scene->path, path));
    OZ_TRY(oz_scene_name(&scene->name, path));
    OZ_TRY(read_all(&loader, scene, text, length, settings, setting_count));
    OZ_TRY(oz_memory_text(&scene->base, loader.labels[1]));
    OZ_TRY(oz_faults_report(&loader.faults));
done:
    /* A reader that could not go on left its one fault behind. */
    if (status == OZ_ERR_INPUT) {
        oz_faults_report(&loader.faults);
    }
    if (status != OZ_OK) {
        oz_scene_free(scene);
    }
    loader_free(&loader);
    return status;
}

OzStatus oz_scene_load(OzScene *scene, const char *path, char *const *settings, int setting_count)
{
    return oz_scene_reload(scene, NULL, path, settings, setting_count);
}

OzStatus oz_scene_reload(OzScene *scene, const OzScene *running, const char *path,
                         char *const *settings, int setting_count)
{
    char *text = NULL;
    size_t length = 0;
    *scene = (OzScene){0};
    OzStatus status = oz_file_read(&text, &length, path);
    if (status == OZ_ERR_FILE) {
        char why[1024];
        snprintf(why, sizeof why, "%s", oz_status_text());
        status = oz_status_fail(OZ_ERR_INPUT, "%s; expected a scene file", why);
    }
    if (status == OZ_OK) {
        status = load_text(scene, running, path, text, length, settings, setting_count);
    }
    free(text);
    return status;
}

OzStatus oz_scene_parse(OzScene *scene, const char *path, const char *text, char *const *settings,
                        int setting_count)
{
    return load_text(scene, NULL, path, text, strlen(text), settings, setting_count);
}

OzStatus oz_scene_text(const OzScene *scene, char **text, size_t *length)
{
    *text = NULL;
    FILE *file = open_memstream(text, length);
    if (file) {
        oz_write_scene(scene, file);
    }
    if (!file || fclose(file) != 0 || !*text) {
        free(*text);
        *text = NULL;
        return oz_status_fail(OZ_ERR_MEMORY, "out of memory for a scene's text");
    }
    return OZ_OK;
}

OzStatus oz_scene_change(OzScene *scene, const OzScene *running, char *const *settings,
                         int setting_count)
{
    char *text = NULL;
    size_t length = 0;
    *scene = (OzScene){0};
    OZ_PASS(oz_scene_text(running, &text, &length));
    OzStatus status =
        load_text(scene, running, running->path, text, length, settings, setting_count);
    free(text);
    return status;
}

OzStatus oz_scene_write(const OzScene *scene, FILE *file)
{
    oz_write_scene(scene, file);
    fflush(file);
    return ferror(file) ? oz_status_fail(OZ_ERR_FILE, "cannot write the scene %s", scene->name)
                        : OZ_OK;
}

/* A list's items and what each of their rows owns. */
static OzStatus own_items(const OzKey *list, OzScene *copy, const OzScene *scene)
{
    OzStatus status = OZ_OK;
    char **items = oz_value_at(list, copy);
    int count = *oz_value_count(list, scene);
    size_t length = strlen(list->path);
    OZ_PASS(oz_memory_new((void **)items, (size_t)count, list->item_size, "a scene's list"));
    *oz_value_count(list, copy) = count;
    if (count > 0) {
        memcpy(*items, *(char *const *)oz_value_at(list, scene), (size_t)count * list->item_size);
    }
    for (const OzKey *key = list + 1; key->path; key++) {
        bool below = strncmp(key->path, list->path, length) == 0;
        for (int i = 0; below && i < count; i++) {
            OzStatus own = oz_value_own(key, *items + (size_t)i * list->item_size);
            status = status == OZ_OK ? own : status;
        }
    }
    return status;
}

/* What rows outside of lists own; lists are left empty. */
static OzStatus own_rows(OzScene *copy)
{
    OzStatus status = OZ_OK;
    for (const OzKey *key = oz_keys_all(); key->path; key++) {
        if (key->type == OZ_KEY_ITEMS) {
            *(void **)oz_value_at(key, copy) = NULL;
            *oz_value_count(key, copy) = 0;
        } else if (!strstr(key->path, "[]")) {
            OzStatus own = oz_value_own(key, copy);
            status = status == OZ_OK ? own : status;
        }
    }
    return status;
}

OzStatus oz_scene_copy(OzScene *copy, const OzScene *scene)
{
    OzStatus status = OZ_OK;
    *copy = *scene;
    copy->sweep = (OzSweep){0};
    copy->path = copy->base = copy->name = NULL;
    OZ_TRY(own_rows(copy));
    OZ_TRY(oz_sweep_copy(&copy->sweep, &scene->sweep));
    OZ_TRY(oz_memory_text(&copy->path, scene->path));
    OZ_TRY(oz_memory_text(&copy->base, scene->base));
    OZ_TRY(oz_memory_text(&copy->name, scene->name));
    for (const OzKey *key = oz_keys_all(); key->path; key++) {
        if (key->type == OZ_KEY_ITEMS) {
            OZ_TRY(own_items(key, copy, scene));
        }
    }
done:
    oz_trace_keep_walls(copy);
    oz_wall_meshes_share(copy);
    if (status != OZ_OK) {
        oz_scene_free(copy);
    }
    return status;
}

static void free_items(const OzKey *list, OzScene *scene)
{
    char **items = oz_value_at(list, scene);
    size_t length = strlen(list->path);
    for (const OzKey *key = list + 1; key->path; key++) {
        bool below = strncmp(key->path, list->path, length) == 0;
        for (int i = 0; below && i < *oz_value_count(list, scene); i++) {
            oz_value_free(key, *items + (size_t)i * list->item_size);
        }
    }
    free(*items);
}

void oz_scene_free(OzScene *scene)
{
    oz_trace_free_walls(scene);
    oz_wall_meshes_drop(scene);
    for (const OzKey *key = oz_keys_all(); key->path; key++) {
        if (key->type == OZ_KEY_ITEMS) {
            free_items(key, scene);
        } else if (!strstr(key->path, "[]")) {
            oz_value_free(key, scene);
        }
    }
    free(scene->path);
    free(scene->base);
    free(scene->name);
    *scene = (OzScene){0};
}

static bool is_of_contacts(OzColour colour)
{
    return colour == OZ_COLOUR_FORCE || colour == OZ_COLOUR_COORDINATION;
}

bool oz_scene_shows_contacts(const OzScene *scene)
{
    return scene->movie.chains || is_of_contacts(scene->movie.colour) ||
           is_of_contacts(scene->snapshots.colour);
}
