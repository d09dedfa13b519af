/* Looking at what is there, and running what is not. */
#include "figures/study_runs.h"

#include "base/cells.h"
#include "base/file.h"
#include "base/log.h"
#include "run/run.h"
#include "scene/scene.h"

#include <glob.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

OzStatus oz_study_runs_path(char **path, const OzStudyRun *run, const char *folder,
                            const char *file)
{
    if (asprintf(path, "%s/%s%s%s", folder, run->name, file[0] ? "/" : "", file) < 0) {
        *path = NULL;
        return oz_status_fail(OZ_ERR_MEMORY, "out of memory for a path");
    }
    return OZ_OK;
}

/* The command that makes the run. */
static OzStatus make_options(OzOptions *made, const OzStudy *study, const OzStudyRun *run,
                             const OzOptions *options)
{
    *made = *options;
    made->command = "run";
    made->paths[0] = run->path;
    made->path_count = 1;
    made->no_video = true;
    made->quick = false;
    made->until = -1;
    made->has_seeds = true;
    made->seed_first = run->seeds.count ? (uint64_t)run->seeds.items[0] : 1;
    made->seed_last = run->seeds.count ? (uint64_t)run->seeds.items[1] : 1;
    made->setting_count = 0;
    const OzTexts *quick = run->quick.count ? &run->quick : &study->quick.set;
    const OzTexts *sets[] = {&run->set, options->quick ? quick : NULL};
    for (int k = 0; k < 2; k++) {
        for (int i = 0; sets[k] && i < sets[k]->count; i++) {
            if (made->setting_count == OZ_CLI_SETTINGS_MAX || !strchr(sets[k]->items[i], '=')) {
                return oz_status_fail(
                    OZ_ERR_INPUT, "%s: set %s of %s; expected key=value, at most %d of them",
                    study->path, sets[k]->items[i], run->name, OZ_CLI_SETTINGS_MAX);
            }
            made->settings[made->setting_count++] = sets[k]->items[i];
        }
    }
    if (options->quick && study->quick.seeds.count) {
        uint64_t last = made->seed_first + (uint64_t)fmax(1, study->quick.seeds.items[0]) - 1;
        made->seed_last = made->seed_last < last ? made->seed_last : last;
    }
    return OZ_OK;
}

/* Adds what is wrong with a run, if anything is, to a text of lines. */
static OzStatus check_run(const OzStudy *study, const OzStudyRun *run, const OzOptions *options,
                          char **text)
{
    OzOptions made;
    OzScene scene = {0};
    char *longer = NULL;
    OzStatus status = make_options(&made, study, run, options);
    if (status == OZ_OK) {
        status = oz_scene_load(&scene, made.paths[0], made.settings, made.setting_count);
    }
    oz_scene_free(&scene);
    if (status != OZ_ERR_INPUT) {
        return status;
    }
    if (asprintf(&longer, "%s%s%s:%d: run %s: %s", *text ? *text : "", *text ? "\n" : "",
                 study->path, run->line, run->name, oz_status_text()) < 0) {
        return oz_status_fail(OZ_ERR_MEMORY, "out of memory for a study's errors");
    }
    free(*text);
    *text = longer;
    return OZ_OK;
}

OzStatus oz_study_runs_check(const OzStudy *study, const OzOptions *options)
{
    OzStatus status = OZ_OK;
    char *text = NULL;
    for (int i = 0; i < study->run_count; i++) {
        OZ_TRY(check_run(study, &study->runs[i], options, &text));
    }
    status = text ? oz_status_fail(OZ_ERR_INPUT, "%s", text) : OZ_OK;
done:
    free(text);
    return status;
}

/* The first line that differs, of the second text, cut to size. */
static void find_difference(const char *a, const char *b, char *line, size_t size)
{
    const char *begin = b;
    for (; *a && *a == *b; a++, b++) {
        begin = *b == '\n' ? b + 1 : begin;
    }
    snprintf(line, size, "%.*s", (int)strcspn(begin, "\n"), begin);
}

/* Whether the folder's scene is the one that the study asks for; *end: when that ends, s. */
static OzStatus check_scene(const OzOptions *made, const char *folder, double *end)
{
    OzStatus status = OZ_OK;
    OzScene asked = {0}, there = {0};
    char *path = NULL, *a = NULL, *b = NULL;
    size_t length = 0;
    OZ_TRY(oz_file_join(&path, folder, "scene.yaml"));
    OZ_TRY(oz_scene_load(&asked, made->paths[0], made->settings, made->setting_count));
    *end = asked.duration - 0.5 * asked.step;
    OZ_TRY(oz_scene_load(&there, path, NULL, 0));
    OZ_TRY(oz_scene_text(&asked, &a, &length));
    OZ_TRY(oz_scene_text(&there, &b, &length));
    if (strcmp(a, b) != 0) {
        char wanted[120], is[120];
        find_difference(b, a, wanted, sizeof wanted);
        find_difference(a, b, is, sizeof is);
        status = oz_status_fail(OZ_ERR_INPUT,
                                "%s holds another run (`%s`); expected %s with `%s`, another "
                                "folder (-o), or that you move it away",
                                folder, is, made->paths[0], wanted);
    }
done:
    oz_scene_free(&asked);
    oz_scene_free(&there);
    free(path);
    free(a);
    free(b);
    return status;
}

static void take_row(OzRunFacts *facts, int64_t seed, int64_t step, double end, bool stopped)
{
    bool first = facts->members == 0;
    facts->seed_first = first || seed < facts->seed_first ? seed : facts->seed_first;
    facts->seed_last = first || seed > facts->seed_last ? seed : facts->seed_last;
    facts->step_least = first || step < facts->step_least ? step : facts->step_least;
    facts->step_most = first || step > facts->step_most ? step : facts->step_most;
    facts->end = fmax(facts->end, end);
    facts->members++;
    facts->stopped += stopped;
}

/* *open: members that have neither come to the end, s, nor been stopped by a guard. */
static OzStatus read_facts(OzRunFacts *facts, double end, int64_t *open, const char *path)
{
    OzStatus status = OZ_OK;
    OzCells table = {0};
    *facts = (OzRunFacts){0};
    *open = 0;
    OZ_TRY(oz_cells_read(&table, path));
    int seed = oz_cells_find(&table, "seed"), state = oz_cells_find(&table, "status");
    int step = oz_cells_find(&table, "step"), tap = oz_cells_find(&table, "tap");
    int time = oz_cells_find(&table, "time");
    if (seed < 0 || state < 0 || step < 0 || time < 0 || table.row_count == 0) {
        status = oz_status_fail(OZ_ERR_INPUT, "%s is no table of members", path);
        goto done;
    }
    for (int64_t row = 0; row < table.row_count; row++) {
        const char *word = oz_cells_text(&table, row, state);
        bool stopped = strcmp(word, "stopped") == 0;
        bool done = strcmp(word, "done") == 0 && oz_cells_number(&table, row, time) >= end;
        double taps = tap < 0 ? NAN : oz_cells_number(&table, row, tap);
        *open += !stopped && !done;
        facts->in_taps |= !isnan(taps);
        take_row(facts, (int64_t)oz_cells_number(&table, row, seed),
                 isnan(oz_cells_number(&table, row, step))
                     ? 0
                     : (int64_t)oz_cells_number(&table, row, step),
                 isnan(taps) ? oz_cells_number(&table, row, time) : taps, stopped);
    }
done:
    oz_cells_free(&table);
    return status;
}

OzStatus oz_study_runs_facts(OzRunFacts *facts, const OzStudyRun *run, const char *folder)
{
    char *path = NULL;
    int64_t open = 0;
    OZ_PASS(oz_study_runs_path(&path, run, folder, "members.csv"));
    OzStatus status = read_facts(facts, 0, &open, path);
    free(path);
    return status;
}

static bool has_file(const char *folder, const char *pattern)
{
    glob_t found = {0};
    char *path = NULL;
    bool has = oz_file_join(&path, folder, pattern) == OZ_OK && glob(path, 0, NULL, &found) == 0;
    globfree(&found);
    free(path);
    return has;
}

/* What is to be done with a run's folder. */
typedef enum Need { NEED_NOTHING, NEED_RUN, NEED_RESUME, NEED_RUN_AGAIN } Need;

static OzStatus look(Need *need, const OzOptions *made, const char *folder)
{
    OzRunFacts facts;
    int64_t open = 0;
    double end = 0;
    char *path = NULL;
    *need = NEED_RUN;
    if (!has_file(folder, "scene.yaml")) {
        return OZ_OK;
    }
    OZ_PASS(check_scene(made, folder, &end));
    *need = has_file(folder, "state*.h5*") ? NEED_RESUME : NEED_RUN_AGAIN;
    if (!has_file(folder, "members.csv")) {
        return OZ_OK;
    }
    OZ_PASS(oz_file_join(&path, folder, "members.csv"));
    OzStatus status = read_facts(&facts, end, &open, path);
    free(path);
    OZ_PASS(status);
    if (facts.seed_first != (int64_t)made->seed_first ||
        facts.seed_last != (int64_t)made->seed_last) {
        return oz_status_fail(OZ_ERR_INPUT,
                              "%s holds seeds %" PRId64 " to %" PRId64 "; expected %" PRIu64
                              " to %" PRIu64 ", another folder (-o), or that you move it away",
                              folder, facts.seed_first, facts.seed_last, made->seed_first,
                              made->seed_last);
    }
    *need = open == 0 ? NEED_NOTHING : *need;
    return OZ_OK;
}

/* A member that a guard stops fails the run, but not the study: the others are its mean. */
static OzStatus judge(OzStatus ran, const OzOptions *made, const char *folder)
{
    char why[2048];
    Need need = NEED_NOTHING;
    if (ran != OZ_ERR_BLOWUP) {
        return ran;
    }
    snprintf(why, sizeof why, "%s", oz_status_text());
    if (look(&need, made, folder) == OZ_OK && need == NEED_NOTHING) {
        oz_log_line("warning: %s goes on without the members that were stopped", made->paths[0]);
        return OZ_OK;
    }
    return oz_status_fail(ran, "%s", why);
}

static OzStatus run_scene(OzOptions *made, char *folder, bool again)
{
    made->out = folder;
    made->overwrite = again;
    return oz_run_scene(made);
}

static OzStatus go_on(OzOptions *made, char *folder)
{
    made->command = "resume";
    made->paths[0] = folder;
    made->out = NULL;
    made->setting_count = 0;
    made->has_seeds = false;
    return oz_run_resume(made);
}

OzStatus oz_study_runs_make(const OzStudy *study, const OzStudyRun *run, const char *folder,
                            const OzOptions *options)
{
    OzStatus status = OZ_OK;
    OzOptions made, used;
    Need need = NEED_NOTHING;
    char *path = NULL;
    OZ_TRY(make_options(&made, study, run, options));
    OZ_TRY(oz_study_runs_path(&path, run, folder, ""));
    OZ_TRY(look(&need, &made, path));
    if (need == NEED_NOTHING) {
        goto done;
    }
    oz_log_line("%s (run %d of %d): %s, seeds %" PRIu64 " to %" PRIu64 "%s", path,
                (int)(run - study->runs) + 1, study->run_count, run->path, made.seed_first,
                made.seed_last, need == NEED_RESUME ? ", from its last state" : "");
    used = made;
    status =
        need == NEED_RESUME ? go_on(&used, path) : run_scene(&used, path, need == NEED_RUN_AGAIN);
    status = judge(status, &made, path);
done:
    free(path);
    return status;
}
