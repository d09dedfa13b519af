/* From ensemble.csv to the rows of a figure. */
#include "figures/curves_data.h"

#include "base/cells.h"
#include "base/folder.h"
#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_PARTS = 8, NAME = 128 };

/* A column of the figure: where its parts' means and its spread stand in a run's table. */
typedef struct Source {
    int means[MOST_PARTS], count;
    int spread, interval; /* -1: none */
} Source;

typedef struct Writer {
    const OzFigureWork *work;
    const OzTexts *columns;
    OzCells table; /* of the run that is written */
    Source *sources;
    FILE *file;
    bool has_spread;
    bool *has_value; /* of columns, in any row of any run */
} Writer;

static int find(const Writer *writer, const char *part, const char *ending)
{
    char name[NAME + 16];
    snprintf(name, sizeof name, "%s%s", part, ending);
    return oz_cells_find(&writer->table, name);
}

static OzStatus find_source(const Writer *writer, const OzStudyRun *run, const char *column,
                            Source *source)
{
    char part[NAME];
    *source = (Source){.spread = -1, .interval = -1};
    for (const char *at = column; *at; at += *at == '+') {
        size_t length = strcspn(at, "+");
        snprintf(part, sizeof part, "%.*s", (int)length, at);
        int mean = find(writer, part, "_mean");
        if (mean < 0 || source->count == MOST_PARTS) {
            return oz_status_fail(OZ_ERR_INPUT,
                                  "%s/%s/ensemble.csv has no column %s_mean; expected one of its "
                                  "first line for %s",
                                  writer->work->folder, run->name, part, column);
        }
        source->means[source->count++] = mean;
        source->spread = find(writer, part, "_spread");
        source->interval = find(writer, part, "_ci95");
        at += length;
    }
    if (source->count > 1) {
        source->spread = source->interval = -1;
    }
    return OZ_OK;
}

static void write_number(const Writer *writer, double value)
{
    if (isnan(value)) {
        fputc(',', writer->file);
    } else {
        fprintf(writer->file, ",%.9g", value);
    }
}

/* A sum of columns in one row; of several the mean, the last of them being `row`. */
static double mean_of(const Writer *writer, int64_t row, const int *columns, int count)
{
    const OzStudyFigure *figure = writer->work->figure;
    int64_t span = figure->smooth.count ? (int64_t)figure->smooth.items[0] : 1;
    int64_t first = row + 1 > span ? row + 1 - span : 0;
    double sum = 0;
    for (int64_t i = first; i <= row; i++) {
        for (int k = 0; k < count; k++) {
            sum += oz_cells_number(&writer->table, i, columns[k]);
        }
    }
    return sum / (double)(row + 1 - first);
}

/* Column i in one row. */
static void write_value(Writer *writer, int64_t row, int i)
{
    const Source *source = &writer->sources[i];
    double mean = mean_of(writer, row, source->means, source->count);
    writer->has_value[i] |= !isnan(mean);
    write_number(writer, writer->work->figure->absolute ? fabs(mean) : mean);
    const int others[] = {source->spread, source->interval};
    for (int k = 0; k < 2; k++) {
        double value = others[k] < 0 ? NAN : mean_of(writer, row, &others[k], 1);
        writer->has_spread |= value > 0;
        write_number(writer, value);
    }
}

static OzStatus write_rows(Writer *writer, const OzStudyRun *run)
{
    const char *against = writer->work->figure->against;
    int x = oz_cells_find(&writer->table, against), step = oz_cells_find(&writer->table, "step");
    int members = oz_cells_find(&writer->table, "members");
    if (x < 0 || step != 0 || members < 0) {
        return oz_status_fail(OZ_ERR_INPUT,
                              "%s/%s/ensemble.csv is of a sweep; expected a run without one for "
                              "curves",
                              writer->work->folder, run->name);
    }
    if (writer->table.row_count > 0 && isnan(oz_cells_number(&writer->table, 0, x))) {
        return oz_status_fail(OZ_ERR_INPUT, "%s/%s has no %s: no wall moves; expected step or time",
                              writer->work->folder, run->name, against);
    }
    for (int i = 0; i < writer->columns->count; i++) {
        OZ_PASS(find_source(writer, run, writer->columns->items[i], &writer->sources[i]));
    }
    for (int64_t row = 0; row < writer->table.row_count; row++) {
        fprintf(writer->file, "%s,%s,%s,%s", run->name, oz_cells_text(&writer->table, row, step),
                oz_cells_text(&writer->table, row, x), oz_cells_text(&writer->table, row, members));
        for (int i = 0; i < writer->columns->count; i++) {
            write_value(writer, row, i);
        }
        fputc('\n', writer->file);
    }
    return OZ_OK;
}

static OzStatus write_run(Writer *writer, const OzStudyRun *run)
{
    OzStatus status = OZ_OK;
    char *path = NULL;
    OZ_TRY(oz_study_runs_path(&path, run, writer->work->folder, "ensemble.csv"));
    OZ_TRY(oz_cells_read(&writer->table, path));
    OZ_TRY(write_rows(writer, run));
done:
    oz_cells_free(&writer->table);
    free(path);
    return status;
}

static void write_names(const Writer *writer)
{
    fprintf(writer->file, "run,step,%s,members", writer->work->figure->against);
    for (int i = 0; i < writer->columns->count; i++) {
        const char *name = writer->columns->items[i];
        fprintf(writer->file, ",%s,%s_spread,%s_ci95", name, name, name);
    }
    fputc('\n', writer->file);
}

/* A curve without a point anywhere is a mistake; one run may well lack what another has. */
static OzStatus check_values(const Writer *writer)
{
    for (int i = 0; i < writer->columns->count; i++) {
        if (!writer->has_value[i]) {
            return oz_status_fail(OZ_ERR_INPUT,
                                  "column %s is empty in every run; `orzo check` says why",
                                  writer->columns->items[i]);
        }
    }
    return OZ_OK;
}

OzStatus oz_curves_data_write(const OzFigureWork *work, const char *name, const OzTexts *runs,
                              const OzTexts *columns, bool *has_spread)
{
    OzStatus status = OZ_OK;
    Writer writer = {.work = work, .columns = columns};
    OZ_TRY(oz_folder_create_file(&writer.file, work->folder, name));
    OZ_TRY(OZ_NEW(&writer.sources, columns->count));
    OZ_TRY(OZ_NEW(&writer.has_value, columns->count));
    write_names(&writer);
    for (int i = 0; i < runs->count; i++) {
        OZ_TRY(write_run(&writer, oz_figure_work_run(work, runs->items[i])));
    }
    OZ_TRY(check_values(&writer));
    *has_spread = writer.has_spread;
done:
    OZ_AFTER(status, oz_folder_finish_file(writer.file, name));
    free(writer.sources);
    free(writer.has_value);
    return status;
}
