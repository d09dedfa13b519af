/* Looking materials up by name. */
#include "scene/check_materials.h"

#include "scene/mixing.h"

#include <stdio.h>
#include <string.h>

enum { PATH = 64, NAMES = 200 };

typedef struct Checker {
    OzScene *scene;
    OzNode *root;
    OzFaults *faults;
    char names[NAMES]; /* of all materials */
    bool failed;
} Checker;

#define fault(checker, ...)                                                                        \
    ((checker)->failed = true, oz_tree_fault((checker)->root, (checker)->faults, __VA_ARGS__))

/* The material's number, from 1; 0: there is none, which is a fault of the value at path. */
static int look_up(Checker *c, const char *path, const char *name)
{
    const OzScene *scene = c->scene;
    for (int i = 0; i < scene->material_count; i++) {
        if (scene->materials[i].name && strcmp(scene->materials[i].name, name) == 0) {
            return i + 1;
        }
    }
    if (scene->material_count == 0) {
        fault(c, path, "%s is %.40s without materials; expected a list of these", path, name);
    } else {
        fault(c, path, "%s is %.40s; expected one of %s", path, name, c->names);
    }
    return 0;
}

static void check_names(Checker *c)
{
    const OzScene *scene = c->scene;
    size_t used = 0;
    for (int i = 0; i < scene->material_count; i++) {
        const char *name = scene->materials[i].name;
        if (!name) {
            c->failed = true;
            continue;
        }
        bool again = false;
        for (int k = 0; k < i && !again; k++) {
            again = scene->materials[k].name && strcmp(scene->materials[k].name, name) == 0;
            if (again) {
                char path[PATH];
                snprintf(path, sizeof path, "materials.%d.name", i);
                fault(c, path, "%s is %.40s as materials.%d; expected each once", path, name, k);
            }
        }
        int length = !again && used < sizeof c->names
                         ? snprintf(c->names + used, sizeof c->names - used, "%s%.40s",
                                    used ? ", " : "", name)
                         : 0;
        used += (size_t)length;
    }
}

/* Where materials are listed grains are of one, or pairs of them would not be known. */
static void check_grains(Checker *c)
{
    OzScene *scene = c->scene;
    for (int i = 0; i < scene->population_count; i++) {
        OzPopulation *grains = &scene->populations[i];
        char path[PATH], density[PATH];
        snprintf(path, sizeof path, "grains.%d.material", i);
        snprintf(density, sizeof density, "grains.%d.density", i);
        if (grains->material) {
            grains->material_number = look_up(c, path, grains->material);
        } else if (scene->material_count > 0) {
            fault(c, path, "%s is missing; expected one of %s", path, c->names);
        }
        if (grains->material_number > 0 && !oz_tree_at(c->root, density)) {
            grains->density = scene->materials[grains->material_number - 1].density;
        }
    }
}

static void check_walls(Checker *c)
{
    OzScene *scene = c->scene;
    for (int w = 0; w < scene->wall_count; w++) {
        char path[PATH], own[PATH];
        snprintf(path, sizeof path, "walls.%d.material", w);
        snprintf(own, sizeof own, "walls.%d.contact", w);
        if (!scene->walls[w].material) {
            continue;
        }
        scene->walls[w].material_number = look_up(c, path, scene->walls[w].material);
        if (oz_tree_at(c->root, own)) {
            fault(c, own, "%s contradicts %s; expected one of the two, or pairs", own, path);
        }
    }
}

static void check_pairs(Checker *c)
{
    OzScene *scene = c->scene;
    for (int i = 0; i < scene->pair_count; i++) {
        char *const *names = scene->pairs[i].between;
        char path[PATH];
        snprintf(path, sizeof path, "pairs.%d.between", i);
        if (!names[0] || !names[1]) {
            c->failed = true;
            continue;
        }
        int one = look_up(c, path, names[0]), other = look_up(c, path, names[1]);
        bool known = one > 0 && other > 0;
        const OzMaterialPair *first = known ? oz_mixing_pair(scene, one, other) : NULL;
        if (first && first != &scene->pairs[i]) {
            fault(c, path, "%s is the pair of pairs.%d; expected each once", path,
                  (int)(first - scene->pairs));
        }
    }
}

/* Kernels have a table of the materials of grains alone. */
static void number_kinds(Checker *c)
{
    OzScene *scene = c->scene;
    int count = 0;
    for (int i = 0; i < scene->material_count; i++) {
        bool is_of_grains = false;
        for (int p = 0; p < scene->population_count; p++) {
            is_of_grains |= scene->populations[p].material_number == i + 1;
        }
        scene->materials[i].kind = is_of_grains ? count++ : -1;
    }
    if (count > OZ_MATERIALS_MAX) {
        fault(c, "materials", "grains are of %d materials; expected at most %d", count,
              OZ_MATERIALS_MAX);
    }
}

void oz_check_materials_resolve(OzScene *scene, OzNode *root, OzFaults *faults)
{
    Checker checker = {.scene = scene, .root = root, .faults = faults};
    check_names(&checker);
    check_grains(&checker);
    check_walls(&checker);
    check_pairs(&checker);
    number_kinds(&checker);
    if (checker.failed) { /* nothing is mixed of what is not there */
        for (int i = 0; i < scene->material_count; i++) {
            scene->materials[i].kind = -1;
        }
    }
    oz_mixing_resolve(scene);
}
