/* JSON is YAML: what scenes are read by reads it. */
#include "bench/bench_json.h"

#include "base/file.h"
#include "base/folder.h"
#include "base/memory.h"
#include "scene/document.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char *const names[] = {
#define NAME(id, name, heading, width, decimals, meaning) name,
    OZ_BENCH_COLUMNS(NAME)
#undef NAME
};

static void write_text(FILE *file, const char *text)
{
    fputc('"', file);
    for (; *text; text++) {
        bool escaped = *text == '"' || *text == '\\';
        fprintf(file, "%s%c", escaped ? "\\" : "", (unsigned char)*text < ' ' ? ' ' : *text);
    }
    fputc('"', file);
}

static void write_number(FILE *file, const char *name, double value)
{
    fprintf(file, ", \"%s\": ", name);
    if (isfinite(value)) {
        fprintf(file, "%.9g", value);
    } else {
        fputs("null", file);
    }
}

static void write_record(const OzBenchRecord *record, FILE *file)
{
    fputs("{\"version\": ", file);
    write_text(file, record->version);
    fputs(", \"device\": ", file);
    write_text(file, record->device);
    write_number(file, "start_cold_s", record->start_cold);
    write_number(file, "start_warm_s", record->start_warm);
    fputs(", \"rows\": [", file);
    for (int r = 0; r < record->row_count; r++) {
        fputs(r ? ",\n  {\"bed\": " : "\n  {\"bed\": ", file);
        write_text(file, record->rows[r].bed);
        for (int c = 0; c < OZ_BENCH_COLUMN_COUNT; c++) {
            write_number(file, names[c], record->rows[r].value[c]);
        }
        fputc('}', file);
    }
    fputs("\n]}\n", file);
}

/* NAN where there is no number. */
static double number_of(const OzNode *map, const char *name)
{
    const OzNode *node = oz_tree_child(map, name);
    char *end = NULL;
    double number = node && node->text ? strtod(node->text, &end) : NAN;
    return end && end != node->text && *end == '\0' ? number : NAN;
}

static OzStatus take_text(char **text, const OzNode *map, const char *name)
{
    const OzNode *node = oz_tree_child(map, name);
    return oz_memory_text(text, node && node->text ? node->text : "");
}

static OzStatus take_rows(OzBenchRecord *record, const OzNode *rows)
{
    OZ_PASS(OZ_NEW(&record->rows, rows->count));
    for (; record->row_count < rows->count; record->row_count++) {
        const OzNode *row = rows->items[record->row_count], *bed = oz_tree_child(row, "bed");
        OzBenchRow *taken = &record->rows[record->row_count];
        *taken = oz_bench_row_empty(bed && bed->text ? bed->text : "");
        for (int c = 0; c < OZ_BENCH_COLUMN_COUNT; c++) {
            taken->value[c] = number_of(row, names[c]);
        }
    }
    return OZ_OK;
}

OzStatus oz_bench_json_read(OzBenchRecord *record, const char *path)
{
    OzStatus status = OZ_OK;
    OzSource source = {.name = path};
    OzFaults faults = {0};
    OzNode *root = NULL;
    char *text = NULL;
    size_t length = 0;
    *record = (OzBenchRecord){0};
    OZ_TRY(oz_file_read(&text, &length, path));
    status = oz_document_parse(&root, text, length, &source, &faults);
    const OzNode *rows = root ? oz_tree_child(root, "rows") : NULL;
    if (faults.count == 0 && (!rows || rows->kind != OZ_NODE_LIST)) {
        oz_faults_add(&faults, &source, 1, "no rows; expected a bench.json");
    }
    OZ_TRY(oz_faults_report(&faults));
    OZ_TRY(take_text(&record->version, root, "version"));
    OZ_TRY(take_text(&record->device, root, "device"));
    record->start_cold = number_of(root, "start_cold_s");
    record->start_warm = number_of(root, "start_warm_s");
    OZ_TRY(take_rows(record, rows));
done:
    oz_tree_free(root);
    oz_faults_free(&faults);
    free(text);
    return status;
}

static bool is_same(const OzBenchRow *a, const OzBenchRow *b)
{
    static const int keys[] = {OZ_BENCH_GRAINS, OZ_BENCH_MEMBERS, OZ_BENCH_BITS, OZ_BENCH_THREADS};
    for (size_t k = 0; k < sizeof keys / sizeof *keys; k++) {
        double x = a->value[keys[k]], y = b->value[keys[k]];
        if (x != y && !(isnan(x) && isnan(y))) {
            return false;
        }
    }
    return strcmp(a->bed, b->bed) == 0;
}

/* A figure before, now, and the one over the other. */
static void write_pair(FILE *text, double before, double now)
{
    fprintf(text, "%12.4g %12.4g %7.3f", before, now, now / before);
}

static void compare_row(const OzBenchRow *before, const OzBenchRow *now, FILE *text)
{
    char name[96], told[128];
    oz_bench_row_describe(now, name, sizeof name);
    snprintf(told, sizeof told, "%s, %.0f grains", name, now->value[OZ_BENCH_GRAINS]);
    fprintf(text, "%-44s", told);
    write_pair(text, before->value[OZ_BENCH_US_STEP], now->value[OZ_BENCH_US_STEP]);
    write_pair(text, before->value[OZ_BENCH_US_CPU], now->value[OZ_BENCH_US_CPU]);
    fputc('\n', text);
}

static void compare(const OzBenchRecord *before, const OzBenchRecord *now, FILE *text)
{
    fprintf(text, "before: orzo %s on %s\nnow:    orzo %s on %s\n", before->version, before->device,
            now->version, now->device);
    fprintf(text, "%-44s%12s %12s %7s%12s %12s %7s\n", "us a step", "wall before", "now", "ratio",
            "cpu before", "now", "ratio");
    for (int n = 0; n < now->row_count; n++) {
        for (int b = 0; b < before->row_count; b++) {
            if (is_same(&before->rows[b], &now->rows[n])) {
                compare_row(&before->rows[b], &now->rows[n], text);
                break;
            }
        }
    }
    fprintf(text, "%-44s", "first step, kernels built, s");
    write_pair(text, before->start_cold, now->start_cold);
    fprintf(text, "\n%-44s", "first step, kernels kept, s");
    write_pair(text, before->start_warm, now->start_warm);
    fputc('\n', text);
}

OzStatus oz_bench_json_leave(const OzBenchRecord *record, const OzBenchRecord *before,
                             const char *folder, FILE *text)
{
    FILE *file = NULL;
    OZ_PASS(oz_folder_create_file(&file, folder, "bench.json"));
    write_record(record, file);
    if (fclose(file) != 0) {
        return oz_status_fail(OZ_ERR_FILE, "cannot write %s/bench.json", folder);
    }
    if (before->version) {
        compare(before, record, text);
    }
    return OZ_OK;
}

void oz_bench_json_free(OzBenchRecord *record)
{
    free(record->device);
    free(record->version);
    free(record->rows);
    *record = (OzBenchRecord){0};
}
