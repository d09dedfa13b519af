/* Walking the list of experiments, and the table. */
#include "report/report_validate.h"

#include "base/clock.h"
#include "base/folder.h"
#include "base/log.h"
#include "base/memory.h"
#include "base/student.h"
#include "report/report_validate_rows.h"

#include <libgen.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char *const verdicts[] = {"agrees", "undecided", "DIFFERS"};

typedef struct Table {
    FILE *csv;
    int count, undecided, differs, unexplained;
} Table;

OzAgreement oz_report_validate_judge(const OzKnown *known, double mean, double interval)
{
    double low = mean - interval, high = mean + interval;
    if (!(low <= known->high && high >= known->low)) {
        return OZ_DIFFERS;
    }
    bool within = low >= known->low && high <= known->high;
    return within || 2 * interval <= known->high - known->low ? OZ_AGREES : OZ_UNDECIDED;
}

/* The list's row of a name, or of a scene's path. */
static OzStatus find_row(const OzValidation **row, const char *path)
{
    OzStatus status = OZ_OK;
    char *copy = NULL;
    OZ_TRY(oz_memory_text(&copy, path));
    char *name = basename(copy), *dot = strrchr(name, '.');
    if (dot) {
        *dot = '\0';
    }
    for (*row = oz_report_validate_rows_all; (*row)->name && strcmp((*row)->name, name) != 0;) {
        ++*row;
    }
    if (!(*row)->name) {
        char names[512] = "";
        size_t used = 0;
        for (const OzValidation *r = oz_report_validate_rows_all; r->name; r++) {
            used += (size_t)snprintf(names + used, sizeof names - used, "%s%s", used ? ", " : "",
                                     r->name);
        }
        status = oz_status_fail(OZ_ERR_INPUT, "orzo report --validate: '%s'; expected one of %s",
                                path, names);
    }
done:
    free(copy);
    return status;
}

static void print_heading(void)
{
    printf("%-50s %-17s %-34s %-18s %s\n", "quantity", "literature", "source", "ours, 95 %",
           "verdict");
}

/* "0.639 ... 0.641" */
static void range_text(const OzKnown *known, char *text, size_t size)
{
    snprintf(text, size, "%.5g ... %.5g", known->low, known->high);
}

static void print_row(Table *table, const OzKnown *known, int seeds, OzMoments m)
{
    char range[40], ours[40], quantity[80];
    OzAgreement agreement = oz_report_validate_judge(known, m.mean, m.interval);
    range_text(known, range, sizeof range);
    snprintf(quantity, sizeof quantity, "%s%s%s", known->quantity, known->unit[0] ? ", " : "",
             known->unit);
    if (m.interval > 0) {
        snprintf(ours, sizeof ours, "%.4g +- %.2g", m.mean, m.interval);
    } else {
        snprintf(ours, sizeof ours, "%.5g", m.mean);
    }
    printf("%-50s %-17s %-34s %-18s %s\n", quantity, range, known->source, ours,
           verdicts[agreement]);
    if (known->remark) {
        printf("    %s\n", known->remark);
    }
    if (agreement == OZ_DIFFERS && known->cause) {
        printf("    cause: %s\n", known->cause);
    }
    fprintf(table->csv, "\"%s\",\"%s\",%.9g,%.9g,\"%s\",%d,%.9g,%.6g,%s\n", known->quantity,
            known->unit, known->low, known->high, known->source, seeds, m.mean, m.interval,
            verdicts[agreement]);
    table->count++;
    table->undecided += agreement == OZ_UNDECIDED;
    table->differs += agreement == OZ_DIFFERS;
    table->unexplained += agreement == OZ_DIFFERS && !known->cause;
}

/* Where nothing depends on the seed one is all; of several seeds one alone says nothing of the
 * spread. */
static OzMoments moments_of(const OzKnown *known, const OzTrialOutcome *outcome, int seeds_meant)
{
    double values[OZ_TRIAL_SEEDS];
    for (int s = 0; s < outcome->seeds; s++) {
        values[s] = known->value((const OzTrialNumbers *)outcome->numbers[s]);
    }
    OzMoments moments = oz_student_moments(values, outcome->seeds);
    moments.interval = seeds_meant > 1 ? moments.interval : 0;
    return moments;
}

static OzStatus make(Table *table, const OzValidation *row, const char *path,
                     const OzOptions *options, const OzDevice *device)
{
    OzStatus status = OZ_OK;
    OzTrialOutcome *outcome = NULL;
    double start = oz_clock_now();
    OZ_TRY(OZ_NEW(&outcome, 1));
    OZ_TRY(oz_report_trial_run(outcome, &row->trial, path, options, device));
    for (int k = 0; k < OZ_VALIDATION_KNOWN && row->known[k].quantity; k++) {
        print_row(table, &row->known[k], outcome->seeds,
                  moments_of(&row->known[k], outcome, row->trial.seeds));
    }
    oz_log_line("%s: %.0f s", row->name, oz_clock_now() - start);
done:
    free(outcome);
    return status;
}

static OzStatus make_all(Table *table, const OzOptions *options, const OzDevice *device)
{
    for (const OzValidation *row = oz_report_validate_rows_all; row->name; row++) {
        const char *path = NULL;
        bool asked = options->path_count == 0;
        for (int p = 0; p < options->path_count; p++) {
            const OzValidation *named = NULL;
            OZ_PASS(find_row(&named, options->paths[p]));
            asked |= named == row;
            path = named == row && strchr(options->paths[p], '.') ? options->paths[p] : path;
        }
        if (asked) {
            OZ_PASS(make(table, row, path, options, device));
        }
    }
    return OZ_OK;
}

OzStatus oz_report_validate_run(const OzOptions *options, const char *folder)
{
    OzStatus status = OZ_OK;
    const OzFolderUse use = {.keep = true};
    OzFolder owned = {0};
    OzDevice device = {0};
    Table table = {0};
    OZ_TRY(oz_device_open(&device, options->device, options->threads));
    OZ_TRY(oz_folder_open(&owned, folder, &use));
    OZ_TRY(oz_folder_create_file(&table.csv, folder, "validation.csv"));
    fprintf(table.csv, "quantity,unit,low,high,source,seeds,mean,ci95,verdict\n");
    print_heading();
    OZ_TRY(make_all(&table, options, &device));
    printf("%d quantities: %d agree, %d are undecided, %d differ\n", table.count,
           table.count - table.undecided - table.differs, table.undecided, table.differs);
    if (table.unexplained > 0) {
        status = oz_status_fail(OZ_ERR_BLOWUP,
                                "%d quantities differ from the literature for a cause unknown",
                                table.unexplained);
    }
done:
    if (table.csv) {
        OzStatus written = oz_folder_finish_file(table.csv, "validation.csv");
        status = status == OZ_OK ? written : status;
    }
    oz_folder_close(&owned);
    oz_device_close(&device);
    return status;
}
