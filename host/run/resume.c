/* Reading what a run has left. */
#include "run/resume.h"

#include "base/file.h"
#include "base/log.h"
#include "base/memory.h"
#include "run/from_keep.h"
#include "run/replay.h"
#include "run/state_file.h"

#include <glob.h>
#include <stdlib.h>
#include <string.h>

/* Whether a setting is of the run's end or of the states that it leaves, which changes nothing that
 * was computed. */
static bool is_of_end(const char *setting)
{
    static const char *const keys[] = {"time.duration=", "time.taps=", "checkpoint."};
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++) {
        if (strncmp(setting, keys[i], strlen(keys[i])) == 0) {
            return true;
        }
    }
    return false;
}

/* A state and what it says of its run. */
static OzStatus read_state(OzState *state, OzCheckpointHead *head, const char *path)
{
    OZ_PASS(oz_state_file_read(state, path));
    OzStateVisit visit = oz_state_load(state);
    OzStatus status = oz_checkpoint_head_state(head, &visit);
    if (status != OZ_OK) {
        oz_state_free(state);
        oz_checkpoint_head_free(head);
    }
    return status;
}

/* The file, or the one before it. */
static OzStatus read_newest(OzState *state, OzCheckpointHead *head, const char *path)
{
    char previous[4200], why[1024];
    snprintf(previous, sizeof previous, "%s.previous", path);
    OzStatus status = read_state(state, head, path);
    if (status == OZ_OK || !oz_file_exists(previous)) {
        return status;
    }
    snprintf(why, sizeof why, "%s", oz_status_text());
    if (read_state(state, head, previous) != OZ_OK) {
        char too[1024];
        snprintf(too, sizeof too, "%s", oz_status_text());
        return oz_status_fail(OZ_ERR_INPUT, "%s; and the one before it: %s", why, too);
    }
    oz_log_line("warning: %s; going on from the state before it, step %lld", why,
                (long long)head->step);
    return OZ_OK;
}

/* Paths of states without ".previous", each once. */
static OzStatus list_paths(glob_t *found, const char *folder)
{
    OzStatus status = OZ_OK;
    char *pattern = NULL;
    OZ_TRY(oz_file_join(&pattern, folder, "state*.h5"));
    int code = glob(pattern, 0, NULL, found);
    free(pattern);
    pattern = NULL;
    OZ_TRY(oz_file_join(&pattern, folder, "state*.h5.previous"));
    int more = glob(pattern, code == 0 ? GLOB_APPEND : 0, NULL, found);
    if (code == GLOB_NOSPACE || more == GLOB_NOSPACE) {
        status = oz_status_fail(OZ_ERR_MEMORY, "out of memory for the names of states");
    } else if (code != 0 && more != 0) {
        status = oz_status_fail(OZ_ERR_INPUT,
                                "%s holds no state of a run; expected the folder of a run that has "
                                "made a step or more (run it again: --overwrite)",
                                folder);
    }
done:
    free(pattern);
    return status;
}

static bool has_state(const char *folder)
{
    glob_t found = {0};
    bool has = list_paths(&found, folder) == OZ_OK;
    globfree(&found);
    return has;
}

static bool has_head_of(const OzResume *resume, int64_t first)
{
    for (int i = 0; i < resume->count; i++) {
        if (resume->heads[i].first == first) {
            return true;
        }
    }
    return false;
}

static OzStatus read_states(OzResume *resume, const char *folder)
{
    OzStatus status = OZ_OK;
    glob_t found = {0};
    OZ_TRY(list_paths(&found, folder));
    OZ_TRY(OZ_NEW(&resume->states, found.gl_pathc));
    OZ_TRY(OZ_NEW(&resume->heads, found.gl_pathc));
    for (size_t i = 0; i < found.gl_pathc; i++) {
        char path[4096];
        size_t length = strlen(found.gl_pathv[i]), ending = strlen(".previous");
        bool previous =
            length > ending && strcmp(found.gl_pathv[i] + length - ending, ".previous") == 0;
        snprintf(path, sizeof path, "%.*s", (int)(previous ? length - ending : length),
                 found.gl_pathv[i]);
        if (previous && oz_file_exists(path)) {
            continue; /* read with it */
        }
        OZ_TRY(read_newest(&resume->states[resume->count], &resume->heads[resume->count], path));
        if (has_head_of(resume, resume->heads[resume->count].first)) {
            oz_state_free(&resume->states[resume->count]);
            oz_checkpoint_head_free(&resume->heads[resume->count]);
            continue;
        }
        resume->count++;
    }
done:
    globfree(&found);
    return status;
}

void oz_resume_say(const char *folder, OzStatus ended)
{
    OzResume resume = {0};
    if (!has_state(folder)) {
        oz_log_line("no state was left to go on from; expected that it is run again (--overwrite)");
    } else if (read_states(&resume, folder) != OZ_OK) {
        oz_log_line("%s", oz_status_text());
    } else {
        const OzCheckpointHead *head = &resume.heads[0];
        bool guard = ended == OZ_ERR_BLOWUP;
        oz_log_line("to go on from the last state (step %lld, %.9g s%s)%s: orzo resume %s%s",
                    (long long)head->step, head->time, head->settles ? " of settling" : "",
                    guard ? ", changed, for unchanged it comes to the same stop" : "", folder,
                    guard ? " --set KEY=VALUE" : "");
    }
    oz_resume_free(&resume);
}

OzStatus oz_resume_take_seeds(OzOptions *options, const char *folder)
{
    OzStatus status = OZ_OK;
    OzResume resume = {0};
    if (options->has_seeds || !has_state(folder)) {
        return OZ_OK;
    }
    OZ_TRY(read_states(&resume, folder));
    options->has_seeds = resume.heads[0].has_seeds;
    options->seed_first = (uint64_t)resume.heads[0].seed_first;
    options->seed_last = (uint64_t)resume.heads[0].seed_last;
done:
    oz_resume_free(&resume);
    return status;
}

static OzStatus add_setting(OzResume *resume, const char *text, size_t length)
{
    OzOptions *options = &resume->options;
    if (options->setting_count == OZ_CLI_SETTINGS_MAX) {
        return oz_status_fail(OZ_ERR_INPUT, "more than %d settings", OZ_CLI_SETTINGS_MAX);
    }
    char *copy = strndup(text, length);
    if (!copy) {
        return oz_status_fail(OZ_ERR_MEMORY, "out of memory for a setting");
    }
    resume->settings[resume->setting_count++] = copy;
    options->settings[options->setting_count++] = copy;
    return OZ_OK;
}

/* Those of earlier goes; the new ones follow. */
static OzStatus join_settings(OzResume *resume)
{
    const char *line = resume->heads[0].settings;
    OZ_PASS(OZ_NEW(&resume->settings, OZ_CLI_SETTINGS_MAX));
    resume->options.setting_count = 0;
    while (line && *line) {
        size_t length = strcspn(line, "\n");
        OZ_PASS(add_setting(resume, line, length));
        line += length + (line[length] == '\n');
    }
    return OZ_OK;
}

/* An ensemble's members are made of the scene it was given, which must be what it was. */
static OzStatus check_origin(const OzResume *resume, const char *folder)
{
    OzStatus status = OZ_OK;
    OzScene scene = {0};
    char *now = NULL, *then = NULL;
    size_t length = 0;
    const char *origin = resume->heads[0].origin;
    OZ_TRY(oz_scene_load(&scene, origin, resume->options.settings, resume->heads[0].own_settings));
    OZ_TRY(oz_scene_text(&scene, &now, &length));
    OZ_TRY(oz_file_read(&then, NULL, resume->scene_path));
    if (strcmp(now, then) != 0) {
        status = oz_status_fail(OZ_ERR_INPUT,
                                "%s is not what the run in %s began with (its scene.yaml); "
                                "expected that it is put back",
                                origin, folder);
    }
done:
    free(now);
    free(then);
    oz_scene_free(&scene);
    return status;
}

/* Refuses by name what cannot change in a run, before anything is touched. */
static OzStatus check_changes(const OzResume *resume)
{
    OzStatus status = OZ_OK;
    OzScene scene = {0}, next = {0};
    const OzOptions *options = &resume->options;
    OZ_TRY(oz_scene_load(&scene, options->paths[0], options->settings, options->setting_count));
    OZ_TRY(oz_scene_change(&next, &scene, resume->changes, resume->change_count));
    if (scene.phase_count > 0 && resume->change_count > 0) {
        status = oz_status_fail(OZ_ERR_INPUT,
                                "%s has phases, which change it at their times; "
                                "expected no --set but of the end and of states",
                                scene.path);
    }
done:
    oz_scene_free(&scene);
    oz_scene_free(&next);
    return status;
}

/* A run that repeated another one goes on doing so. A plain one that has no more to repeat takes
 * changes as any other. */
static OzStatus take_replay(OzResume *resume, const OzOptions *asked)
{
    OzOptions *options = &resume->options;
    const OzCheckpointHead *head = &resume->heads[0];
    OzReplay replay = {0};
    if (!oz_replay_is_kept(asked->paths[0])) {
        return OZ_OK;
    }
    OzStatus status = oz_replay_read(&replay, asked->paths[0], "", true);
    options->replay = head->origin[0] || oz_replay_go_on(&replay, head->taken, head->step);
    options->replay_folder = asked->paths[0];
    oz_replay_free(&replay);
    if (status == OZ_OK && options->replay && resume->change_count > 0) {
        status =
            oz_status_fail(OZ_ERR_INPUT,
                           "%s repeats another run, whose changes it has not all made; expected "
                           "no --set but of the end and of states",
                           asked->paths[0]);
    }
    return status;
}

/* The command that the run was, with what is asked for now. */
static OzStatus make_options(OzResume *resume, const OzOptions *asked)
{
    OzOptions *options = &resume->options;
    const OzCheckpointHead *head = &resume->heads[0];
    *options = *asked;
    options->resumes = true;
    OZ_PASS(oz_file_join(&resume->scene_path, asked->paths[0], "scene.yaml"));
    OZ_PASS(join_settings(resume));
    options->paths[0] = resume->scene_path;
    if (head->origin[0]) {
        OZ_PASS(check_origin(resume, asked->paths[0]));
        options->paths[0] = head->origin;
    }
    for (int i = 0; i < asked->setting_count; i++) {
        char *setting = asked->settings[i];
        if (is_of_end(setting)) {
            OZ_PASS(add_setting(resume, setting, strlen(setting)));
        } else {
            resume->changes[resume->change_count++] = setting;
        }
    }
    OZ_PASS(take_replay(resume, asked));
    OZ_PASS(oz_from_keep_find(&resume->from, asked->paths[0]));
    options->from = resume->from;
    options->out = asked->paths[0];
    options->has_seeds = head->has_seeds;
    options->seed_first = (uint64_t)head->seed_first;
    options->seed_last = (uint64_t)head->seed_last;
    options->no_video = head->no_video;
    options->device = asked->device           ? asked->device
                      : head->device_asked[0] ? head->device_asked
                                              : NULL;
    options->threads = asked->threads ? asked->threads : head->threads;
    options->own_settings = head->own_settings;
    options->force = true;     /* what it began with has been judged */
    options->overwrite = true; /* members that had not begun         */
    return check_changes(resume);
}

OzStatus oz_resume_open(OzResume *resume, const OzOptions *asked)
{
    *resume = (OzResume){0};
    OZ_PASS(read_states(resume, asked->paths[0]));
    return make_options(resume, asked);
}

OzStatus oz_resume_change(OzResume *resume, OzReload *reload)
{
    char message[2048];
    if (!resume || resume->change_count == 0) {
        return OZ_OK;
    }
    bool taken =
        oz_reload_set(reload, resume->changes, resume->change_count, message, sizeof message);
    resume->change_count = 0;
    return taken ? OZ_OK : oz_status_fail(OZ_ERR_INPUT, "%s", message);
}

void oz_resume_free(OzResume *resume)
{
    for (int i = 0; i < resume->count; i++) {
        oz_state_free(&resume->states[i]);
        oz_checkpoint_head_free(&resume->heads[i]);
    }
    for (int i = 0; i < resume->setting_count; i++) {
        free(resume->settings[i]);
    }
    free(resume->states);
    free(resume->heads);
    free(resume->settings);
    free(resume->scene_path);
    free(resume->from);
    *resume = (OzResume){0};
}
