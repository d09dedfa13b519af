/* Going on with a run: its states are read, and the command that it was is made again of them. */
#pragma once

#include "run/checkpoint.h"
#include "run/reload.h"

/* The newest whole state of each worker of a run, in the order of their members. Zeroed is valid.
 */
typedef struct OzResume {
    OzState *states;
    OzCheckpointHead *heads;
    int count;
    int next;          /* the one that has not been gone on with yet */
    OzOptions options; /* of the run                      */
    char **settings;   /* that its options point to; owned */
    int setting_count;
    char *scene_path;                   /* the folder's scene.yaml; owned  */
    char *changes[OZ_CLI_SETTINGS_MAX]; /* settings from where it goes on; borrowed */
    int change_count;
    char *from; /* what members that have not begun begin with, or NULL; owned */
} OzResume;

/* Reads the states in a run's folder. A damaged one is said, and the one before it taken. Fails
 * with OZ_ERR_INPUT when there is none, or none that is whole. asked: `orzo resume` as written.
 * What it sets of the end and of states belongs to the run; other settings change it where it goes
 * on (run/reload.h). The caller frees, also on failure. */
OzStatus oz_resume_open(OzResume *resume, const OzOptions *asked);
void oz_resume_free(OzResume *resume);

/* Asks for the changes, once, of the members that go on; those that begin later catch up. NULL is
 * fine. */
OzStatus oz_resume_change(OzResume *resume, OzReload *reload);

/* Says in the log how to go on with the run in the folder, which ended so: from the last state, of
 * which step and time are said, or, without one, by running it again. */
void oz_resume_say(const char *folder, OzStatus ended);

/* Takes the seeds of the run in a folder, where its states tell any and options has none. */
OzStatus oz_resume_take_seeds(OzOptions *options, const char *folder);
