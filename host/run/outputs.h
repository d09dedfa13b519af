/* What one member of a run leaves: its folder with scene, series, frames, pictures and last state.
 * Sees snapshots and no simulation. */
#pragma once

#include "base/folder.h"
#include "cli.h"
#include "draw/render_queue.h"
#include "export/coarse_images.h"
#include "export/export.h"
#include "observe/coarse_rows.h"
#include "observe/contact_rows.h"
#include "observe/frames.h"
#include "observe/series.h"
#include "run/glances.h"
#include "run/reload_log.h"
#include "run/serve.h"

#include <stdbool.h>

/* What became of a member. */
typedef enum OzOutcome {
    OZ_OUTCOME_NOT_STARTED,
    OZ_OUTCOME_DONE,
    OZ_OUTCOME_STOPPED, /* by a guard */
    OZ_OUTCOME_INTERRUPTED,
    OZ_OUTCOME_FAILED
} OzOutcome;

/* THE list of what is handed a member's states, in the order in which they are closed: X(type,
 * member, what saves or loads what it remembers of them, what closes it), of OzOutputs *o and
 * OzStateVisit *visit. What later rows or pictures depend on belongs to one of these; exports are
 * made of frames.bin alone, and remember nothing. */
#define OZ_OUTPUTS_OWNERS(X)                                                                       \
    X(OzPictures, pictures, oz_render_queue_state(o->render_queue, o->pictures, &o->now, visit),   \
      oz_render_queue_finish(o->render_queue, o->pictures))                                        \
    X(OzFrames, frames, oz_frames_state(o->frames, visit), oz_frames_finish(o->frames))            \
    X(OzContactRows, contact_rows, oz_contact_rows_state(o->contact_rows, visit),                  \
      oz_contact_rows_free(o->contact_rows))                                                       \
    X(OzCoarseRows, fields, oz_coarse_rows_state(o->fields, visit),                                \
      oz_coarse_rows_free(o->fields))                                                              \
    X(OzCoarseImages, field_images, oz_coarse_images_state(o->field_images, visit),                \
      oz_coarse_images_free(o->field_images))                                                      \
    X(OzSeries, series, oz_series_state(o->series, visit), oz_series_free(o->series))              \
    X(OzReloadLog, reloads, oz_reload_log_state(o->reloads, visit),                                \
      oz_reload_log_free(o->reloads))                                                              \
    X(OzExporter, exporter, OZ_OK, end_export(o))

/* One member. Zeroed is valid: what was not opened is not closed. It must not move in memory while
 * open. */
typedef struct OzOutputs {
    OzScene scene;
    OzGrains grains;
    OzSnapshot now;      /* the state to be written next */
    char *name;          /* of a member of an ensemble, as in seed_00003; owned */
    char *folder;        /* owned */
    char *final;         /* owned: path of final.csv, once its room is reserved */
    OzFolder owned;      /* of a member of an ensemble: its folder, in use */
    char *export_folder; /* owned, from the first frame on that is exported */
    OzFolder exported;   /* the same, in use */
#define OZ_OUTPUTS_MEMBER(type, member, state, close) type *member;
    OZ_OUTPUTS_OWNERS(OZ_OUTPUTS_MEMBER)
#undef OZ_OUTPUTS_MEMBER
    OzGlances glances;
    OzPicturesSettings picture_settings;
    OzServe *serve;              /* borrowed: is shown the rows; NULL: none          */
    OzRenderQueue *render_queue; /* borrowed: draws the pictures' pictures */
    int64_t number;              /* of the member in its plan */
    bool goes_on; /* set by who opens it: its files are there, oz_outputs_state will load */
    bool is_open;
    OzOutcome outcome;
    OzStatus loss; /* of a member that was lost while others went on: why */
} OzOutputs;

/* What a run does in its folder and in its members' folders. */
OzFolderUse oz_outputs_use(bool overwrite);

/* The folder of a command: -o, or runs/<name>; below it part_00001 of one that runs a part. The
 * caller frees. */
OzStatus oz_outputs_choose_folder(char **folder, const OzOptions *options, const char *name);

/* Opens what the scene asks for in outputs->folder; device is for the movie's metadata; render
 * queue is shared with other members and must outlive this one. */
OzStatus oz_outputs_open(OzOutputs *outputs, const OzOptions *options, const char *device,
                         OzRenderQueue *render_queue);

/* A scene as the scene.yaml of a folder. */
OzStatus oz_outputs_write_scene(const OzScene *scene, const char *folder);

/* Saves or loads (base/state.h) all that later rows and pictures depend on, and whether the member
 * is open; loading closes one that was not. */
OzStatus oz_outputs_state(OzOutputs *outputs, OzStateVisit *visit);

/* What is due (OZ_DUE_ bits) of outputs->now. */
OzStatus oz_outputs_look(OzOutputs *outputs, int due);

/* Another scene takes over from this state on: it becomes the outputs' own, and *next empty. The
 * movie shows the caption for two seconds, unless its scene wants none. */
OzStatus oz_outputs_take(OzOutputs *outputs, OzScene *next, const char *caption);

/* Where a run that can be changed ends, in reloads.csv, and its scene as it is then, in
 * scene_final.yaml. */
OzStatus oz_outputs_note_end(OzOutputs *outputs, int64_t step, double time, const char *how);

/* outputs->now as final.csv, a drum's inclination_spectrum.csv, and the mean of fields. */
OzStatus oz_outputs_write_final(OzOutputs *outputs);

/* Finishes movie, frames and series; they are whole afterwards. Returns the first failure. */
OzStatus oz_outputs_close(OzOutputs *outputs);

/* Closes and frees everything; NULL is fine. */
void oz_outputs_free(OzOutputs *outputs);
