/* Which members of a run go side by side: those of the next states, where it goes on with some,
 * then groups of those that have not begun and fit together. */
#pragma once

#include "compute/device.h"
#include "observe/schedule.h"
#include "run/members.h"
#include "run/outputs.h"
#include "run/replay.h"
#include "run/resume.h"

/* Zeroed is valid. */
typedef struct OzGroups {
    const OzOptions *options; /* borrowed */
    const OzDevice *device;   /* borrowed; set by who opens it, before the first group */
    OzResume *resume;         /* borrowed: the states to go on from; NULL: a run from the start */
    OzMembers plan;
    OzOutputs **members; /* of the group in hand; whoever ends it frees them */
    int64_t member_count;
    OzSchedule schedule; /* of the group                                        */
    OzOutputs *loaded;   /* the next group's first, NULL at the end             */
    OzReplay replay,
        loaded_replay;    /* changes known from the start: the group's, the next one's */
    OzReplay *begun;      /* what each of the states has of them left; NULL: no such run */
    int64_t loaded_count; /* members of the plan that were loaded or could not be */
    int64_t most;         /* that there is room for at a time; 0: not known yet  */
    OzOutcome *outcomes;  /* of each member of the plan                          */
    OzStatus loss;        /* why the first member that did not end well did not  */
} OzGroups;

/* Reads the plan, and the first member of a run from the start. The caller frees, also on failure.
 */
OzStatus oz_groups_open(OzGroups *groups, const OzOptions *options, OzResume *resume);
void oz_groups_free(OzGroups *groups);

/* Whether a group is left. */
OzStatus oz_groups_find(OzGroups *groups, bool *more);

/* Loads its members. */
OzStatus oz_groups_gather(OzGroups *groups);

/* Whether the group in hand goes on from states, one a worker. */
bool oz_groups_is_begun(const OzGroups *groups);

/* Whether all that changes is known from the start: the run repeats another one, or has phases. */
bool oz_groups_has_changes(const OzGroups *groups);

/* What changes its worker of that number has to make; NULL: none are known. */
const OzReplay *oz_groups_replay(const OzGroups *groups, int worker);

/* Changes that the worker's state has taken of these. */
int64_t oz_groups_taken(const OzGroups *groups, int worker);

/* Puts the changes that are to be made again into the run's folder. */
OzStatus oz_groups_keep_changes(const OzGroups *groups, const char *folder);

/* Workers at a time: one a thread of a CPU; a GPU takes all members at once. */
int64_t oz_groups_most_workers(const OzGroups *groups);

/* members.csv and ensemble.csv of an ensemble into the folder (NULL: none was taken), once a member
 * has been opened. */
OzStatus oz_groups_write_tables(const OzGroups *groups, const char *folder);

/* Fails as the first member that did not reach its end did, saying how many there are; OZ_OK
 * without any. */
OzStatus oz_groups_tell_losses(const OzGroups *groups);
