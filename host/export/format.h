/* Formats that a run's frames are exported to. A format is a row of OZ_EXPORTS (scene/scene.h) and
 * an OzExportFormat of its own, oz_export_<name>_format. */
#pragma once

#include "model/snapshot.h"

/* What is exported, the same for all frames; all borrowed. */
typedef struct OzExport {
    const char *folder; /* open (base/folder.h): where files are made */
    const OzScene *scene;
    const OzGrains *grains;
} OzExport;

/* What a format has written is whole after each add that returned OZ_OK, also where the process
 * ends then. */
typedef struct OzExportFormat {
    const char *name;
    const char *files[4]; /* patterns (fnmatch) of their names, ending with NULL */
    OzStatus (*open)(void **writer, const OzExport *target); /* target outlives the writer */
    OzStatus (*add)(void *writer, const OzSnapshot *snapshot);
    OzStatus (*finish)(void *writer); /* frees, also after a failure; NULL is fine */
} OzExportFormat;

#define OZ_EXPORT_DECLARE(NAME, name, choice) extern const OzExportFormat oz_export_##name##_format;
OZ_EXPORTS(OZ_EXPORT_DECLARE)
#undef OZ_EXPORT_DECLARE
