/* The table's rows, one by one. */
#include "figures/shares.h"

#include "base/cells.h"
#include "base/file.h"
#include "base/folder.h"
#include "base/log.h"
#include "bench/bench.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char mean_word[] = "mean ";

/* folder/times, or the table of parts in it: of a scene `bench` calls it after its file. */
static OzStatus find_times(const OzFigureWork *work, bool table, char **path)
{
    const OzStudyRun *run = oz_figure_work_run(work, work->figure->runs.items[0]);
    const char *slash = strrchr(run->path, '/'), *name = slash ? slash + 1 : run->path;
    int length = (int)strcspn(name, ".");
    int made = table ? asprintf(path, "%s/times/shares_%.*s.csv", work->folder, length, name)
                     : asprintf(path, "%s/times", work->folder);
    if (made < 0) {
        *path = NULL;
        return oz_status_fail(OZ_ERR_MEMORY, "out of memory for a path");
    }
    return OZ_OK;
}

OzStatus oz_shares_measure(const OzFigureWork *work)
{
    OzStatus status = OZ_OK;
    char *folder = NULL, *table = NULL;
    OzOptions options = {.command = "bench",
                         .paths = {oz_figure_work_run(work, work->figure->runs.items[0])->path},
                         .path_count = 1,
                         .quick = work->options->quick,
                         .device = work->options->device,
                         .source_dir = work->options->source_dir};
    OZ_TRY(find_times(work, false, &folder));
    OZ_TRY(find_times(work, true, &table));
    options.out = folder;
    if (!oz_file_exists(table)) {
        oz_log_line("%s: timing the parts of a step", work->figure->name);
        OZ_TRY(oz_bench_run(&options));
    }
done:
    free(folder);
    free(table);
    return status;
}

/* A sum of parts, %; NAN where one of them was not timed. */
static double sum_parts(const OzCells *times, const char *parts)
{
    int percent = oz_cells_find(times, "percent_of_step");
    double sum = 0;
    for (const char *at = parts; *at; at += *at == '+') {
        size_t length = strcspn(at, "+");
        double value = NAN;
        for (int64_t row = 0; row < times->row_count && percent >= 0; row++) {
            const char *name = oz_cells_text(times, row, 0);
            name += strspn(name, " ");
            if (strlen(name) == length && strncmp(name, at, length) == 0) {
                value = oz_cells_number(times, row, percent);
            }
        }
        sum += value;
        at += length;
    }
    return sum;
}

/* The mean over a run's rows, %; NAN where there is none. */
static double mean_share(const OzCells *series, const char *column)
{
    char name[128];
    double sum = 0;
    int64_t count = 0;
    snprintf(name, sizeof name, "%s_mean", column);
    int place = oz_cells_find(series, name);
    for (int64_t row = 0; row < series->row_count && place >= 0; row++) {
        double value = oz_cells_number(series, row, place);
        if (!isnan(value)) {
            sum += value;
            count++;
        }
    }
    return count ? 100 * sum / (double)count : NAN;
}

static void write_row(FILE *file, const char *row, double paper, double ours)
{
    char here[32] = "-";
    if (!isnan(ours)) {
        snprintf(here, sizeof here, "%.2f", ours);
    }
    fprintf(file, "%s,%.4g,%s\n", row, paper, isnan(ours) ? "" : here);
    printf("%-32s %8.4g %8s\n", row, paper, here);
}

static void write_rows(const OzFigureWork *work, const OzCells *times, const OzCells *series,
                       FILE *file)
{
    const OzStudyFigure *figure = work->figure;
    fputs("row,paper_percent,here_percent\n", file);
    printf("%-32s %8s %8s\n", figure->title ? figure->title : figure->name, "paper, %", "here, %");
    for (int i = 0; i < figure->rows.count; i++) {
        const char *part = figure->parts.items[i];
        bool is_mean = strncmp(part, mean_word, strlen(mean_word)) == 0;
        write_row(file, figure->rows.items[i], figure->paper.items[i],
                  is_mean ? mean_share(series, part + strlen(mean_word)) : sum_parts(times, part));
    }
}

OzStatus oz_shares_draw(const OzFigureWork *work)
{
    OzStatus status = OZ_OK;
    OzCells times = {0}, series = {0};
    char *table = NULL, *ensemble = NULL, *name = NULL;
    FILE *file = NULL;
    const OzStudyRun *run = oz_figure_work_run(work, work->figure->runs.items[0]);
    if (asprintf(&name, "%s.csv", work->figure->name) < 0) {
        name = NULL;
        return oz_status_fail(OZ_ERR_MEMORY, "out of memory for a name");
    }
    OZ_TRY(find_times(work, true, &table));
    OZ_TRY(oz_cells_read(&times, table));
    OZ_TRY(oz_study_runs_path(&ensemble, run, work->folder, "ensemble.csv"));
    OZ_TRY(oz_cells_read(&series, ensemble));
    OZ_TRY(oz_folder_create_file(&file, work->folder, name));
    write_rows(work, &times, &series, file);
    oz_log_line("%s/%s", work->folder, name);
done:
    OZ_AFTER(status, file ? oz_folder_finish_file(file, name) : OZ_OK);
    oz_cells_free(&times);
    oz_cells_free(&series);
    free(table);
    free(ensemble);
    free(name);
    return status;
}
