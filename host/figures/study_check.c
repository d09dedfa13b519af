/* One rule after the other. */
#include "figures/study_check.h"

#include "base/file.h"
#include "observe/series.h"

#include <ctype.h>
#include <string.h>

void oz_study_check_name(const OzNode *map, const char *name, bool is_taken, OzFaults *faults)
{
    static const char letters[] =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.";
    const OzNode *node = oz_tree_child(map, "name");
    if (name && (name[0] == '.' || name[strspn(name, letters)])) {
        oz_faults_add(faults, node->source, node->line,
                      "name is %s; expected letters, digits, _, - and dots, which name a file",
                      name);
    } else if (name && is_taken) {
        oz_faults_add(faults, node->source, node->line, "%s is there already; expected a new name",
                      name);
    }
}

void oz_study_check_run(const OzNode *map, const OzStudyRun *run, OzFaults *faults)
{
    const OzNode *scene = oz_tree_child(map, "scene"), *seeds = oz_tree_child(map, "seeds");
    const double *seed = run->seeds.items;
    if (run->path && !oz_file_exists(run->path)) {
        oz_faults_add(faults, scene->source, scene->line, "there is no %s; expected a scene",
                      run->path);
    }
    if (run->seeds.count == 2 &&
        (seed[0] < 0 || seed[1] < seed[0] || seed[1] > 1e9 || seed[0] != (double)(int64_t)seed[0] ||
         seed[1] != (double)(int64_t)seed[1])) {
        oz_faults_add(faults, seeds->source, seeds->line,
                      "seeds are no span; expected [first, last], whole numbers from 0 on");
    }
}

/* Runs that a figure names must be there. */
static void check_runs(const OzStudy *study, const OzNode *map, const char *key,
                       const OzTexts *names, OzFaults *faults)
{
    const OzNode *node = oz_tree_child(map, key);
    for (int i = 0; i < names->count; i++) {
        if (oz_study_find_run(study, names->items[i]) < 0) {
            const OzNode *item = node->kind == OZ_NODE_LIST ? node->items[i] : node;
            oz_faults_add(faults, item->source, item->line,
                          "%s is none of the study's runs; expected a name of one",
                          names->items[i]);
        }
    }
}

static void check_range(const OzNode *map, const char *key, const OzNumbers *range, bool log,
                        OzFaults *faults)
{
    const OzNode *node = oz_tree_child(map, key);
    if (range->count == 2 &&
        (range->items[1] <= range->items[0] || (log && range->items[0] <= 0))) {
        oz_faults_add(faults, node->source, node->line, "%s is empty; expected [low, high]%s", key,
                      log ? ", above 0 on a logarithmic axis" : "");
    }
}

/* Whether a name is one of this column, whose <i> stands for a number and <x> for an axis. */
static bool fits(const char *column, const char *name)
{
    while (*column && *name) {
        if (strncmp(column, "<i>", 3) == 0 && isdigit((unsigned char)*name)) {
            column += 3;
            name += strspn(name, "0123456789");
        } else if (strncmp(column, "<x>", 3) == 0 && strchr("xyz", *name)) {
            column += 3;
            name++;
        } else if (*column++ != *name++) {
            return false;
        }
    }
    return !*column && !*name;
}

/* Every part of a sum. */
static bool is_column(const char *names)
{
    char name[OZ_COLUMN_NAME];
    for (const char *at = names;; at++) {
        size_t length = strcspn(at, "+");
        const OzColumn *column = oz_series_columns();
        snprintf(name, sizeof name, "%.*s", (int)length, at);
        while (column->name && !fits(column->name, name)) {
            column++;
        }
        if (!column->name || length >= sizeof name) {
            return false;
        }
        at += length;
        if (!*at) {
            return true;
        }
    }
}

static void check_column(const OzNode *map, const char *key, const char *name, OzFaults *faults)
{
    const OzNode *node = oz_tree_child(map, key);
    if (name && !is_column(name)) {
        oz_faults_add(faults, node->source, node->line,
                      "%s holds %.100s; expected a column that `orzo keys --columns` lists%s", key,
                      name, strcmp(key, "columns") == 0 ? ", or some with + between" : "");
    }
}

static void check_columns(const OzNode *map, const OzStudyFigure *figure, OzFaults *faults)
{
    for (int i = 0; i < figure->columns.count; i++) {
        check_column(map, "columns", figure->columns.items[i], faults);
    }
    for (int i = 0; i < figure->inset_columns.count; i++) {
        check_column(map, "inset_columns", figure->inset_columns.items[i], faults);
    }
    check_column(map, "bars", figure->bars, faults);
    check_column(map, "at_greatest", figure->at_greatest, faults);
}

/* As of pictures in scenes. */
static void check_size(const OzNode *map, const OzNumbers *size, OzFaults *faults)
{
    const OzNode *node = oz_tree_child(map, "size");
    for (int i = 0; i < size->count; i++) {
        double side = size->items[i];
        if (side < 64 || side > 2048 || side != (int)side) {
            oz_faults_add(faults, node->source, node->line,
                          "size is %g; expected whole pixels from 64 to 2048", side);
        }
    }
}

static void check_smooth(const OzNode *map, const OzNumbers *smooth, OzFaults *faults)
{
    double rows = smooth->count ? smooth->items[0] : 1;
    const OzNode *node = oz_tree_child(map, "smooth");
    if (rows < 1 || rows > 1e4 || rows != (int)rows) {
        oz_faults_add(faults, node->source, node->line,
                      "smooth is %g; expected a whole number of rows from 1 to 10000", rows);
    }
}

/* As many numbers and parts as rows. */
static void check_rows(const OzNode *map, const OzStudyFigure *figure, OzFaults *faults)
{
    int rows = figure->rows.count;
    if (figure->paper.count != rows || figure->parts.count != rows) {
        oz_faults_add(
            faults, map->source, map->line,
            "there are %d rows, %d numbers of the paper and %d parts; expected as many of "
            "each",
            rows, figure->paper.count, figure->parts.count);
    }
}

void oz_study_check_figure(const OzStudy *study, const OzNode *map, const OzStudyFigure *figure,
                           OzFaults *faults)
{
    check_runs(study, map, "runs", &figure->runs, faults);
    check_runs(study, map, "inset_run", &figure->inset_run, faults);
    check_range(map, "x_range", &figure->x_range, figure->x_log, faults);
    check_range(map, "y_range", &figure->y_range, false, faults);
    check_columns(map, figure, faults);
    check_size(map, &figure->size, faults);
    check_smooth(map, &figure->smooth, faults);
    check_rows(map, figure, faults);
}
