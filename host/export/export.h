/* A run's stored frames (observe/frames.h) in files that other programs read. */
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
    int purpose;   /* OZ_FRAME_ bits: frames kept for one of these; 0: all */
    int64_t every; /* of those only each so many-th, from the first on     */
} OzExportJob;

enum { OZ_EXPORT_REPLACES = 2 * OZ_EXPORTS_END + 1 };

/* How an export uses its folder: what it wrote there in these formats goes, other formats stay.
 * replaces receives the patterns, and must live as long as the use. */
OzFolderUse oz_export_use(const OzExportKind *kinds, int count,
                          const char *replaces[OZ_EXPORT_REPLACES]);

/* Reads the file twice: to count its frames, and to write them. *count receives how many were
 * written. Fails as the reader does, and with OZ_ERR_FILE; files that were begun are closed. Says
 * how far it is after a second, and stops with OZ_ERR_INTERRUPTED when asked to. */
OzStatus oz_export_frames(const OzExportJob *job, int64_t *count);
