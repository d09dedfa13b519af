/* A run's stored frames (observe/frames.h) in files that other programs read: all of them at once,
 * or frame by frame while the run stores them. */
#pragma once

#include "base/folder.h"
#include "export/format.h"

/* All borrowed. */
typedef struct OzExportJob {
    const char *frames;        /* path of a frames.bin                                    */
    const OzScene *scene;      /* that it was made with                                   */
    const char *folder;        /* where to; open (base/folder.h), with oz_export_use */
    const OzExportKind *kinds; /* formats                                                 */
    int kind_count;
    int purpose;   /* OZ_FRAME_ bits: frames kept for one of these; 0: all but settling's */
    int64_t every; /* of those only each so many-th, from the first on     */
    bool grows;    /* the file does: interrupts are left to who writes it  */
} OzExportJob;

enum { OZ_EXPORT_REPLACES = 4 * OZ_EXPORTS_END + 1 };

/* How an export uses its folder: what it wrote there in these formats goes, other formats stay.
 * replaces receives the patterns, and must live as long as the use. */
OzFolderUse oz_export_use(const OzExportKind *kinds, int count,
                          const char *replaces[OZ_EXPORT_REPLACES]);

typedef struct OzExporter OzExporter;

/* Opens the frames; what the job borrows must outlive the exporter, the job itself need not. Fails
 * as the reader does. */
OzStatus oz_export_open(OzExporter **exporter, const OzExportJob *job);

/* Exports every frame that the file holds by now and that was not before; files are whole after
 * each, one that was begun to the last frame but one. Fails as the reader does, and with
 * OZ_ERR_FILE. Says how far it is after a second, and stops with OZ_ERR_INTERRUPTED when asked to.
 */
OzStatus oz_export_follow(OzExporter *exporter);

/* Closes files and frees; NULL is fine. *count (may be NULL) receives how many frames there are. */
OzStatus oz_export_finish(OzExporter *exporter, int64_t *count);

/* All three for what the file holds. */
OzStatus oz_export_frames(const OzExportJob *job, int64_t *count);
