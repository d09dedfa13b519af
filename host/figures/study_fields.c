/* One value at a time, by its row's type. */
#include "figures/study_fields.h"

#include "base/memory.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

void *oz_study_fields_at(const OzStudyField *field, const void *base)
{
    return (char *)(uintptr_t)base + field->offset;
}

bool oz_study_fields_has(const char *words, const char *word)
{
    size_t length = strlen(word);
    for (const char *at = words; *at; at += strspn(at, " ")) {
        size_t here = strcspn(at, " ");
        if (here == length && strncmp(at, word, length) == 0) {
            return true;
        }
        at += here;
    }
    return false;
}

static bool is_known(const OzStudyField *field, const char *kind)
{
    return !field->of || !kind || oz_study_fields_has(field->of, kind);
}

static const OzStudyField *find_field(const OzStudyField *fields, const char *kind,
                                      const char *name)
{
    for (; fields->name; fields++) {
        if (is_known(fields, kind) && strcmp(fields->name, name) == 0) {
            return fields;
        }
    }
    return NULL;
}

static void refuse(const OzNode *node, const char *expected, OzFaults *faults)
{
    if (!node->refused) {
        oz_faults_add(faults, node->source, node->line, "%s is %s; expected %s",
                      node->key                           ? node->key
                      : node->parent && node->parent->key ? node->parent->key
                                                          : "an entry",
                      node->kind == OZ_NODE_LIST  ? "a list"
                      : node->kind == OZ_NODE_MAP ? "a group"
                      : node->text[0]             ? node->text
                                                  : "empty",
                      expected);
    }
}

static bool is_text(const OzNode *node)
{
    return node->kind == OZ_NODE_SCALAR && !node->refused && node->text[0];
}

/* The node is none of a field's words, which are told with commas between. */
static void refuse_choice(const OzStudyField *field, const OzNode *node, OzFaults *faults)
{
    char expected[256] = "one of ";
    size_t used = strlen(expected), here;
    const char *separator = "";
    for (const char *at = field->choices; *at && used < sizeof expected; at += here) {
        here = strcspn(at, " ");
        used += (size_t)snprintf(expected + used, sizeof expected - used, "%s%.*s", separator,
                                 (int)here, at);
        separator = ", ";
        here += strspn(at + here, " ");
    }
    refuse(node, expected, faults);
}

static OzStatus read_text(const OzStudyField *field, const OzNode *node, char **text,
                          OzFaults *faults)
{
    bool is_one = is_text(node);
    if (field->choices && !(is_one && oz_study_fields_has(field->choices, node->text))) {
        refuse_choice(field, node, faults);
        return OZ_OK;
    }
    if (!is_one) {
        refuse(node, "a text", faults);
        return OZ_OK;
    }
    return oz_memory_text(text, node->text);
}

/* Entry i of a list, or the value that stands alone. */
static const OzNode *item_of(const OzNode *node, int i)
{
    return node->kind == OZ_NODE_LIST ? node->items[i] : node;
}

static OzStatus read_texts(const OzNode *node, OzTexts *texts, OzFaults *faults)
{
    int count = node->kind == OZ_NODE_LIST ? node->count : 1;
    OZ_PASS(OZ_NEW(&texts->items, count));
    for (int i = 0; i < count; i++) {
        if (!is_text(item_of(node, i))) {
            refuse(item_of(node, i), "a text, or a list of texts", faults);
            return OZ_OK;
        }
        OZ_PASS(oz_memory_text(&texts->items[texts->count++], item_of(node, i)->text));
    }
    return OZ_OK;
}

static bool read_number(const OzNode *node, double *number)
{
    char *end = NULL;
    if (!is_text(node) || node->quoted || node->text[strspn(node->text, "+-.0123456789eE")]) {
        return false;
    }
    *number = strtod(node->text, &end);
    return *end == '\0' && isfinite(*number);
}

static OzStatus read_numbers(const OzStudyField *field, const OzNode *node, OzNumbers *numbers,
                             OzFaults *faults)
{
    int count = node->kind == OZ_NODE_LIST ? node->count : 1;
    char expected[64] = "a number, or a list of numbers";
    if (field->count > 1) {
        snprintf(expected, sizeof expected, "a list of %d numbers", field->count);
    }
    OZ_PASS(OZ_NEW(&numbers->items, count));
    for (int i = 0; i < count; i++) {
        if (!read_number(item_of(node, i), &numbers->items[i])) {
            refuse(item_of(node, i), expected, faults);
            return OZ_OK;
        }
    }
    if (count == 0 || (field->count && field->count != count)) {
        refuse(node, expected, faults);
        return OZ_OK;
    }
    numbers->count = count;
    return OZ_OK;
}

static OzStatus read_flag(const OzNode *node, bool *flag, OzFaults *faults)
{
    bool yes = is_text(node) && strcmp(node->text, "true") == 0;
    if (!yes && !oz_tree_is_false(node)) {
        refuse(node, "true or false", faults);
    }
    *flag = yes;
    return OZ_OK;
}

static OzStatus read_value(const OzStudyField *field, const OzNode *node, void *base,
                           OzFaults *faults)
{
    void *place = oz_study_fields_at(field, base);
    switch (field->type) {
    case OZ_STUDY_FIELD_TEXT:
        return read_text(field, node, place, faults);
    case OZ_STUDY_FIELD_TEXTS:
        return read_texts(node, place, faults);
    case OZ_STUDY_FIELD_NUMBERS:
        return read_numbers(field, node, place, faults);
    case OZ_STUDY_FIELD_FLAG:
        break;
    }
    return read_flag(node, place, faults);
}

static void refuse_unknown(const OzStudyField *fields, const char *kind, const OzNode *node,
                           const char *what, OzFaults *faults)
{
    char names[512] = "";
    size_t used = 0;
    for (const OzStudyField *field = fields; field->name && used < sizeof names; field++) {
        if (is_known(field, kind)) {
            used += (size_t)snprintf(names + used, sizeof names - used, "%s%s", used ? ", " : "",
                                     field->name);
        }
    }
    oz_faults_add(faults, node->source, node->line, "%s is no key of %s; expected one of %s",
                  node->key, what, names);
}

OzStatus oz_study_fields_read(const OzStudyField *fields, const char *kind, const OzNode *map,
                              const char *what, void *base, OzFaults *faults)
{
    if (map->kind != OZ_NODE_MAP) {
        oz_faults_add(faults, map->source, map->line,
                      "%s is no group of keys; expected {name: ...}", what);
        return OZ_OK;
    }
    for (int i = 0; i < map->count; i++) {
        const OzStudyField *field = find_field(fields, kind, map->items[i]->key);
        if (oz_tree_child(map, map->items[i]->key) != map->items[i]) {
            continue; /* written twice, which is refused already */
        }
        if (!field) {
            refuse_unknown(fields, kind, map->items[i], what, faults);
        } else {
            OZ_PASS(read_value(field, map->items[i], base, faults));
        }
    }
    for (; fields->name; fields++) {
        if (fields->needed && (kind ? is_known(fields, kind) : !fields->of) &&
            !oz_tree_child(map, fields->name)) {
            oz_faults_add(faults, map->source, map->line, "%s has no %s; expected it", what,
                          fields->name);
        }
    }
    return OZ_OK;
}

static void free_texts(OzTexts *texts)
{
    for (int i = 0; i < texts->count; i++) {
        free(texts->items[i]);
    }
    free(texts->items);
}

void oz_study_fields_free(const OzStudyField *fields, void *base)
{
    for (; fields->name; fields++) {
        void *place = oz_study_fields_at(fields, base);
        if (fields->type == OZ_STUDY_FIELD_TEXT) {
            free(*(char **)place);
        } else if (fields->type == OZ_STUDY_FIELD_TEXTS) {
            free_texts(place);
        } else if (fields->type == OZ_STUDY_FIELD_NUMBERS) {
            free(((OzNumbers *)place)->items);
        }
    }
}
