/* Reads frames and hands them to every format that is wanted. */
#include "export/export.h"

#include "base/interrupt.h"
#include "base/log.h"
#include "base/memory.h"
#include "observe/frame_reader.h"

#include <stdlib.h>

#define FORMAT(NAME, name, choice) [OZ_EXPORT_##NAME] = &oz_export_##name##_format,
static const OzExportFormat *const formats[] = {OZ_EXPORTS(FORMAT)};
#undef FORMAT

static const char *const all_files[] = {
    "grains.xyz",     "grains.h5",    "frames.csv",  "grains_*.csv",
    "contacts_*.csv", "grains_*.vtp", "walls_*.vtp", "contacts_*.vtp",
    "*.pvd",          "*.part",       NULL};

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

struct OzExporter {
    OzExportJob job;
    OzFrames *frames;
    OzGrains grains;
    OzSnapshot snapshot;
    OzExport target;
    void *writers[OZ_EXPORTS_END]; /* opened with the first frame */
    int64_t wanted;                /* frames of the job's purpose so far */
    int64_t count;                 /* of these exported                  */
};

OzStatus oz_export_open(OzExporter **exporter, const OzExportJob *job)
{
    OzStatus status = OZ_OK;
    OzExporter *made = NULL;
    OZ_TRY(OZ_NEW(&made, 1));
    made->job = *job;
    OZ_TRY(oz_frame_reader_open(&made->frames, job->frames, &made->grains));
    OZ_TRY(oz_snapshot_create(&made->snapshot, job->scene, &made->grains));
    made->target = (OzExport){.folder = job->folder, .scene = job->scene, .grains = &made->grains};
done:
    if (status != OZ_OK) {
        oz_export_finish(made, NULL);
        made = NULL;
    }
    *exporter = made;
    return status;
}

/* Those of settling have a time that is not the run's. */
static bool is_wanted(const OzExporter *e, int purpose)
{
    return !(purpose & OZ_FRAME_SETTLING) && (e->job.purpose == 0 || (purpose & e->job.purpose));
}

/* The next frame that the job wants; *more is false at the end. */
static OzStatus read_next(OzExporter *e, bool *more)
{
    int purpose = 0;
    for (;;) {
        if (!e->job.grows && oz_interrupt_asked()) {
            return oz_status_fail(OZ_ERR_INTERRUPTED, "interrupted while exporting");
        }
        OZ_PASS(oz_frame_reader_next(e->frames, &e->snapshot, &purpose, more));
        bool fits = *more && is_wanted(e, purpose);
        if (!*more || (fits && e->wanted++ % e->job.every == 0)) {
            return OZ_OK;
        }
    }
}

static OzStatus add_frame(OzExporter *e)
{
    for (int k = 0; k < e->job.kind_count; k++) {
        const OzExportFormat *format = formats[e->job.kinds[k]];
        if (!e->writers[k]) {
            OZ_PASS(format->open(&e->writers[k], &e->target));
        }
        OZ_PASS(format->add(e->writers[k], &e->snapshot));
    }
    e->count++;
    if (!e->job.grows) {
        oz_log_progress("exporting frame %lld", (long long)e->count);
    }
    return OZ_OK;
}

OzStatus oz_export_follow(OzExporter *exporter)
{
    bool more = true;
    OZ_PASS(oz_frame_reader_renew(exporter->frames));
    while (true) {
        OZ_PASS(read_next(exporter, &more));
        if (!more) {
            return OZ_OK;
        }
        OZ_PASS(add_frame(exporter));
    }
}

OzStatus oz_export_finish(OzExporter *exporter, int64_t *count)
{
    OzStatus status = OZ_OK;
    if (!exporter) {
        return OZ_OK;
    }
    for (int k = 0; k < exporter->job.kind_count; k++) {
        OZ_AFTER(status, formats[exporter->job.kinds[k]]->finish(exporter->writers[k]));
    }
    if (count) {
        *count = exporter->count;
    }
    oz_frames_finish(exporter->frames);
    oz_snapshot_free(&exporter->snapshot);
    oz_grains_free(&exporter->grains);
    free(exporter);
    return status;
}

OzStatus oz_export_frames(const OzExportJob *job, int64_t *count)
{
    OzExporter *exporter = NULL;
    *count = 0;
    OZ_PASS(oz_export_open(&exporter, job));
    OzStatus status = oz_export_follow(exporter);
    oz_log_progress(" ");
    OZ_AFTER(status, oz_export_finish(exporter, count));
    return status;
}
