/* Reads frames and hands them to every format that is wanted. */
#include "export/export.h"

#include "base/interrupt.h"
#include "base/log.h"
#include "observe/frame_reader.h"

#include <string.h>

#define FORMAT(NAME, name, choice) [OZ_EXPORT_##NAME] = &oz_export_##name##_format,
static const OzExportFormat *const formats[] = {OZ_EXPORTS(FORMAT)};
#undef FORMAT

static const char *const all_files[] = {
    "grains.xyz",   "grains.h5",   "frames.csv",     "grains_*.csv", "contacts_*.csv",
    "grains_*.vtp", "walls_*.vtp", "contacts_*.vtp", "*.pvd",        NULL};

OzFolderUse oz_export_use(const OzExportKind *kinds, int count,
                          const char *replaces[OZ_EXPORT_REPLACES])
{
    int used = 0;
    for (int k = 0; k < count; k++) {
        for (const char *const *file = formats[kinds[k]]->files; *file; file++) {
            replaces[used++] = *file;
        }
    }
    replaces[used] = NULL;
    return (OzFolderUse){.writes = all_files, .keep = true, .replaces = replaces};
}

/* A file of frames that is being read. */
typedef struct Reading {
    OzFrames *frames;
    OzGrains grains;
    OzSnapshot snapshot;
    int64_t wanted; /* frames of the job's purpose so far */
} Reading;

static void close_reading(Reading *reading)
{
    oz_frames_finish(reading->frames);
    oz_snapshot_free(&reading->snapshot);
    oz_grains_free(&reading->grains);
}

static OzStatus open_reading(Reading *reading, const OzExportJob *job)
{
    memset(reading, 0, sizeof *reading);
    OZ_PASS(oz_frame_reader_open(&reading->frames, job->frames, &reading->grains));
    return oz_snapshot_create(&reading->snapshot, job->scene, &reading->grains);
}

/* The next frame that the job wants; *more is false at the end. */
static OzStatus read_next(Reading *reading, const OzExportJob *job, bool *more)
{
    int purpose = 0;
    for (;;) {
        if (oz_interrupt_asked()) {
            return oz_status_fail(OZ_ERR_INTERRUPTED, "interrupted while exporting");
        }
        OZ_PASS(oz_frame_reader_next(reading->frames, &reading->snapshot, &purpose, more));
        bool fits = *more && (job->purpose == 0 || (purpose & job->purpose));
        if (!*more || (fits && reading->wanted++ % job->every == 0)) {
            return OZ_OK;
        }
    }
}

static OzStatus count_frames(const OzExportJob *job, int64_t *count)
{
    OzStatus status = OZ_OK;
    Reading reading;
    bool more = true;
    *count = 0;
    OZ_TRY(open_reading(&reading, job));
    while (more) {
        OZ_TRY(read_next(&reading, job, &more));
        *count += more;
    }
done:
    close_reading(&reading);
    return status;
}

static OzStatus add_frames(const OzExportJob *job, Reading *reading, void **writers, int64_t total,
                           int64_t *count)
{
    bool more = true;
    for (;;) {
        OZ_PASS(read_next(reading, job, &more));
        if (!more || *count == total) { /* the file may have grown meanwhile */
            return OZ_OK;
        }
        for (int k = 0; k < job->kind_count; k++) {
            OZ_PASS(formats[job->kinds[k]]->add(writers[k], &reading->snapshot));
        }
        oz_log_progress("exporting frame %lld of %lld", (long long)++*count, (long long)total);
    }
}

OzStatus oz_export_frames(const OzExportJob *job, int64_t *count)
{
    OzStatus status = OZ_OK;
    void *writers[OZ_EXPORTS_END] = {NULL};
    Reading reading = {0};
    int64_t total = 0;
    *count = 0;
    OZ_TRY(count_frames(job, &total));
    OZ_TRY(open_reading(&reading, job));
    OzExport target = {.folder = job->folder,
                       .scene = job->scene,
                       .grains = &reading.grains,
                       .frame_count = total};
    for (int k = 0; total > 0 && k < job->kind_count; k++) {
        OZ_TRY(formats[job->kinds[k]]->open(&writers[k], &target));
    }
    OZ_TRY(add_frames(job, &reading, writers, total, count));
    oz_log_progress(" ");
done:
    for (int k = 0; k < job->kind_count; k++) {
        OZ_AFTER(status, formats[job->kinds[k]]->finish(writers[k]));
    }
    close_reading(&reading);
    return status;
}
