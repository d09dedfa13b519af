/* CSV by frame: a table of grains each, a table of contacts where they were kept, and one of all
 * frames' times. */
#include "base/folder.h"
#include "base/memory.h"
#include "export/format.h"
#include "export/grain_columns.h"
#include "export/part_file.h"
#include "observe/contact_rows.h"

#include <stdlib.h>

static const char PART[] = "csv.part";

typedef struct Writer {
    const OzExport *target;
    int64_t number; /* of the next frame */
    FILE *times;
} Writer;

static OzStatus finish_csv(void *data)
{
    Writer *writer = (Writer *)data;
    OzStatus status = writer ? oz_folder_finish_file(writer->times, "frames.csv") : OZ_OK;
    free(writer);
    return status;
}

static OzStatus open_csv(void **data, const OzExport *target)
{
    Writer *writer = NULL;
    OZ_PASS(OZ_NEW(&writer, 1));
    *data = writer;
    writer->target = target;
    OZ_PASS(oz_folder_create_file(&writer->times, target->folder, "frames.csv"));
    fputs("frame,step,time\n", writer->times);
    return OZ_OK;
}

static void write_head(FILE *file, const OzSnapshot *now)
{
    const char *comma = "";
    for (const OzGrainColumn *c = oz_grain_columns_all(); c->name; c++) {
        for (int k = 0; oz_grain_columns_serves(c, now) && k < c->width; k++) {
            fprintf(file, "%s%s", comma, c->parts[k]);
            comma = ",";
        }
    }
    fputc('\n', file);
}

static void write_grain(FILE *file, const OzSnapshot *now, int64_t grain)
{
    const char *comma = "";
    double values[OZ_GRAIN_COLUMN_WIDTH];
    for (const OzGrainColumn *c = oz_grain_columns_all(); c->name; c++) {
        if (oz_grain_columns_serves(c, now)) {
            c->fill(now, grain, values);
            for (int k = 0; k < c->width; k++) {
                fprintf(file, "%s%.9g", comma, values[k] + 0.0); /* 9 digits restore a float */
                comma = ",";
            }
        }
    }
    fputc('\n', file);
}

static OzStatus add_grains(const Writer *writer, const OzSnapshot *now)
{
    char name[64];
    FILE *file = NULL;
    snprintf(name, sizeof name, "grains_%05lld.csv", (long long)writer->number);
    OZ_PASS(oz_part_file_create(&file, writer->target->folder, PART));
    write_head(file, now);
    for (int64_t i = 0; i < now->count; i++) {
        write_grain(file, now, i);
    }
    return oz_part_file_place(file, writer->target->folder, PART, name);
}

static OzStatus add_contacts(const Writer *writer, const OzSnapshot *now)
{
    char name[64];
    FILE *file = NULL;
    snprintf(name, sizeof name, "contacts_%05lld.csv", (long long)writer->number);
    OZ_PASS(oz_part_file_create(&file, writer->target->folder, PART));
    fputs(OZ_CONTACT_ROWS_HEADER "\n", file);
    oz_contact_rows_print(file, now);
    return oz_part_file_place(file, writer->target->folder, PART, name);
}

static OzStatus add_csv(void *data, const OzSnapshot *now)
{
    Writer *writer = (Writer *)data;
    OZ_PASS(add_grains(writer, now));
    if (now->has_contacts) {
        OZ_PASS(add_contacts(writer, now));
    }
    fprintf(writer->times, "%lld,%lld,%.9g\n", (long long)writer->number, (long long)now->step,
            now->time);
    writer->number++;
    fflush(writer->times); /* what failed shows at its end */
    return OZ_OK;
}

const OzExportFormat oz_export_csv_format = {"csv", {"*.csv", PART}, open_csv, add_csv, finish_csv};
