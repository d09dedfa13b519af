/* Members in the order of the plan, those that have begun first. */
#include "run/groups.h"

#include "base/interrupt.h"
#include "base/log.h"
#include "base/memory.h"
#include "run/capacity.h"
#include "run/ensemble_tables.h"
#include "run/protocol.h"
#include "sim/batch_fit.h"

#include <stdlib.h>

static const char *const outcome_names[] = {[OZ_OUTCOME_NOT_STARTED] = "not started",
                                            [OZ_OUTCOME_DONE] = "done",
                                            [OZ_OUTCOME_STOPPED] = "stopped",
                                            [OZ_OUTCOME_INTERRUPTED] = "interrupted",
                                            [OZ_OUTCOME_FAILED] = "failed"};

/* A member of an ensemble that cannot be run: said by name, remembered, and the others go on. */
static void lose(OzGroups *groups, int64_t number, OzStatus why, const char *text)
{
    char *name = NULL;
    groups->outcomes[number] = OZ_OUTCOME_FAILED;
    groups->loss = groups->loss == OZ_OK ? why : groups->loss;
    if (oz_members_name(&groups->plan, number, &name) == OZ_OK) {
        oz_log_line("%s: %s", name, text);
    }
    free(name);
}

/* Whether there is a state of this member to go on from. */
static bool has_begun(const OzGroups *groups, int64_t number)
{
    for (int k = 0; groups->resume && k < groups->resume->count; k++) {
        const OzCheckpointHead *head = &groups->resume->heads[k];
        if (number >= head->first && number < head->first + head->count) {
            return true;
        }
    }
    return false;
}

/* Its scene and grains, which can begin where they shall. */
static OzStatus load_member(OzGroups *groups, OzOutputs *member)
{
    OZ_PASS(oz_members_name(&groups->plan, member->number, &member->name));
    OZ_PASS(oz_members_load(&groups->plan, member->number, &member->scene, &member->grains));
    OZ_PASS(oz_from_check(&groups->plan.from, member->name, &member->scene, &member->grains));
    oz_replay_free(&groups->loaded_replay);
    return groups->options->replay
               ? oz_replay_read(&groups->loaded_replay, groups->options->replay_folder,
                                member->name, groups->options->resumes)
               : oz_protocol_make(&groups->loaded_replay, &member->scene, &member->grains,
                                  groups->options->force, 0);
}

/* Whether there is nothing to do of a member: a state has it, or the run that is repeated never
 * had. */
static OzStatus is_left_out(const OzGroups *groups, int64_t number, bool *left_out)
{
    OzStatus status = OZ_OK;
    char *name = NULL;
    *left_out = has_begun(groups, number);
    if (groups->options->replay && !*left_out) {
        OZ_TRY(oz_members_name(&groups->plan, number, &name));
        *left_out = !oz_replay_has(groups->options->replay_folder, name, groups->options->resumes);
        if (*left_out) {
            oz_log_line("%s had not begun in %s", name, groups->options->replay_folder);
        }
    }
done:
    free(name);
    return status;
}

/* The plan's next member that can be loaded into *loaded; NULL when there is none left. A plain
 * run's one scene must load. */
static OzStatus load_next(OzGroups *groups, OzOutputs **loaded)
{
    OzStatus status = OZ_OK;
    OzOutputs *member = NULL;
    bool left_out = false;
    *loaded = NULL;
    while (!*loaded && groups->loaded_count < groups->plan.count && !oz_interrupt_asked()) {
        OZ_TRY(is_left_out(groups, groups->loaded_count, &left_out));
        if (left_out) {
            groups->loaded_count++;
            continue;
        }
        OZ_TRY(OZ_NEW(&member, 1));
        member->number = groups->loaded_count++;
        OzStatus own = load_member(groups, member);
        if (own == OZ_OK) {
            *loaded = member;
        } else if (groups->plan.is_ensemble) {
            lose(groups, member->number, own, oz_status_text());
            oz_outputs_free(member);
        } else {
            status = own;
            goto done;
        }
        member = NULL;
    }
done:
    oz_outputs_free(member);
    return status;
}

/* How many members like the first are run at a time. */
static OzStatus choose_most(OzGroups *groups)
{
    OzMember first = {&groups->loaded->scene, &groups->loaded->grains};
    double bytes = 0;
    OZ_PASS(oz_capacity_most(groups->options, groups->device, &first, &groups->most, &bytes));
    if (groups->plan.is_ensemble) {
        oz_log_line("%lld members of about %.3g MB; up to %lld at a time",
                    (long long)groups->plan.count, bytes / 1e6, (long long)groups->most);
    }
    groups->most = groups->most < groups->plan.count ? groups->most : groups->plan.count;
    return OZ_OK;
}

OzStatus oz_groups_find(OzGroups *groups, bool *more)
{
    *more = groups->resume && groups->resume->next < groups->resume->count;
    if (*more) {
        return OZ_OK;
    }
    if (!groups->loaded) {
        OZ_PASS(load_next(groups, &groups->loaded));
    }
    *more = groups->loaded != NULL;
    return *more && groups->most == 0 ? choose_most(groups) : OZ_OK;
}

/* Whether a loaded member can go side by side with the group's first. */
static bool joins(const OzGroups *groups, const OzOutputs *member)
{
    const OzOutputs *first = groups->members[0];
    OzMember a = {&first->scene, &first->grains}, b = {&member->scene, &member->grains};
    OzSchedule events = oz_schedule_create(&member->scene, groups->options->until);
    return oz_schedule_agrees(&groups->schedule, &events) &&
           oz_replay_agrees(&groups->replay, &groups->loaded_replay) &&
           oz_batch_fit_agrees(groups->device, &a, &b);
}

/* A scene's end comes first. */
static void warn_of_end(const OzGroups *groups)
{
    double end = groups->members[0]->scene.duration, until = groups->options->until;
    if (until > end * (1 + 1e-9)) {
        oz_log_line("warning: --until %.9g s lies beyond the scene's end, %.9g s, where it ends; "
                    "expected --set time.duration=%.9g, or time.taps",
                    until, end, until);
    }
}

/* The loaded member and those after it that can join it; the one that cannot begins the next group.
 */
static OzStatus gather_new(OzGroups *groups)
{
    groups->members[0] = groups->loaded;
    groups->member_count = 1;
    groups->loaded = NULL;
    oz_replay_free(&groups->replay);
    groups->replay = groups->loaded_replay;
    groups->loaded_replay = (OzReplay){0};
    groups->schedule = oz_schedule_create(&groups->members[0]->scene, groups->options->until);
    warn_of_end(groups);
    OZ_PASS(load_next(groups, &groups->loaded));
    while (groups->loaded && groups->member_count < groups->most && joins(groups, groups->loaded)) {
        groups->members[groups->member_count++] = groups->loaded;
        groups->loaded = NULL;
        OZ_PASS(load_next(groups, &groups->loaded));
    }
    return OZ_OK;
}

int64_t oz_groups_most_workers(const OzGroups *groups)
{
    return groups->device->is_cpu ? groups->device->units : 1;
}

/* The scene's name as the run began, not that of the folder's scene.yaml: pictures show it. */
static OzStatus take_name(OzScene *scene, const char *name)
{
    free(scene->name);
    return oz_memory_text(&scene->name, name);
}

/* What is left to make of the changes of the members of state k, which have them in common, as
 * the first one has them. */
static OzStatus load_begun(OzGroups *groups, int k, const OzOutputs *first)
{
    OzStatus status = OZ_OK;
    const OzCheckpointHead *head = &groups->resume->heads[k];
    char *name = NULL;
    if (!groups->begun) {
        OZ_TRY(OZ_NEW(&groups->begun, groups->resume->count));
    }
    if (!groups->options->replay) {
        return oz_protocol_make(&groups->begun[k], &first->scene, &first->grains,
                                groups->options->force, head->taken);
    }
    OZ_TRY(oz_members_name(&groups->plan, head->first, &name));
    OZ_TRY(oz_replay_read(&groups->begun[k], groups->options->replay_folder, name, true));
    oz_replay_go_on(&groups->begun[k], head->taken, head->step);
done:
    free(name);
    return status;
}

/* Members of the next states, as many states as go side by side. */
static OzStatus gather_begun(OzGroups *groups)
{
    OzResume *resume = groups->resume;
    groups->member_count = 0;
    for (int k = resume->next;
         k < resume->count && k - resume->next < oz_groups_most_workers(groups); k++) {
        const OzCheckpointHead *head = &resume->heads[k];
        int64_t first = groups->member_count;
        for (int64_t i = 0; i < head->count; i++) {
            OzOutputs **member = &groups->members[groups->member_count];
            OZ_PASS(OZ_NEW(member, 1));
            groups->member_count++;
            (*member)->number = head->first + i;
            (*member)->goes_on = true;
            OZ_PASS(oz_members_load(&groups->plan, head->first + i, &(*member)->scene,
                                    &(*member)->grains));
            OZ_PASS(oz_members_name(&groups->plan, head->first + i, &(*member)->name));
            OZ_PASS(take_name(&(*member)->scene, head->name));
        }
        OZ_PASS(load_begun(groups, k, groups->members[first]));
    }
    groups->schedule = oz_schedule_create(&groups->members[0]->scene, groups->options->until);
    warn_of_end(groups);
    return OZ_OK;
}

OzStatus oz_groups_gather(OzGroups *groups)
{
    return groups->resume && groups->resume->next < groups->resume->count ? gather_begun(groups)
                                                                          : gather_new(groups);
}

OzStatus oz_groups_open(OzGroups *groups, const OzOptions *options, OzResume *resume)
{
    *groups = (OzGroups){.options = options, .resume = resume};
    OZ_PASS(oz_members_create(&groups->plan, options));
    if (options->watch && !options->replay && groups->plan.scene.phase_count > 0) {
        return oz_status_fail(OZ_ERR_INPUT,
                              "--watch of a scene with phases, which change it at their times; "
                              "expected --set phases=false with it");
    }
    OZ_PASS(OZ_NEW(&groups->outcomes, groups->plan.count));
    OZ_PASS(OZ_NEW(&groups->members, groups->plan.count));
    return resume ? OZ_OK : load_next(groups, &groups->loaded);
}

void oz_groups_free(OzGroups *groups)
{
    oz_outputs_free(groups->loaded);
    oz_members_free(&groups->plan);
    for (int k = 0; groups->begun && k < groups->resume->count; k++) {
        oz_replay_free(&groups->begun[k]);
    }
    free(groups->begun);
    oz_replay_free(&groups->replay);
    oz_replay_free(&groups->loaded_replay);
    free(groups->members);
    free(groups->outcomes);
    *groups = (OzGroups){0};
}

bool oz_groups_is_begun(const OzGroups *groups)
{
    return groups->member_count > 0 && groups->members[0]->goes_on;
}

bool oz_groups_has_changes(const OzGroups *groups)
{
    return groups->options->replay || groups->plan.scene.phase_count > 0;
}

const OzReplay *oz_groups_replay(const OzGroups *groups, int worker)
{
    if (!oz_groups_has_changes(groups)) {
        return NULL;
    }
    return oz_groups_is_begun(groups) ? &groups->begun[groups->resume->next + worker]
                                      : &groups->replay;
}

int64_t oz_groups_taken(const OzGroups *groups, int worker)
{
    return oz_groups_has_changes(groups) && oz_groups_is_begun(groups)
               ? groups->resume->heads[groups->resume->next + worker].taken
               : 0;
}

OzStatus oz_groups_keep_changes(const OzGroups *groups, const char *folder)
{
    OzStatus status = OZ_OK;
    char *name = NULL;
    for (int64_t i = 0; groups->options->replay && i < groups->plan.count; i++) {
        free(name);
        OZ_TRY(oz_members_name(&groups->plan, i, &name));
        OZ_TRY(oz_replay_keep(groups->options->replay_folder, name, folder));
    }
done:
    free(name);
    return status;
}

OzStatus oz_groups_write_tables(const OzGroups *groups, const char *folder)
{
    OzStatus status = OZ_OK;
    OzEnsemble *ensemble = NULL;
    char *name = NULL;
    bool begun = folder && (groups->most > 0 || groups->resume);
    if (!groups->plan.is_ensemble || !begun) {
        return OZ_OK;
    }
    OZ_TRY(oz_ensemble_tables_create(&ensemble, folder, groups->plan.scene.sweep.key));
    for (int64_t i = 0; i < groups->plan.count; i++) {
        free(name);
        OZ_TRY(oz_members_name(&groups->plan, i, &name));
        OzEnsembleRow row = {name,
                             oz_members_seed(&groups->plan, i),
                             oz_members_value(&groups->plan, i),
                             outcome_names[groups->outcomes[i]],
                             groups->outcomes[i] != OZ_OUTCOME_NOT_STARTED,
                             NULL};
        OZ_TRY(oz_ensemble_tables_add(ensemble, &row));
    }
done:
    free(name);
    OZ_AFTER(status, oz_ensemble_tables_finish(ensemble));
    return status;
}

OzStatus oz_groups_tell_losses(const OzGroups *groups)
{
    int64_t lost = 0;
    for (int64_t i = 0; i < groups->plan.count; i++) {
        lost +=
            groups->outcomes[i] == OZ_OUTCOME_STOPPED || groups->outcomes[i] == OZ_OUTCOME_FAILED;
    }
    return lost == 0 ? OZ_OK
                     : oz_status_fail(groups->loss, "%lld of %lld members did not reach their end",
                                      (long long)lost, (long long)groups->plan.count);
}
