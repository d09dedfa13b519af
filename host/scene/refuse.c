/* Faults about keys. Knows no key by name but `kind`. */
#include "scene/refuse.h"

#include "scene/describe.h"

#include <stdint.h>
#include <stdio.h>
#include <string.h>

enum { LONGEST_PATH = 256 };

static void refuse_item_key(OzFaults *faults, const OzNode *node, const OzKey *kind, unsigned kinds,
                            const char *names)
{
    char path[LONGEST_PATH], is[64];
    oz_tree_path(node, false, path, sizeof path);
    oz_describe_bits(kinds, kind->path, is, sizeof is);
    oz_faults_add(faults, node->source, node->line,
                  "unknown key %.100s of kind %s (%s: %s); expected one of %s", path, is,
                  kind->path, kind->help, names);
}

/* Keys that are looked for here and have another name. */
static const struct {
    const char *was, *is;
} moved[] = {
    {"grains[].length", "aspect: the shaft's length over the diameter"},
    {"observe.contacts", "the group contacts, as in contacts: {}"},
    {"observe.contacts_interval", "contacts.interval"},
};

/* Whether the key at this path has moved, which is said then. */
static bool refuse_moved(OzFaults *faults, const OzNode *node, const char *path)
{
    for (size_t k = 0; k < sizeof moved / sizeof *moved; k++) {
        if (strcmp(path, moved[k].was) == 0) {
            char written[LONGEST_PATH];
            oz_tree_path(node, false, written, sizeof written);
            oz_faults_add(faults, node->source, node->line, "%s has another name; expected %s",
                          written, moved[k].is);
            return true;
        }
    }
    return false;
}

void oz_refuse_unknown(OzFaults *faults, const OzNode *node, int model, unsigned kinds,
                       unsigned shapes)
{
    char path[LONGEST_PATH], group[LONGEST_PATH], kind[LONGEST_PATH + 8], text[1024];
    oz_tree_path(node, true, path, sizeof path);
    oz_tree_path(node->parent, true, group, sizeof group);
    snprintf(kind, sizeof kind, "%s.kind", group);
    if (refuse_moved(faults, node, path)) {
        return;
    }
    bool near = oz_describe_nearest(path, model, text, sizeof text);
    oz_tree_path(node, false, path, sizeof path);
    if (near) {
        faults->misspelt++;
        oz_faults_add(faults, node->source, node->line, "unknown key %.100s; did you mean %s?",
                      path, text);
        return;
    }
    oz_describe_names(group, model, kinds, shapes, text, sizeof text);
    if (kinds && oz_keys_of(kind, model)) {
        refuse_item_key(faults, node, oz_keys_of(kind, model), kinds, text);
    } else {
        oz_faults_add(faults, node->source, node->line, "unknown key %.100s; expected one of %s",
                      path, text);
    }
}

void oz_refuse_foreign(OzFaults *faults, const OzNode *node, const char *choice, unsigned owners,
                       unsigned own)
{
    char path[LONGEST_PATH], is[32], expected[128];
    const char *dot = strrchr(choice, '.'), *name = dot ? dot + 1 : choice;
    oz_tree_path(node, false, path, sizeof path);
    oz_describe_bits(own, choice, is, sizeof is);
    oz_describe_bits(owners, choice, expected, sizeof expected);
    oz_faults_add(faults, node->source, node->line,
                  "%s makes no sense for %s %s; expected it with %s %s only", path, name, is, name,
                  expected);
}

void oz_refuse_shared(OzFaults *faults, const OzNode *node, const OzKey *key)
{
    char path[LONGEST_PATH];
    oz_tree_path(node, false, path, sizeof path);
    oz_faults_add(faults, node->source, node->line,
                  "%s is one for the whole scene; expected it at %s", path, key->inherits);
}

void oz_refuse_missing(OzFaults *faults, const OzNode *group, const char *prefix, const OzKey *key)
{
    char path[LONGEST_PATH], expected[256], rival[64] = "";
    const char *name = key->path + strlen(prefix);
    const OzNode *nearest = oz_tree_nearest((OzNode *)(uintptr_t)group, name);
    oz_tree_path(group, false, path, sizeof path);
    oz_describe_expected(key, expected, sizeof expected);
    if (key->rival) {
        snprintf(rival, sizeof rival, " (or %s)", key->rival);
    }
    oz_faults_add(faults, nearest->source, nearest->line, "%s%s%s%s is missing; expected %s", path,
                  path[0] ? "." : "", name, rival, expected);
}
