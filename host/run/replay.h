/* The changes of an earlier run, from its reloads.csv, to be made again at the same steps. The run
 * that makes them keeps copies in its own folder, replay/run.csv or replay/MEMBER.csv, so that it
 * can be gone on with when the earlier one is gone. */
#pragma once

#include "base/status.h"

#include <stdbool.h>
#include <stdint.h>

/* What changed at one step, as settings of oz_scene_change. */
typedef struct OzReplayChange {
    int64_t step;
    char **settings;
    int count;
    char *what;    /* "phase 2, rest", owned; NULL of an earlier run's */
    bool is_quiet; /* nothing is said of it, in the log or in pictures */
} OzReplayChange;

/* Zeroed is none. */
typedef struct OzReplay {
    OzReplayChange *changes;
    int count;
    int64_t end; /* step at which the run was interrupted    */
    bool is_cut; /* it was                                   */
} OzReplay;

/* Of the run in this folder, or of its member of that name ("": a plain run); without a reloads.csv
 * nothing was changed. is_kept: the folder is of the run that repeats it, and has copies. Refuses
 * with OZ_ERR_INPUT, at file and line, what no run has written, and the folder of several members
 * where a plain run is asked for. The caller frees, also on failure.
 */
OzStatus oz_replay_read(OzReplay *replay, const char *folder, const char *member, bool is_kept);

/* Whether the member of that name had begun; a plain run had. */
bool oz_replay_has(const char *folder, const char *member, bool is_kept);

/* Puts a copy for the member, if it had begun, into the folder of the run that repeats it. */
OzStatus oz_replay_keep(const char *folder, const char *member, const char *own);

/* Where the run in a folder is made again: as asked, or (NULL) beside it, in FOLDER_again. The
 * caller frees *out. */
OzStatus oz_replay_choose_folder(char **out, const char *asked, const char *folder);

/* Whether the folder is of a run that repeats another one. */
bool oz_replay_is_kept(const char *own);

/* Whether there is something to do from a step on before which so many changes have been taken. The
 * step at which the earlier run was interrupted is no end to who goes on from there. */
bool oz_replay_go_on(OzReplay *replay, int64_t taken, int64_t step);

/* Whether both make the same changes at the same steps, and end alike. */
bool oz_replay_agrees(const OzReplay *a, const OzReplay *b);

/* The same of a text in memory, which is cut up; path serves for messages. */
OzStatus oz_replay_parse(OzReplay *replay, const char *path, char *text);

void oz_replay_free(OzReplay *replay);
