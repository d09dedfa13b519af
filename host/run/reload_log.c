/* Rows of reloads.csv. */
#include "run/reload_log.h"

#include "base/file.h"
#include "base/folder.h"
#include "base/memory.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct OzReloadLog {
    const char *folder;
    char *path;
    FILE *file;
    int64_t whole; /* bytes of whole rows */
};

static OzStatus open_file(OzReloadLog *log, const char *mode)
{
    log->file = fopen(log->path, mode);
    return log->file
               ? OZ_OK
               : oz_status_fail(OZ_ERR_FILE, "cannot write %s: %s", log->path, strerror(errno));
}

OzStatus oz_reload_log_create(OzReloadLog **log, const char *folder, bool goes_on)
{
    OzStatus status = OZ_OK;
    OZ_TRY(OZ_NEW(log, 1));
    (*log)->folder = folder;
    OZ_TRY(oz_file_join(&(*log)->path, folder, "reloads.csv"));
    if (goes_on && oz_file_exists((*log)->path)) {
        OZ_TRY(open_file(*log, "r+"));
    }
done:
    if (status != OZ_OK) {
        oz_reload_log_free(*log);
        *log = NULL;
    }
    return status;
}

OzStatus oz_reload_log_begin(OzReloadLog *log)
{
    if (log->file) {
        return OZ_OK;
    }
    OZ_PASS(oz_folder_note(log->folder, "reloads.csv"));
    OZ_PASS(open_file(log, "w"));
    fputs("step,time,key,old,new,rebuild_seconds\n", log->file);
    return oz_file_commit(log->file, &log->whole, log->path);
}

bool oz_reload_log_has(const OzReloadLog *log)
{
    return log->file != NULL;
}

/* As RFC 4180 has it. */
static void print_cell(FILE *file, const char *text)
{
    if (!strpbrk(text, ",\"\n")) {
        fputs(text, file);
        return;
    }
    fputc('"', file);
    for (; *text; text++) {
        fputs(*text == '"' ? "\"" : "", file);
        fputc(*text, file);
    }
    fputc('"', file);
}

static void print_row(FILE *file, int64_t step, double time, const OzChange *change)
{
    fprintf(file, "%lld,%.9g,%s,", (long long)step, time, change->path);
    print_cell(file, change->old);
    fputc(',', file);
    print_cell(file, change->now);
}

OzStatus oz_reload_log_add(OzReloadLog *log, int64_t step, double time, const OzChanges *changes,
                           double seconds)
{
    OZ_PASS(oz_reload_log_begin(log));
    for (int i = 0; i < changes->count; i++) {
        print_row(log->file, step, time, &changes->rows[i]);
        fprintf(log->file, ",%.3f\n", seconds);
    }
    return oz_file_commit(log->file, &log->whole, log->path);
}

OzStatus oz_reload_log_end(OzReloadLog *log, int64_t step, double time, const char *how)
{
    OzChange end = {.path = (char *)"end", .old = (char *)"", .now = (char *)(size_t)how};
    if (!log->file) {
        return OZ_OK;
    }
    print_row(log->file, step, time, &end);
    fputs(",0.000\n", log->file);
    return oz_file_commit(log->file, &log->whole, log->path);
}

OzStatus oz_reload_log_state(OzReloadLog *log, OzStateVisit *visit)
{
    OzStatus status = OZ_OK;
    OZ_TRY(oz_state_enter(visit, "reloads", 1));
    OZ_TRY(oz_state_index(visit, "file_bytes", &log->whole, 0, INT64_MAX));
    oz_state_leave(visit);
    if (visit->is_loading && log->whole > 0 && !log->file) {
        status = oz_status_fail(OZ_ERR_FILE, "%s is not there any more", log->path);
        goto done;
    }
    if (visit->is_loading && log->whole > 0) {
        status = oz_file_go_on(log->file, log->whole, log->path);
    } else if (visit->is_loading && log->file) { /* it was begun after the state */
        fclose(log->file);
        log->file = NULL;
    }
done:
    return status;
}

OzStatus oz_reload_log_free(OzReloadLog *log)
{
    OzStatus status = OZ_OK;
    if (!log) {
        return OZ_OK;
    }
    if (log->file && fclose(log->file) != 0) {
        status = oz_status_fail(OZ_ERR_FILE, "cannot write %s: %s", log->path, strerror(errno));
    }
    free(log->path);
    free(log);
    return status;
}
