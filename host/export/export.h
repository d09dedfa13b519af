/* A run's stored frames (observe/frames.h) in files that other programs read. */
#pragma once

#include "export/format.h"

/* All borrowed. */
typedef struct OzExportJob {
    const char *frames;        /* path of a frames.bin                                    */
    const OzScene *scene;      /* that it was made with                                   */
    const char *folder;        /* where to; open (base/folder.h), with oz_export_patterns */
    const OzExportKind *kinds; /* formats                                                 */
    int kind_count;
    int purpose;   /* OZ_FRAME_ bits: frames kept for one of these; 0: all */
    int64_t every; /* of those only each so many-th, from the first on     */
} OzExportJob;

/* Names of what formats write, for OzFolderUse; ends with NULL. */
extern const char *const oz_export_patterns[];

/* Reads the file twice: to count its frames, and to write them. *count receives how many were
 * written. Fails as the reader does, and with OZ_ERR_FILE; files that were begun are closed. Says
 * how far it is after a second, and stops with OZ_ERR_INTERRUPTED when asked to. */
OzStatus oz_export_frames(const OzExportJob *job, int64_t *count);
