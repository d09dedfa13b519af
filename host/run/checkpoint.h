/* Where the states of a run go: files of its folder, each with what `orzo resume` must know of the
 * command besides. A plain run has state.h5, each worker of an ensemble state_NNNNN.h5 after its
 * first member; the one before stays as .previous. States to be kept go to checkpoints/. It sees
 * states (base/state.h) and no simulation. */
#pragma once

#include "base/state.h"
#include "cli.h"
#include "scene/changes.h"
#include "scene/scene.h"

/* What a state's file says of its run. Texts are owned; zeroed is valid. */
typedef struct OzCheckpointHead {
    char *version;        /* of the program                                           */
    char *device;         /* name of the OpenCL device                                */
    char *device_asked;   /* --device as written; "": not given                      */
    char *name;           /* the scene's                                              */
    char *origin;         /* of an ensemble: absolute path of its scene; else ""      */
    char *settings;       /* --set on top of that, or of the folder's scene.yaml, a line each */
    int64_t first, count; /* members of the plan that the state is of              */
    int64_t seed_first, seed_last;
    int threads;
    int own_settings; /* how many of the settings the ensemble began with */
    bool has_seeds, no_video;
    int64_t taken; /* changes made of those of the run that is repeated */
    bool settles;  /* time 0 has not come: step and time are of settling */
    int64_t step;
    double time; /* s */
} OzCheckpointHead;

void oz_checkpoint_head_free(OzCheckpointHead *head);

/* Saves or loads it (base/state.h). */
OzStatus oz_checkpoint_head_state(OzCheckpointHead *head, OzStateVisit *visit);

/* What a run's own options say; the caller sets the members. Frees nothing, also on failure. */
OzStatus oz_checkpoint_head_fill(OzCheckpointHead *head, const OzOptions *options,
                                 const OzScene *scene, bool is_ensemble, const char *device);

/* One worker's. Zeroed is valid. */
typedef struct OzCheckpoint {
    OzCheckpointHead head;
    const char *folder; /* borrowed: the run's                            */
    bool is_ensemble;
    double every;  /* s of wall time between states                       */
    double next;   /* wall clock: when one is due                         */
    double period; /* s, of the first moving wall: kept states are called after taps; 0: times */
} OzCheckpoint;

/* Another scene runs now, which differs in this: later states say so. */
OzStatus oz_checkpoint_change(OzCheckpoint *checkpoint, const OzScene *scene,
                              const OzChanges *changes);

bool oz_checkpoint_is_due(const OzCheckpoint *checkpoint);

/* Puts a state, which begins with the head, into its file; kept: into one of checkpoints/, which no
 * later one replaces. Says so in log.txt. */
OzStatus oz_checkpoint_write(OzCheckpoint *checkpoint, const OzState *state, bool kept);

void oz_checkpoint_free(OzCheckpoint *checkpoint);

/* A kept state's name in checkpoints/, without the ending: "tap_00300", "time_0.250000000". */
void oz_checkpoint_name(char *name, size_t size, double time, double period);
