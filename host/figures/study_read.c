/* THE lists of a study's keys, and its file. */
#include "figures/study_read.h"

#include "base/file.h"
#include "base/memory.h"
#include "figures/figure_kinds.h"
#include "figures/study_check.h"
#include "scene/document.h"

#include <stdlib.h>
#include <string.h>

#define KIND_WORD(name, measure, draw) #name " "
static const char kind_words[] = OZ_FIGURE_KINDS(KIND_WORD);
#undef KIND_WORD

#define TEXT(base, member)    .type = OZ_STUDY_FIELD_TEXT, .offset = offsetof(base, member)
#define TEXTS(base, member)   .type = OZ_STUDY_FIELD_TEXTS, .offset = offsetof(base, member)
#define NUMBERS(base, member) .type = OZ_STUDY_FIELD_NUMBERS, .offset = offsetof(base, member)
#define FLAG(base, member)    .type = OZ_STUDY_FIELD_FLAG, .offset = offsetof(base, member)

/* clang-format off */
static const OzStudyField run_fields[] = {
    {"name", TEXT(OzStudyRun, name), .needed = true},
    {"scene", TEXT(OzStudyRun, scene), .needed = true},
    {"label", TEXT(OzStudyRun, label)},
    {"seeds", NUMBERS(OzStudyRun, seeds), .count = 2},
    {"set", TEXTS(OzStudyRun, set)},
    {"quick", TEXTS(OzStudyRun, quick)},
    {NULL, TEXT(OzStudyRun, path)},
};

static const OzStudyField quick_fields[] = {
    {"seeds", NUMBERS(OzStudyQuick, seeds), .count = 1},
    {"set", TEXTS(OzStudyQuick, set)},
    {NULL, TEXTS(OzStudyQuick, set)},
};

static const OzStudyField figure_fields[] = {
    {"name", TEXT(OzStudyFigure, name), .needed = true},
    {"kind", TEXT(OzStudyFigure, kind), .needed = true, .choices = kind_words},
    {"title", TEXT(OzStudyFigure, title)},
    {"runs", TEXTS(OzStudyFigure, runs), .needed = true},
    {"columns", TEXTS(OzStudyFigure, columns), .of = "curves sweep", .needed = true},
    {"labels", TEXTS(OzStudyFigure, labels), .of = "curves"},
    {"against", TEXT(OzStudyFigure, against), .of = "curves", .needed = true,
     .choices = "step time tap"},
    {"panels", TEXT(OzStudyFigure, panels), .of = "curves", .choices = "runs columns"},
    {"x_label", TEXT(OzStudyFigure, x_label), .of = "curves sweep"},
    {"y_label", TEXT(OzStudyFigure, y_label), .of = "curves sweep"},
    {"x_range", NUMBERS(OzStudyFigure, x_range), .of = "curves sweep", .count = 2},
    {"y_range", NUMBERS(OzStudyFigure, y_range), .of = "curves sweep", .count = 2},
    {"x_log", FLAG(OzStudyFigure, x_log), .of = "curves sweep"},
    {"key", TEXT(OzStudyFigure, key), .of = "curves sweep",
     .choices = "top-left top-right bottom-left bottom-right center-left center-right"},
    {"smooth", NUMBERS(OzStudyFigure, smooth), .of = "curves", .count = 1},
    {"dashes", FLAG(OzStudyFigure, dashes), .of = "curves"},
    {"absolute", FLAG(OzStudyFigure, absolute), .of = "curves"},
    {"inset_run", TEXTS(OzStudyFigure, inset_run), .of = "curves"},
    {"inset_columns", TEXTS(OzStudyFigure, inset_columns), .of = "curves"},
    {"inset_range", NUMBERS(OzStudyFigure, inset_range), .of = "curves", .count = 2},
    {"at", NUMBERS(OzStudyFigure, at), .of = "pictures"},
    {"at_greatest", TEXT(OzStudyFigure, at_greatest), .of = "pictures"},
    {"before", NUMBERS(OzStudyFigure, before), .of = "pictures", .count = 1},
    {"from", NUMBERS(OzStudyFigure, from), .of = "pictures", .count = 1},
    {"bars", TEXT(OzStudyFigure, bars), .of = "sweep"},
    {"power", NUMBERS(OzStudyFigure, power), .of = "sweep", .count = 1},
    {"rows", TEXTS(OzStudyFigure, rows), .of = "shares", .needed = true},
    {"paper", NUMBERS(OzStudyFigure, paper), .of = "shares", .needed = true},
    {"parts", TEXTS(OzStudyFigure, parts), .of = "shares", .needed = true},
    {"views", TEXTS(OzStudyFigure, views), .of = "pictures"},
    {"picture", TEXTS(OzStudyFigure, picture), .of = "pictures"},
    {"size", NUMBERS(OzStudyFigure, size), .of = "pictures", .count = 2},
    {NULL, TEXT(OzStudyFigure, name)},
};
/* clang-format on */

static const char top_keys[] = "name title quick runs figures";

/* The scene's path beside the study's file. */
static OzStatus find_scene(OzStudyRun *run, const char *study)
{
    OzStatus status = OZ_OK;
    char *folder = NULL;
    OZ_TRY(oz_memory_text(&folder, study));
    char *slash = strrchr(folder, '/');
    if (slash) {
        *slash = '\0';
    }
    OZ_TRY(oz_file_join(&run->path, slash ? folder : NULL, run->scene));
done:
    free(folder);
    return status;
}

static OzStatus read_run(OzStudy *study, const OzNode *map, OzFaults *faults)
{
    int number = study->run_count++;
    OzStudyRun *run = &study->runs[number];
    OZ_PASS(oz_study_fields_read(run_fields, NULL, map, "a run", run, faults));
    oz_study_check_name(map, run->name, run->name && oz_study_find_run(study, run->name) < number,
                        faults);
    run->line = map->line;
    OZ_PASS(run->scene ? find_scene(run, study->path) : OZ_OK);
    oz_study_check_run(map, run, faults);
    return OZ_OK;
}

static OzStatus read_figure(OzStudy *study, const OzNode *map, OzFaults *faults)
{
    int number = study->figure_count++;
    OzStudyFigure *figure = &study->figures[number];
    const OzNode *kind = oz_tree_child(map, "kind");
    bool known =
        kind && kind->kind == OZ_NODE_SCALAR && oz_study_fields_has(kind_words, kind->text);
    OZ_PASS(oz_study_fields_read(figure_fields, known ? kind->text : NULL, map, "a figure", figure,
                                 faults));
    bool taken = figure->name && oz_study_find_figure(study, figure->name) < number;
    if (map->kind == OZ_NODE_MAP) {
        oz_study_check_name(map, figure->name, taken, faults);
        oz_study_check_figure(study, map, figure, faults);
    }
    return OZ_OK;
}

/* A list of the file with one entry or more; NULL with a fault where it is none. */
static const OzNode *list_of(const OzNode *root, const char *key, OzFaults *faults)
{
    const OzNode *list = oz_tree_child(root, key);
    if (!list || list->kind != OZ_NODE_LIST || list->count == 0) {
        oz_faults_add(faults, root->source, list ? list->line : root->line,
                      "there are no %s; expected a list of them", key);
        return NULL;
    }
    return list;
}

static OzStatus read_top(OzStudy *study, const OzNode *root, OzFaults *faults)
{
    for (int i = 0; i < root->count; i++) {
        const OzNode *item = root->items[i];
        if (!oz_study_fields_has(top_keys, item->key)) {
            oz_faults_add(faults, item->source, item->line,
                          "%s is no key of a study; expected one of %s", item->key, top_keys);
        }
    }
    const OzNode *name = oz_tree_child(root, "name"), *title = oz_tree_child(root, "title");
    if (!name || name->kind != OZ_NODE_SCALAR) {
        oz_faults_add(faults, root->source, root->line, "a study has a name; expected name: ...");
    } else {
        OZ_PASS(oz_memory_text(&study->name, name->text));
        oz_study_check_name(root, study->name, false, faults);
    }
    return title && title->kind == OZ_NODE_SCALAR ? oz_memory_text(&study->title, title->text)
                                                  : OZ_OK;
}

static OzStatus read_study(OzStudy *study, const OzNode *root, OzFaults *faults)
{
    OZ_PASS(read_top(study, root, faults));
    const OzNode *quick = oz_tree_child(root, "quick");
    if (quick) {
        OZ_PASS(oz_study_fields_read(quick_fields, NULL, quick, "quick", &study->quick, faults));
    }
    const OzNode *runs = list_of(root, "runs", faults), *figures = list_of(root, "figures", faults);
    OZ_PASS(OZ_NEW(&study->runs, runs ? runs->count : 0));
    OZ_PASS(OZ_NEW(&study->figures, figures ? figures->count : 0));
    for (int i = 0; runs && i < runs->count; i++) {
        OZ_PASS(read_run(study, runs->items[i], faults));
    }
    for (int i = 0; runs && figures && i < figures->count; i++) {
        OZ_PASS(read_figure(study, figures->items[i], faults));
    }
    return OZ_OK;
}

OzStatus oz_study_read_file(OzStudy *study, const char *path)
{
    OzStatus status = OZ_OK;
    OzSource source = {.name = path};
    OzFaults faults = {0};
    OzNode *root = NULL;
    char *text = NULL;
    size_t length = 0;
    *study = (OzStudy){0};
    OZ_TRY(oz_memory_text(&study->path, path));
    OZ_TRY(oz_file_read(&text, &length, path));
    status = oz_document_parse(&root, text, length, &source, &faults);
    if (status == OZ_OK && (!root || root->kind != OZ_NODE_MAP)) {
        oz_faults_add(&faults, &source, 1, "this is no study; expected name, runs and figures");
    } else if (status == OZ_OK) {
        OZ_TRY(read_study(study, root, &faults));
    }
    status = status == OZ_OK || status == OZ_ERR_INPUT ? oz_faults_report(&faults) : status;
done:
    oz_faults_free(&faults);
    oz_tree_free(root);
    free(text);
    return status;
}

void oz_study_read_free(OzStudy *study)
{
    for (int i = 0; i < study->run_count; i++) {
        oz_study_fields_free(run_fields, &study->runs[i]);
        free(study->runs[i].path);
    }
    for (int i = 0; i < study->figure_count; i++) {
        oz_study_fields_free(figure_fields, &study->figures[i]);
    }
    oz_study_fields_free(quick_fields, &study->quick);
    free(study->runs);
    free(study->figures);
    free(study->path);
    free(study->name);
    free(study->title);
    *study = (OzStudy){0};
}
