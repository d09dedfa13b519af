/* Which moments, `orzo draw`, and what came of it. */
#include "figures/sheet_pictures.h"

#include "base/cells.h"
#include "base/memory.h"
#include "command/redraw.h"

#include <glob.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SETTING = 1024 };

/* Adds a moment to a list of YAML's. */
static void add_moment(char list[SETTING], double at)
{
    size_t used = strlen(list);
    snprintf(list + used, SETTING - used, "%s%.9g", used > 1 ? ", " : "", at);
}

/* When the figure's column is greatest, s; from its `from` on. */
static OzStatus find_greatest(const OzFigureWork *work, const char *path, double *time)
{
    OzStatus status = OZ_OK;
    OzCells table = {0};
    const OzStudyFigure *figure = work->figure;
    double from = figure->from.count ? figure->from.items[0] : 0, greatest = -INFINITY;
    OZ_TRY(oz_cells_read(&table, path));
    int column = oz_cells_find(&table, figure->at_greatest), at = oz_cells_find(&table, "time");
    if (column < 0 || at < 0) {
        status = oz_status_fail(OZ_ERR_INPUT, "%s has no column %s; expected one of its first line",
                                path, figure->at_greatest);
        goto done;
    }
    for (int64_t row = 0; row < table.row_count; row++) {
        double value = oz_cells_number(&table, row, column), now = oz_cells_number(&table, row, at);
        if (now >= from && value > greatest) {
            greatest = value;
            *time = now;
        }
    }
done:
    oz_cells_free(&table);
    return status;
}

/* A moment some time before the greatest value, and that one's. */
static OzStatus list_greatest(const OzFigureWork *work, const char *member, char list[SETTING])
{
    double time = 0;
    char *path = NULL;
    if (asprintf(&path, "%s/series.csv", member) < 0) {
        return oz_status_fail(OZ_ERR_MEMORY, "out of memory for a path");
    }
    OzStatus status = find_greatest(work, path, &time);
    free(path);
    if (work->figure->before.count) {
        add_moment(list, fmax(0, time - work->figure->before.items[0]));
    }
    add_moment(list, time);
    return status;
}

/* The setting of `orzo draw` that says when; empty of a strobe's picture, which the scene asks for.
 */
static OzStatus say_moments(const OzFigureWork *work, const OzRunFacts *facts, const char *member,
                            char setting[SETTING])
{
    char list[SETTING] = "[";
    const OzNumbers *at = &work->figure->at;
    setting[0] = '\0';
    if (work->figure->at_greatest) {
        OZ_PASS(list_greatest(work, member, list));
    }
    for (int i = 0; i < at->count; i++) {
        if (at->items[i] <= facts->end * (1 + 1e-6)) {
            add_moment(list, at->items[i]);
        }
    }
    if (list[1]) {
        bool taps = facts->in_taps && !work->figure->at_greatest;
        snprintf(setting, SETTING, "snapshots.%s=%s]", taps ? "taps" : "times", list);
    }
    return OZ_OK;
}

/* Its settings, in the order in which `orzo draw` takes them. */
static OzStatus draw(const OzFigureWork *work, const OzSheetRow *row, const char *member,
                     const char *out, char *moments)
{
    OzOptions options = {.command = "draw",
                         .paths = {member},
                         .path_count = 1,
                         .out = out,
                         .gl = work->options->gl,
                         .source_dir = work->options->source_dir};
    const OzStudyFigure *figure = work->figure;
    char size[SETTING], view[SETTING], movie[] = "movie=false";
    options.settings[options.setting_count++] = movie;
    if (moments[0]) {
        options.settings[options.setting_count++] = moments;
    }
    if (figure->size.count) {
        snprintf(size, sizeof size, "snapshots.size=[%.0f, %.0f]", figure->size.items[0],
                 figure->size.items[1]);
        options.settings[options.setting_count++] = size;
    }
    if (row->view) {
        snprintf(view, sizeof view, "snapshots.views=[%s]", row->view);
        options.settings[options.setting_count++] = view;
    }
    for (int i = 0; i < figure->picture.count && i < OZ_CLI_SETTINGS_MAX - 4; i++) {
        options.settings[options.setting_count++] = figure->picture.items[i];
    }
    return oz_redraw_folder(&options);
}

/* Their names have as many digits each, so that they are in order of time. */
static OzStatus list_files(OzSheetRow *row, const char *out)
{
    OzStatus status = OZ_OK;
    glob_t found = {0};
    char *pattern = NULL;
    if (asprintf(&pattern, "%s/snapshots/*.png", out) < 0) {
        return oz_status_fail(OZ_ERR_MEMORY, "out of memory for a path");
    }
    if (glob(pattern, 0, NULL, &found) != 0) {
        status = oz_status_fail(OZ_ERR_FILE, "no picture was drawn into %s", out);
        goto done;
    }
    OZ_TRY(OZ_NEW(&row->files.items, found.gl_pathc));
    for (size_t i = 0; i < found.gl_pathc; i++) {
        OZ_TRY(oz_memory_text(&row->files.items[i], found.gl_pathv[i]));
        row->files.count++;
    }
done:
    globfree(&found);
    free(pattern);
    return status;
}

/* The folder of the run's first member. */
static OzStatus find_member(const OzFigureWork *work, OzSheetRow *row)
{
    OzStatus status = OZ_OK;
    OzCells table = {0};
    char *path = NULL;
    OZ_TRY(oz_study_runs_path(&path, row->run, work->folder, "members.csv"));
    OZ_TRY(oz_cells_read(&table, path));
    OZ_TRY(oz_memory_text(&row->member, oz_cells_text(&table, 0, 0)));
done:
    oz_cells_free(&table);
    free(path);
    return status;
}

OzStatus oz_sheet_pictures_draw(const OzFigureWork *work, OzSheetRow *row)
{
    OzStatus status = OZ_OK;
    OzRunFacts facts;
    char *member = NULL, *out = NULL, moments[SETTING];
    OZ_TRY(oz_study_runs_facts(&facts, row->run, work->folder));
    OZ_TRY(find_member(work, row));
    OZ_TRY(oz_study_runs_path(&member, row->run, work->folder, row->member));
    if (asprintf(&out, "%s/pictures/%s_%s%s%s", work->folder, work->figure->name, row->run->name,
                 row->view ? "_" : "", row->view ? row->view : "") < 0) {
        out = NULL;
        status = oz_status_fail(OZ_ERR_MEMORY, "out of memory for a path");
        goto done;
    }
    OZ_TRY(say_moments(work, &facts, member, moments));
    OZ_TRY(draw(work, row, member, out, moments));
    OZ_TRY(list_files(row, out));
done:
    free(member);
    free(out);
    return status;
}

void oz_sheet_pictures_free(OzSheetRow *row)
{
    for (int i = 0; i < row->files.count; i++) {
        free(row->files.items[i]);
    }
    free(row->files.items);
    free(row->member);
    *row = (OzSheetRow){0};
}

void oz_sheet_pictures_say(const char *file, char *text, size_t size)
{
    const char *slash = strrchr(file, '/'), *name = slash ? slash + 1 : file;
    double at = 0;
    text[0] = '\0';
    if (sscanf(name, "tap_%lf", &at) == 1) {
        snprintf(text, size, "%.4g taps", at);
    } else if (sscanf(name, "time_%lf", &at) == 1) {
        snprintf(text, size, "%.3g s", at);
    }
}
