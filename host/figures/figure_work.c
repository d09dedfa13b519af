/* What all kinds of figures have in common. */
#include "figures/figure_work.h"

#include "base/folder.h"
#include "base/gnuplot.h"
#include "base/log.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

const OzStudyRun *oz_figure_work_run(const OzFigureWork *work, const char *name)
{
    return &work->study->runs[oz_study_find_run(work->study, name)];
}

static bool are_same(const OzRunFacts *a, const OzRunFacts *b)
{
    return a->members == b->members && a->seed_first == b->seed_first &&
           a->seed_last == b->seed_last && a->step_least == b->step_least &&
           a->step_most == b->step_most && a->stopped == b->stopped;
}

static size_t say_facts(const OzRunFacts *facts, char *text, size_t size)
{
    char steps[64], seeds[64], stopped[64] = "";
    snprintf(seeds, sizeof seeds, "seed %" PRId64, facts->seed_first);
    if (facts->seed_last > facts->seed_first) {
        snprintf(seeds, sizeof seeds, "seeds %" PRId64 " to %" PRId64, facts->seed_first,
                 facts->seed_last);
    }
    snprintf(steps, sizeof steps, "%" PRId64, facts->step_most);
    if (facts->step_least < facts->step_most) {
        snprintf(steps, sizeof steps, "%" PRId64 " to %" PRId64, facts->step_least,
                 facts->step_most);
    }
    if (facts->stopped) {
        snprintf(stopped, sizeof stopped, ", %" PRId64 " stopped by a guard", facts->stopped);
    }
    int used = snprintf(text, size, "%s, %s steps%s", seeds, steps, stopped);
    return used > 0 && (size_t)used < size ? (size_t)used : size - 1;
}

/* Runs that follow each other and are alike are said once. */
OzStatus oz_figure_work_caption(const OzFigureWork *work, char caption[OZ_FIGURE_CAPTION])
{
    const OzTexts *names = &work->figure->runs;
    OzRunFacts facts = {0}, next = {0};
    size_t used = 0, size = OZ_FIGURE_CAPTION;
    caption[0] = '\0';
    for (int i = 0; i < names->count && used + 1 < size; i++) {
        int first = i;
        OZ_PASS(
            oz_study_runs_facts(&facts, oz_figure_work_run(work, names->items[i]), work->folder));
        while (i + 1 < names->count) {
            OZ_PASS(oz_study_runs_facts(&next, oz_figure_work_run(work, names->items[i + 1]),
                                        work->folder));
            if (!are_same(&facts, &next)) {
                break;
            }
            i++;
        }
        int head = snprintf(caption + used, size - used, "%s%s%s%s: ", used ? "; " : "",
                            names->items[first], i > first ? " to " : "",
                            i > first ? names->items[i] : "");
        used = head > 0 && used + (size_t)head < size ? used + (size_t)head : size - 1;
        used += say_facts(&facts, caption + used, size - used);
    }
    return OZ_OK;
}

void oz_figure_work_text(FILE *gnuplot, const char *text)
{
    fputc('\'', gnuplot);
    for (; *text; text++) {
        bool is_control = (unsigned char)*text < ' '; /* a new line would end its command */
        fputs(*text == '\'' ? "''" : (char[2]){is_control ? ' ' : *text}, gnuplot);
    }
    fputc('\'', gnuplot);
}

static OzStatus find_path(const OzFigureWork *work, const char *ending, char **name, char **path)
{
    *path = NULL;
    if (asprintf(name, "%s.%s", work->figure->name, ending) < 0) {
        *name = NULL;
    } else if (asprintf(path, "%s/%s", work->folder, *name) < 0) {
        *path = NULL;
    }
    return *path ? OZ_OK : oz_status_fail(OZ_ERR_MEMORY, "out of memory for a path");
}

/* Sizes of PDF are inches: at a hundred pixels each its text looks as that of the others. */
static void send_terminal(FILE *gnuplot, const char *ending, int width, int height)
{
    if (strcmp(ending, "pdf") == 0) {
        fprintf(gnuplot, "set terminal pdfcairo size %g,%g noenhanced font 'DejaVu Sans,8'\n",
                width / 100.0, height / 100.0);
    } else {
        fprintf(gnuplot, "set terminal %s size %d,%d noenhanced font 'DejaVu Sans,11'\n",
                strcmp(ending, "png") == 0 ? "pngcairo" : ending, width, height);
    }
}

OzStatus oz_figure_work_open(const OzFigureWork *work, const char *ending, int width, int height,
                             FILE **gnuplot)
{
    OzStatus status = OZ_OK;
    char *name = NULL, *path = NULL;
    *gnuplot = NULL;
    OZ_TRY(find_path(work, ending, &name, &path));
    OZ_TRY(oz_folder_note(work->folder, name));
    OZ_TRY(oz_gnuplot_open(gnuplot, work->folder, name));
    if (*gnuplot) {
        send_terminal(*gnuplot, ending, width, height);
        fputs("set output ", *gnuplot);
        oz_figure_work_text(*gnuplot, path);
        fputs("\nset datafile separator ','\n", *gnuplot);
    }
done:
    free(name);
    free(path);
    return status;
}

OzStatus oz_figure_work_close(const OzFigureWork *work, const char *ending, FILE *gnuplot)
{
    char *name = NULL, *path = NULL;
    OzStatus status = find_path(work, ending, &name, &path);
    OZ_AFTER(status, oz_gnuplot_close(gnuplot, work->folder, name ? name : ending));
    if (gnuplot && status == OZ_OK) {
        oz_log_line("%s", path);
    }
    free(name);
    free(path);
    return status;
}

void oz_figure_work_range(FILE *gnuplot, const char *axis, const OzNumbers *range)
{
    if (range->count == 2) {
        fprintf(gnuplot, "set %srange [%.9g:%.9g]\n", axis, range->items[0], range->items[1]);
    }
}

void oz_figure_work_key(FILE *gnuplot, const char *place)
{
    const char *words = place ? place : "top-left";
    size_t first = strcspn(words, "-");
    fprintf(gnuplot, "set key %.*s %s samplen 2\n", (int)first, words, words + first + 1);
}

void oz_figure_work_send_caption(const OzFigureWork *work, FILE *gnuplot, const char *more)
{
    char text[OZ_FIGURE_CAPTION + 128];
    snprintf(text, sizeof text, "%s%s", work->caption, more);
    fputs("set label 999 ", gnuplot);
    oz_figure_work_text(gnuplot, text);
    fputs(" at screen 0.5,0.015 center font ',8' tc rgb '#555555'\n", gnuplot);
}
