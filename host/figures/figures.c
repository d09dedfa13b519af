/* One figure after the other: its runs first, then the picture. */
#include "figures/figures.h"

#include "base/file.h"
#include "base/folder.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "figures/curves.h"
#include "figures/figure_kinds.h"
#include "figures/figure_work.h"
#include "figures/shares.h"
#include "figures/sheet.h"
#include "figures/study_read.h"
#include "figures/swept.h"

#include <stdlib.h>
#include <string.h>

static const struct {
    const char *name;
    OzStatus (*measure)(const OzFigureWork *work); /* NULL: nothing to */
    OzStatus (*draw)(const OzFigureWork *work);
} kinds[] = {
#define KIND_ROW(name, measure, draw) {#name, measure, draw},
    OZ_FIGURE_KINDS(KIND_ROW)
#undef KIND_ROW
};

static OzStatus choose_folder(char **folder, const OzStudy *study, const OzOptions *options)
{
    if (options->out) {
        return oz_file_join(folder, NULL, options->out);
    }
    if (asprintf(folder, "runs/%s%s", study->name, options->quick ? "_quick" : "") < 0) {
        *folder = NULL;
        return oz_status_fail(OZ_ERR_MEMORY, "out of memory for a folder's name");
    }
    return OZ_OK;
}

static OzStatus check_only(const OzStudy *study, const char *only)
{
    char names[1024] = "";
    size_t used = 0;
    if (!only || oz_study_find_figure(study, only) >= 0) {
        return OZ_OK;
    }
    for (int i = 0; i < study->figure_count && used < sizeof names; i++) {
        used += (size_t)snprintf(names + used, sizeof names - used, "%s%s", used ? ", " : "",
                                 study->figures[i].name);
    }
    return oz_status_fail(OZ_ERR_INPUT, "--only %s: %s has no such figure; expected one of %s",
                          only, study->path, names);
}

/* All runs of one list of names. */
static OzStatus make_runs(const OzFigureWork *work, const OzTexts *names)
{
    for (int i = 0; i < names->count; i++) {
        if (oz_interrupt_asked()) {
            return oz_status_fail(OZ_ERR_INTERRUPTED, "interrupted before %s", names->items[i]);
        }
        OZ_PASS(oz_study_runs_make(work->study, oz_figure_work_run(work, names->items[i]),
                                   work->folder, work->options));
    }
    return OZ_OK;
}

static size_t kind_of(const OzStudyFigure *figure)
{
    size_t k = 0;
    while (strcmp(kinds[k].name, figure->kind) != 0) {
        k++; /* the study's reader knows no others */
    }
    return k;
}

static OzStatus measure_figure(OzFigureWork *work)
{
    size_t k = kind_of(work->figure);
    return kinds[k].measure ? kinds[k].measure(work) : OZ_OK;
}

static OzStatus draw_figure(OzFigureWork *work)
{
    char caption[OZ_FIGURE_CAPTION];
    OZ_PASS(make_runs(work, &work->figure->runs));
    OZ_PASS(make_runs(work, &work->figure->inset_run));
    OZ_PASS(oz_figure_work_caption(work, caption));
    work->caption = caption;
    oz_log_line("%s: %s", work->figure->name, caption);
    return kinds[kind_of(work->figure)].draw(work);
}

static void say_how_to_go_on(const OzStudy *study, const char *folder, const OzOptions *options)
{
    oz_log_line("to go on: orzo figures %s -o %s%s%s%s", study->path, folder,
                options->quick ? " --quick" : "", options->only ? " --only " : "",
                options->only ? options->only : "");
}

/* Does one thing for each figure asked for. The first failure is the command's; every one is said.
 */
static OzStatus do_all(const OzStudy *study, const char *folder, const OzOptions *options,
                       OzStatus (*work_on)(OzFigureWork *work))
{
    OzStatus first = OZ_OK;
    for (int i = 0; i < study->figure_count && first != OZ_ERR_INTERRUPTED; i++) {
        const OzStudyFigure *figure = &study->figures[i];
        if (options->only && strcmp(options->only, figure->name) != 0) {
            continue;
        }
        OzFigureWork work = {
            .study = study, .figure = figure, .folder = folder, .options = options};
        OzStatus status = work_on(&work);
        if (status != OZ_OK && status != OZ_ERR_INTERRUPTED) {
            oz_log_line("%s: %s", figure->name, oz_status_text());
        }
        first = first == OZ_OK || status == OZ_ERR_INTERRUPTED ? status : first;
    }
    return first;
}

/* What is timed comes first: runs leave a device open, and timing wants a process without. */
static OzStatus draw_all(const OzStudy *study, const char *folder, const OzOptions *options)
{
    OzStatus measured = do_all(study, folder, options, measure_figure), drawn = measured;
    if (measured != OZ_ERR_INTERRUPTED) {
        drawn = do_all(study, folder, options, draw_figure);
    }
    if (drawn == OZ_ERR_INTERRUPTED) {
        say_how_to_go_on(study, folder, options);
    }
    return measured == OZ_OK || drawn == OZ_ERR_INTERRUPTED ? drawn : measured;
}

static OzStatus load(OzStudy *study, char **folder, OzFolder *owned, const OzOptions *options)
{
    OzFolderUse use = {.keep = true};
    OZ_PASS(oz_study_read_file(study, options->paths[0]));
    OZ_PASS(check_only(study, options->only));
    OZ_PASS(oz_study_runs_check(study, options));
    OZ_PASS(choose_folder(folder, study, options));
    return oz_folder_open(owned, *folder, &use);
}

OzStatus oz_figures_run(const OzOptions *options)
{
    OzStudy study = {0};
    OzFolder owned = {0};
    char *folder = NULL;
    OzStatus status = load(&study, &folder, &owned, options);
    if (status == OZ_OK) {
        status = draw_all(&study, folder, options);
    } else {
        oz_log_line("%s", oz_status_text());
    }
    oz_folder_close(&owned);
    oz_study_read_free(&study);
    free(folder);
    return status;
}
