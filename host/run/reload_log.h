/* reloads.csv: what was changed in a run, and where it ended, for `--replay` and for people: step,
 * time, key, old and new value (YAML), seconds that kernels took to be built. The last row's key is
 * `end`, and its new value done or interrupted. */
#pragma once

#include "base/state.h"
#include "scene/changes.h"

typedef struct OzReloadLog OzReloadLog;

/* In this folder, which is borrowed; there is no file until something is written, unless one is
 * there to go on with. */
OzStatus oz_reload_log_create(OzReloadLog **log, const char *folder, bool goes_on);

/* The file with its header, if it is not there yet. */
OzStatus oz_reload_log_begin(OzReloadLog *log);

/* Whether there is one. */
bool oz_reload_log_has(const OzReloadLog *log);

/* A row for each change. */
OzStatus oz_reload_log_add(OzReloadLog *log, int64_t step, double time, const OzChanges *changes,
                           double seconds);

/* The last row, in a file that has been begun. */
OzStatus oz_reload_log_end(OzReloadLog *log, int64_t step, double time, const char *how);

/* Saves or loads (base/state.h) how much of the file counts. */
OzStatus oz_reload_log_state(OzReloadLog *log, OzStateVisit *visit);

/* Closes; NULL is fine. */
OzStatus oz_reload_log_free(OzReloadLog *log);
