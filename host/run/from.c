/* Finding states and the members in them. */
#include "run/from.h"

#include "base/file.h"
#include "base/log.h"
#include "base/memory.h"
#include "model/insert.h"
#include "model/motion.h"
#include "model/step_clock.h"
#include "run/from_check.h"
#include "run/from_keep.h"
#include "run/state_file.h"
#include "scene/boundary.h"
#include "sim/branch.h"

#include <dirent.h>
#include <fnmatch.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* "DIR@tap=3" in its parts: the folder is cut off at the mark; at is -1 without. */
typedef struct Asked {
    const char *text; /* borrowed */
    char *folder;     /* owned    */
    bool taps;
    double at;       /* taps, or s                                              */
    char moment[64]; /* what the states are called then: "tap_00003"            */
    double time;     /* s, of the step that is nearest                          */
    double step;     /* s                                                       */
} Asked;

static OzStatus take_apart(Asked *asked, const char *text)
{
    char *end = NULL;
    *asked = (Asked){.text = text, .at = -1};
    OZ_PASS(oz_memory_text(&asked->folder, text));
    char *mark = strrchr(asked->folder, '@');
    if (mark && !oz_file_exists(text)) {
        asked->taps = strncmp(mark, "@tap=", 5) == 0;
        const char *number = asked->taps                       ? mark + 5
                             : strncmp(mark, "@time=", 6) == 0 ? mark + 6
                                                               : "";
        asked->at = strtod(number, &end);
        if (!*number || *end || !(asked->at >= 0 && asked->at < 1e12)) {
            return oz_status_fail(
                OZ_ERR_INPUT, "--from %s: expected DIR, DIR@tap=300 or DIR@time=2.5 (in s)", text);
        }
        *mark = '\0';
    }
    for (char *last = asked->folder + strlen(asked->folder);
         last > asked->folder + 1 && last[-1] == '/';) {
        *--last = '\0';
    }
    return OZ_OK;
}

/* The step that is meant, by the scene that ran. */
static OzStatus find_moment(Asked *asked)
{
    OzStatus status = OZ_OK;
    OzScene scene = {0};
    char *path = NULL;
    OZ_TRY(oz_file_join(&path, asked->folder, "scene.yaml"));
    OZ_TRY(oz_scene_load(&scene, path, NULL, 0));
    if (asked->taps && scene.period <= 0) {
        status = oz_status_fail(OZ_ERR_INPUT,
                                "--from %s: that run has no taps; expected @time=", asked->text);
        goto done;
    }
    OzStepClock clock = oz_step_clock_begin(scene.step);
    double time = asked->taps ? asked->at * scene.period : asked->at;
    asked->time = oz_step_clock_time(&clock, oz_step_clock_nearest(&clock, time));
    asked->step = scene.step;
    oz_checkpoint_name(asked->moment, sizeof asked->moment, asked->time, scene.period);
done:
    oz_scene_free(&scene);
    free(path);
    return status;
}

static OzStatus add_file(OzFrom *from, const char *folder, const char *name, OzInputs *inputs)
{
    size_t count = (size_t)from->count;
    OZ_PASS(oz_memory_grow((void **)&from->files, count, count + 1, sizeof *from->files, "states"));
    OzFromFile *file = &from->files[from->count];
    *file = (OzFromFile){0};
    from->count++;
    OZ_PASS(oz_file_join(&file->path, folder, name));
    OZ_PASS(oz_inputs_add(inputs, file->path));
    OZ_PASS(oz_state_file_read(&file->state, file->path));
    OzStateVisit visit = oz_state_load(&file->state);
    return oz_checkpoint_head_state(&file->head, &visit);
}

/* The states in folder/below (NULL: in the folder) whose names are STEM.h5 or, of an ensemble's
 * members, STEM_00000.h5; in their order. */
static OzStatus add_files(OzFrom *from, const char *folder, const char *below, const char *stem,
                          OzInputs *inputs)
{
    OzStatus status = OZ_OK;
    struct dirent **entries = NULL;
    char whole[80], part[80], *path = NULL;
    snprintf(whole, sizeof whole, "%s.h5", stem);
    snprintf(part, sizeof part, "%s_[0-9]*.h5", stem);
    OZ_TRY(below ? oz_file_join(&path, folder, below) : oz_memory_text(&path, folder));
    int count = scandir(path, &entries, NULL, alphasort);
    for (int i = 0; i < count; i++) {
        bool meant =
            strcmp(entries[i]->d_name, whole) == 0 || fnmatch(part, entries[i]->d_name, 0) == 0;
        status =
            status == OZ_OK && meant ? add_file(from, path, entries[i]->d_name, inputs) : status;
        free(entries[i]);
    }
done:
    free(entries);
    free(path);
    return status;
}

static void free_last(OzFromMember *last)
{
    free(last->name);
    oz_grains_free(&last->grains);
    oz_scene_free(&last->scene);
    *last = (OzFromMember){0};
}

static void free_file(OzFromFile *file)
{
    oz_state_free(&file->state);
    oz_checkpoint_head_free(&file->head);
    free(file->path);
}

/* Of the newest states those that are of another moment go. */
static void drop_others(OzFrom *from, const Asked *asked)
{
    int kept = 0;
    for (int i = 0; i < from->count; i++) {
        const OzCheckpointHead *head = &from->files[i].head;
        if (!head->settles && fabs(head->time - asked->time) <= 0.5 * asked->step) {
            from->files[kept++] = from->files[i];
        } else {
            free_file(&from->files[i]);
        }
    }
    from->count = kept;
}

static OzStatus add_all(OzFrom *from, const Asked *asked, const char *folder, OzInputs *inputs)
{
    if (asked->at < 0) {
        return add_files(from, folder, NULL, "state", inputs);
    }
    OZ_PASS(add_files(from, folder, "checkpoints", asked->moment, inputs));
    if (from->count == 0) {
        OZ_PASS(add_files(from, folder, NULL, "state", inputs));
        drop_others(from, asked);
    }
    return OZ_OK;
}

/* A member's folder has no states of its own: they are in that of its ensemble. */
static OzStatus add_of_ensemble(OzFrom *from, const Asked *asked, OzInputs *inputs)
{
    OzStatus status = OZ_OK;
    char *parent = NULL;
    char *slash = strrchr(asked->folder, '/');
    const char *name = slash ? slash + 1 : asked->folder;
    OZ_TRY(oz_memory_text(&parent, slash ? asked->folder : "."));
    if (slash) {
        parent[slash == asked->folder ? 1 : slash - asked->folder] = '\0';
    }
    OZ_TRY(add_all(from, asked, parent, inputs));
    OZ_TRY(oz_memory_text(&from->only, name));
done:
    free(parent);
    return status;
}

/* Moments that are there, in words. */
static void tell_kept(const char *folder, char *text, size_t size)
{
    struct dirent **entries = NULL;
    char *path = NULL;
    size_t used = 0;
    *text = '\0';
    int count = oz_file_join(&path, folder, "checkpoints") == OZ_OK
                    ? scandir(path, &entries, NULL, alphasort)
                    : 0;
    for (int i = 0; i < count; i++) {
        const char *name = entries[i]->d_name;
        if (fnmatch("*.h5", name, FNM_PERIOD) == 0 && used < size) {
            used += (size_t)snprintf(text + used, size - used, "%s%.*s", used ? ", " : "",
                                     (int)(strlen(name) - strlen(".h5")), name);
        }
        free(entries[i]);
    }
    free(entries);
    free(path);
}

static OzStatus refuse_nothing(const Asked *asked)
{
    char kept[512];
    if (asked->at < 0) {
        return oz_status_fail(OZ_ERR_INPUT,
                              "--from %s: there is no state.h5; expected the folder of a run, or "
                              "of a member of one, that has ended or was stopped",
                              asked->text);
    }
    tell_kept(asked->folder, kept, sizeof kept);
    return oz_status_fail(OZ_ERR_INPUT,
                          "--from %s: there is no state %s; expected one of those kept in "
                          "%s/checkpoints (%s), by checkpoint.taps or times of that run's scene",
                          asked->text, asked->moment, asked->folder, kept[0] ? kept : "none");
}

OzStatus oz_from_open(OzFrom *from, const char *text, OzInputs *inputs)
{
    OzStatus status = OZ_OK;
    Asked asked = {0};
    OZ_TRY(take_apart(&asked, text));
    OZ_TRY(oz_memory_text(&from->asked, text));
    if (asked.at >= 0) {
        OZ_TRY(find_moment(&asked));
    }
    OZ_TRY(add_all(from, &asked, asked.folder, inputs));
    if (from->count == 0) {
        OZ_TRY(add_of_ensemble(from, &asked, inputs));
    }
    if (from->count == 0) {
        status = refuse_nothing(&asked);
    }
done:
    free(asked.folder);
    return status;
}

void oz_from_free(OzFrom *from)
{
    free_last(&from->last);
    for (int i = 0; i < from->count; i++) {
        free_file(&from->files[i]);
    }
    free(from->files);
    free(from->only);
    free(from->asked);
    *from = (OzFrom){0};
}

/* What a state says of a member, which the caller frees. */
static OzStatus read_text(OzFromFile *file, int index, const char *name, char **text)
{
    OzStateVisit visit = oz_state_load(&file->state);
    snprintf(visit.path, sizeof visit.path, "worker/member_%d/outputs/", index);
    *text = NULL;
    return oz_state_text(&visit, name, text);
}

/* One that a guard has stopped is no beginning. */
static OzStatus check_sound(const OzFromMember *member)
{
    char name[80];
    snprintf(name, sizeof name, "worker/sim/batch/member_%d/stopped", member->index);
    const OzStateEntry *stopped = oz_state_find(&member->file->state, name);
    return stopped && stopped->count > 0
               ? oz_status_fail(OZ_ERR_INPUT,
                                "%s: %s was stopped there: %.*s; expected a member that was not",
                                member->file->path, member->name ? member->name : "the run",
                                (int)stopped->count, (const char *)stopped->data)
               : OZ_OK;
}

/* Its scene as it ran, and its grains. */
static OzStatus load_member(OzFromMember *member)
{
    OzStatus status = OZ_OK;
    char *text = NULL;
    OZ_PASS(check_sound(member));
    OzStateVisit visit = oz_state_load(&member->file->state);
    OZ_TRY(read_text(member->file, member->index, "scene", &text));
    OZ_TRY(oz_scene_parse(&member->scene, member->file->path, text ? text : "", NULL, 0));
    snprintf(visit.path, sizeof visit.path, "worker/sim/member_%d/", member->index);
    OZ_TRY(oz_motion_state(&member->scene, &visit));
    OZ_TRY(oz_insert_grains(&member->grains, &member->scene));
done:
    free(text);
    return status;
}

/* The member of that name; found->file stays NULL where there is none. */
static OzStatus find_named(OzFrom *from, const char *name, OzFromMember *found)
{
    for (int f = 0; f < from->count && !found->file; f++) {
        for (int i = 0; i < from->files[f].head.count && !found->file; i++) {
            OZ_PASS(read_text(&from->files[f], i, "name", &found->name));
            if (strcmp(found->name ? found->name : "", name) == 0) {
                found->file = &from->files[f];
                found->index = i;
            } else {
                free(found->name);
                found->name = NULL;
            }
        }
    }
    return OZ_OK;
}

static OzStatus refuse_member(OzFrom *from, const char *name, const char *by_seed)
{
    char there[512] = "";
    size_t used = 0;
    for (int f = 0; f < from->count; f++) {
        for (int i = 0; i < from->files[f].head.count && used < sizeof there; i++) {
            char *text = NULL;
            OZ_PASS(read_text(&from->files[f], i, "name", &text));
            used += (size_t)snprintf(there + used, sizeof there - used, "%s%s", used ? ", " : "",
                                     text ? text : "");
            free(text);
        }
    }
    return oz_status_fail(OZ_ERR_INPUT,
                          "--from %s: there is no member %s%s%s; expected one of those there, as "
                          "by --from DIR/MEMBER or --seeds: %s",
                          from->asked, name, name[0] && by_seed[0] ? " or " : "", by_seed, there);
}

OzStatus oz_from_find(OzFrom *from, const char *name, uint64_t seed, const OzFromMember **found)
{
    OzStatus status = OZ_OK;
    OzFromMember member = {0};
    char by_seed[40] = "";
    name = from->only ? from->only : name ? name : "";
    if (!from->only) {
        snprintf(by_seed, sizeof by_seed, "seed_%05" PRIu64, seed);
        OZ_TRY(find_named(from, "", &member)); /* of a plain run */
    }
    if (!member.file) {
        OZ_TRY(find_named(from, name, &member));
    }
    if (!member.file && by_seed[0]) {
        OZ_TRY(find_named(from, by_seed, &member));
    }
    if (!member.file) {
        return refuse_member(from, name, by_seed);
    }
    if (member.file != from->last.file || member.index != from->last.index) {
        OZ_TRY(load_member(&member));
        free_last(&from->last);
        from->last = member;
        member = (OzFromMember){0};
    }
    *found = &from->last;
done:
    free_last(&member);
    return status;
}

bool oz_from_is_single(const OzFrom *from)
{
    return from->only || (from->count == 1 && from->files[0].head.count == 1);
}

OzStatus oz_from_check(OzFrom *from, const char *name, const OzScene *scene, const OzGrains *grains)
{
    const OzFromMember *member = NULL;
    if (!from->asked) {
        return OZ_OK;
    }
    OZ_PASS(oz_from_find(from, name, scene->seed, &member));
    return oz_from_check_scene(member, scene, grains);
}

/* What one worker's members begin with; their folders say so. */
static OzStatus find_sources(OzFrom *from, const OzWorker *worker, OzBranchSource *sources)
{
    for (int64_t m = 0; m < worker->member_count; m++) {
        OzOutputs *member = worker->members[m];
        const OzFromMember *found = NULL;
        OZ_PASS(oz_from_find(from, member->name, member->scene.seed, &found));
        const OzCheckpointHead *head = &found->file->head;
        double strain = oz_boundary_strain(&found->scene.boundary, head->time, head->settles);
        sources[m] = (OzBranchSource){&found->file->state, "worker/", found->index, strain};
        member->scene.boundary.strain = strain;
        if (worker->is_ensemble) {
            OZ_PASS(oz_from_keep_note(from, found, member->folder));
            oz_log_line("%s begins with %s%s%s, step %lld%s", member->name, found->file->path,
                        found->name && found->name[0] ? ", " : "", found->name ? found->name : "",
                        (long long)found->file->head.step,
                        found->file->head.settles ? " of settling" : "");
        }
    }
    return OZ_OK;
}

static OzStatus begin_worker(OzFrom *from, OzWorker *worker)
{
    OzStatus status = OZ_OK;
    OzBranchSource *sources = NULL;
    OZ_TRY(OZ_NEW(&sources, worker->member_count));
    OZ_TRY(find_sources(from, worker, sources));
    OZ_TRY(oz_branch_take(worker->sim, sources));
done:
    free(sources);
    return status;
}

OzStatus oz_from_begin(OzFrom *from, OzWorker *workers, int count)
{
    for (int k = 0; from->asked && k < count; k++) {
        OZ_PASS(begin_worker(from, &workers[k]));
    }
    if (from->asked && !workers[0].is_ensemble) {
        const OzCheckpointHead *head = &from->last.file->head;
        oz_log_line("grains are those of %s, step %lld (%.9g s)%s", from->last.file->path,
                    (long long)head->step, head->time, head->settles ? " of settling" : "");
    }
    return OZ_OK;
}
