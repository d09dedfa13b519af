/* Files of states. */
#include "run/checkpoint.h"

#include "base/clock.h"
#include "base/file.h"
#include "base/folder.h"
#include "base/log.h"
#include "base/memory.h"
#include "run/state_file.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void oz_checkpoint_head_free(OzCheckpointHead *head)
{
    free(head->version);
    free(head->device);
    free(head->device_asked);
    free(head->name);
    free(head->origin);
    free(head->settings);
    *head = (OzCheckpointHead){0};
}

OzStatus oz_checkpoint_head_state(OzCheckpointHead *head, OzStateVisit *visit)
{
    OZ_PASS(oz_state_enter(visit, "run", 3));
    OZ_PASS(oz_state_text(visit, "program", &head->version));
    OZ_PASS(oz_state_text(visit, "device", &head->device));
    OZ_PASS(oz_state_text(visit, "device_asked", &head->device_asked));
    OZ_PASS(oz_state_text(visit, "scene_name", &head->name));
    OZ_PASS(oz_state_text(visit, "origin", &head->origin));
    OZ_PASS(oz_state_text(visit, "settings", &head->settings));
    OZ_PASS(oz_state_index(visit, "first", &head->first, 0, INT64_MAX));
    OZ_PASS(oz_state_index(visit, "count", &head->count, 1, INT32_MAX));
    OZ_PASS(oz_state_int64(visit, "seed_first", "none", &head->seed_first));
    OZ_PASS(oz_state_int64(visit, "seed_last", "none", &head->seed_last));
    OZ_PASS(oz_state_int(visit, "threads", "none", &head->threads));
    OZ_PASS(oz_state_int(visit, "own_settings", "none", &head->own_settings));
    OZ_PASS(oz_state_bool(visit, "has_seeds", &head->has_seeds));
    OZ_PASS(oz_state_bool(visit, "no_video", &head->no_video));
    OZ_PASS(oz_state_index(visit, "changes_taken", &head->taken, 0, INT64_MAX));
    OZ_PASS(oz_state_bool(visit, "settles", &head->settles));
    OZ_PASS(oz_state_int64(visit, "step", "step", &head->step));
    OZ_PASS(oz_state_double(visit, "time", "s", &head->time, 1));
    oz_state_leave(visit);
    return OZ_OK;
}

/* A plain run's own are in its scene.yaml already. */
static OzStatus join_settings(char **text, const OzOptions *options)
{
    size_t length = 0;
    FILE *file = open_memstream(text, &length);
    for (int i = 0; file && i < options->setting_count; i++) {
        fprintf(file, "%s\n", options->settings[i]);
    }
    return file && fclose(file) == 0
               ? OZ_OK
               : oz_status_fail(OZ_ERR_MEMORY, "out of memory for a run's settings");
}

OzStatus oz_checkpoint_head_fill(OzCheckpointHead *head, const OzOptions *options,
                                 const OzScene *scene, bool is_ensemble, const char *device)
{
    char *origin = is_ensemble ? realpath(options->paths[0], NULL) : NULL;
    OzStatus status = oz_memory_text(&head->origin, origin ? origin : "");
    free(origin);
    OZ_PASS(status);
    OZ_PASS(oz_memory_text(&head->version, ORZO_VERSION));
    OZ_PASS(oz_memory_text(&head->device, device));
    OZ_PASS(oz_memory_text(&head->device_asked, options->device ? options->device : ""));
    OZ_PASS(oz_memory_text(&head->name, scene->name));
    OZ_PASS(is_ensemble || options->resumes ? join_settings(&head->settings, options)
                                            : oz_memory_text(&head->settings, ""));
    head->has_seeds = options->has_seeds;
    head->seed_first = (int64_t)options->seed_first;
    head->seed_last = (int64_t)options->seed_last;
    head->threads = options->threads;
    head->own_settings = options->resumes ? options->own_settings : options->setting_count;
    head->no_video = options->no_video;
    return OZ_OK;
}

/* Whether a line sets or takes out this key. */
static bool is_about(const char *line, const char *key)
{
    size_t length = strlen(key);
    bool out = line[0] == '-';
    char end = strncmp(line + out, key, length) == 0 ? line[out + length] : 'x';
    return out ? end == '\n' || end == '\0' : end == '=';
}

/* The lines of settings without those about the keys that change, of the first ones all. */
static void print_kept(FILE *file, const char *line, int own, const OzChanges *changes)
{
    for (int number = 0; line && *line; number++) {
        size_t length = strcspn(line, "\n");
        bool kept = true;
        for (int i = 0; i < changes->count && number >= own; i++) {
            kept = kept && !is_about(line, changes->rows[i].path);
        }
        if (kept) {
            fprintf(file, "%.*s\n", (int)length, line);
        }
        line += length + (line[length] == '\n');
    }
}

/* `orzo resume` begins with these on top of the folder's scene.yaml. */
static OzStatus change_settings(OzCheckpointHead *head, bool is_ensemble, const OzChanges *changes)
{
    char *text = NULL;
    size_t length = 0;
    FILE *file = open_memstream(&text, &length);
    if (file) {
        print_kept(file, head->settings, is_ensemble ? head->own_settings : 0, changes);
    }
    for (int i = 0; file && i < changes->count; i++) {
        const OzChange *c = &changes->rows[i];
        fprintf(file, c->now[0] ? "%s=%s\n" : "-%s%s\n", c->path, c->now);
    }
    if (!file || fclose(file) != 0 || !text) {
        free(text);
        return oz_status_fail(OZ_ERR_MEMORY, "out of memory for a run's settings");
    }
    free(head->settings);
    head->settings = text;
    return OZ_OK;
}

OzStatus oz_checkpoint_change(OzCheckpoint *checkpoint, const OzScene *scene,
                              const OzChanges *changes)
{
    double every = scene->checkpoint.every;
    if (every != checkpoint->every) {
        checkpoint->every = every;
        checkpoint->next = every > 0 ? oz_clock_now() + every : INFINITY;
    }
    return change_settings(&checkpoint->head, checkpoint->is_ensemble, changes);
}

bool oz_checkpoint_is_due(const OzCheckpoint *checkpoint)
{
    return oz_clock_now() >= checkpoint->next;
}

void oz_checkpoint_name(char *name, size_t size, double time, double period)
{
    double tap = period > 0 ? time / period : 0;
    if (period > 0 && fabs(tap - round(tap)) < 1e-6 * fmax(1, tap)) {
        snprintf(name, size, "tap_%05.0f", tap);
    } else if (period > 0) {
        snprintf(name, size, "tap_%09.3f", tap);
    } else {
        snprintf(name, size, "time_%.9f", time);
    }
}

/* The file's name in the run's folder. */
static void choose_name(const OzCheckpoint *checkpoint, bool kept, char *name, size_t size)
{
    char moment[64], part[32] = "";
    if (checkpoint->is_ensemble) {
        snprintf(part, sizeof part, "_%05lld", (long long)checkpoint->head.first);
    }
    oz_checkpoint_name(moment, sizeof moment, checkpoint->head.time, checkpoint->period);
    if (kept) {
        snprintf(name, size, "checkpoints/%s%s.h5", moment, part);
    } else {
        snprintf(name, size, "state%s.h5", part);
    }
}

/* All names under which the file stands for a while. */
static OzStatus note(const char *folder, const char *name)
{
    static const char *const endings[] = {"", ".part", ".previous"};
    char whole[160];
    for (int i = 0; i < 3; i++) {
        snprintf(whole, sizeof whole, "%s%s", name, endings[i]);
        OZ_PASS(oz_folder_note(folder, whole));
    }
    return OZ_OK;
}

OzStatus oz_checkpoint_write(OzCheckpoint *checkpoint, const OzState *state, bool kept)
{
    OzStatus status = OZ_OK;
    char name[128], *path = NULL, *folder = NULL;
    double start = oz_clock_now();
    choose_name(checkpoint, kept, name, sizeof name);
    checkpoint->next = checkpoint->every > 0 ? start + checkpoint->every : INFINITY;
    if (kept) {
        OZ_TRY(oz_file_join(&folder, checkpoint->folder, "checkpoints"));
        OZ_TRY(oz_file_make_folder(folder));
    }
    OZ_TRY(oz_file_join(&path, checkpoint->folder, name));
    OZ_TRY(note(checkpoint->folder, name));
    OZ_TRY(oz_state_file_write(state, path));
    oz_log_detail("state at step %lld (%.9g s) in %s, %.3f s", (long long)checkpoint->head.step,
                  checkpoint->head.time, name, oz_clock_now() - start);
done:
    free(path);
    free(folder);
    return status;
}

void oz_checkpoint_free(OzCheckpoint *checkpoint)
{
    oz_checkpoint_head_free(&checkpoint->head);
    *checkpoint = (OzCheckpoint){0};
}
