/* Requests: judged under one lock, published by a count that workers look at without one. */
#include "run/reload.h"

#include "base/log.h"
#include "base/memory.h"
#include "run/members.h"
#include "scene/changes.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct OzReload {
    const OzOptions *options;
    pthread_mutex_t lock;
    OzScene first;             /* as the run began                                */
    OzScene file;              /* the scene file when it was last taken           */
    OzScene plan;              /* what runs                                       */
    const OzDevice *device;    /* of the group                                    */
    OzOutputs *const *members; /* of the group                                    */
    OzScene *scenes;           /* one a member: what it runs, or will             */
    int64_t count;             /* members                                         */
    int workers;
    OzReloadRequest **requests; /* of the group; NULL once every worker is done    */
    int64_t capacity;
    atomic_llong published; /* requests so far                                 */
    OzReloadListener listener;
};

OzStatus oz_reload_create(OzReload **out, const OzOptions *options, const OzScene *scene)
{
    OzStatus status = OZ_OK;
    OzReload *reload = NULL;
    *out = NULL;
    OZ_TRY(OZ_NEW(&reload, 1));
    reload->options = options;
    pthread_mutex_init(&reload->lock, NULL);
    OZ_TRY(oz_scene_copy(&reload->first, scene));
    OZ_TRY(oz_scene_copy(&reload->plan, scene));
    OZ_TRY(oz_scene_copy(&reload->file, scene));
    *out = reload;
    reload = NULL;
done:
    oz_reload_free(reload);
    return status;
}

static void free_scenes(OzScene *scenes, int64_t count)
{
    for (int64_t m = 0; scenes && m < count; m++) {
        oz_scene_free(&scenes[m]);
    }
    free(scenes);
}

static void free_request(OzReloadRequest *request)
{
    if (request) {
        free_scenes(request->scenes, request->count);
        free(request);
    }
}

void oz_reload_leave(OzReload *reload)
{
    pthread_mutex_lock(&reload->lock);
    for (int64_t i = 0; i < reload->published; i++) {
        free_request(reload->requests[i]);
    }
    free(reload->requests);
    free_scenes(reload->scenes, reload->count);
    reload->requests = NULL;
    reload->capacity = 0;
    reload->scenes = NULL;
    reload->members = NULL;
    reload->count = 0;
    atomic_store(&reload->published, 0);
    pthread_mutex_unlock(&reload->lock);
}

void oz_reload_free(OzReload *reload)
{
    if (!reload) {
        return;
    }
    oz_reload_leave(reload);
    oz_scene_free(&reload->first);
    oz_scene_free(&reload->file);
    oz_scene_free(&reload->plan);
    pthread_mutex_destroy(&reload->lock);
    free(reload);
}

/* This and what follows down to oz_reload_set want the lock held. */
static OzStatus make_room(OzReload *reload)
{
    if (reload->published == reload->capacity) {
        int64_t wanted = reload->capacity ? 2 * reload->capacity : 16;
        OZ_PASS(oz_memory_grow((void **)&reload->requests, (size_t)reload->capacity, (size_t)wanted,
                               sizeof(OzReloadRequest *), "requests"));
        reload->capacity = wanted;
    }
    return OZ_OK;
}

/* One member's next scene, and what it asks of the simulation. */
static OzStatus prepare(const OzReload *reload, int64_t m, char *const *settings, int count,
                        OzScene *next, OzTakeOver *how)
{
    const OzGrains *grains = &reload->members[m]->grains;
    OZ_PASS(oz_scene_change(next, &reload->scenes[m], settings, count));
    OZ_PASS(oz_members_judge_step(next, grains, reload->options->force));
    return oz_take_over_compare(how, reload->device, grains, &reload->scenes[m], next);
}

/* All members' next scenes. */
static OzStatus prepare_all(const OzReload *reload, char *const *settings, int count,
                            OzReloadRequest *request)
{
    OZ_PASS(OZ_NEW(&request->scenes, reload->count));
    request->count = reload->count;
    request->left = reload->workers;
    for (int64_t m = 0; m < reload->count; m++) {
        OzTakeOver how = OZ_TAKE_OVER_APPLY;
        OZ_PASS(prepare(reload, m, settings, count, &request->scenes[m], &how));
        request->how = how == OZ_TAKE_OVER_REBUILD ? how : request->how;
    }
    return OZ_OK;
}

/* From here on nothing can fail. */
static void publish(OzReload *reload, OzReloadRequest *request, OzScene *copies)
{
    free_scenes(reload->scenes, reload->count);
    reload->scenes = copies;
    reload->requests[reload->published] = request;
    atomic_fetch_add(&reload->published, 1);
}

static OzStatus ask_members(OzReload *reload, char *const *settings, int count, bool *rebuilds)
{
    OzStatus status = OZ_OK;
    OzReloadRequest *request = NULL;
    OzScene *copies = NULL;
    if (reload->count == 0) {
        return OZ_OK;
    }
    OZ_TRY(make_room(reload));
    OZ_TRY(OZ_NEW(&request, 1));
    OZ_TRY(prepare_all(reload, settings, count, request));
    OZ_TRY(OZ_NEW(&copies, reload->count));
    for (int64_t m = 0; m < reload->count; m++) {
        OZ_TRY(oz_scene_copy(&copies[m], &request->scenes[m]));
    }
    *rebuilds = request->how == OZ_TAKE_OVER_REBUILD;
    publish(reload, request, copies);
    return OZ_OK;
done:
    free_request(request);
    free_scenes(copies, reload->count);
    return status;
}

static void tell(const OzChanges *changes, bool rebuilds, char *message, size_t size)
{
    size_t used = 0;
    for (int i = 0; i < changes->count && used < size; i++) {
        const OzChange *c = &changes->rows[i];
        used +=
            (size_t)snprintf(message + used, size - used, "%s%s %s -> %s", i ? "; " : "", c->path,
                             c->old[0] ? c->old : "(none)", c->now[0] ? c->now : "(none)");
    }
    if (rebuilds && used < size) {
        snprintf(message + used, size - used, " (once its kernels are built)");
    }
}

static OzStatus set(OzReload *reload, char *const *settings, int count, char *message, size_t size)
{
    OzStatus status = OZ_OK;
    OzScene next = {0};
    OzChanges changes = {0};
    bool rebuilds = false;
    OZ_TRY(oz_scene_change(&next, &reload->plan, settings, count));
    OZ_TRY(oz_changes_find(&changes, &reload->plan, &next));
    if (changes.count > 0) {
        OZ_TRY(ask_members(reload, settings, count, &rebuilds));
        oz_scene_free(&reload->plan);
        reload->plan = next;
        next = (OzScene){0};
        tell(&changes, rebuilds, message, size);
    } else {
        snprintf(message, size, "nothing changes");
    }
done:
    oz_scene_free(&next);
    oz_changes_free(&changes);
    return status;
}

bool oz_reload_set(OzReload *reload, char *const *settings, int count, char *message, size_t size)
{
    message[0] = '\0';
    pthread_mutex_lock(&reload->lock);
    OzStatus status = set(reload, settings, count, message, size);
    pthread_mutex_unlock(&reload->lock);
    if (status != OZ_OK) {
        snprintf(message, size, "%s", oz_status_text());
    }
    return status == OZ_OK;
}

static void free_settings(char **settings, int count)
{
    for (int i = 0; settings && i < count; i++) {
        free(settings[i]);
    }
    free(settings);
}

static OzStatus read_file(OzReload *reload, char *message, size_t size)
{
    OzStatus status = OZ_OK;
    const OzOptions *options = reload->options;
    OzScene next = {0};
    OzChanges changes = {0};
    char **settings = NULL;
    OZ_TRY(oz_scene_reload(&next, &reload->file, options->paths[0], options->settings,
                           options->setting_count));
    OZ_TRY(oz_changes_find(&changes, &reload->file, &next));
    if (changes.count > 0) {
        OZ_TRY(oz_changes_settings(&settings, &changes));
        OZ_TRY(set(reload, settings, changes.count, message, size));
        oz_scene_free(&reload->file);
        reload->file = next;
        next = (OzScene){0};
    }
done:
    free_settings(settings, changes.count);
    oz_changes_free(&changes);
    oz_scene_free(&next);
    return status;
}

bool oz_reload_read(OzReload *reload, char *message, size_t size)
{
    message[0] = '\0';
    pthread_mutex_lock(&reload->lock);
    OzStatus status = read_file(reload, message, size);
    pthread_mutex_unlock(&reload->lock);
    if (status != OZ_OK) {
        snprintf(message, size, "%s", oz_status_text());
    }
    return status == OZ_OK;
}

void oz_reload_listen(OzReload *reload, OzReloadListener listener)
{
    if (reload) {
        reload->listener = listener;
    }
}

void oz_reload_announce(const OzReload *reload, bool applied, const char *message)
{
    if (reload->listener.hear) {
        reload->listener.hear(reload->listener.context, applied, message);
    }
}

OzStatus oz_reload_scene(OzReload *reload, OzScene *copy)
{
    pthread_mutex_lock(&reload->lock);
    OzStatus status = oz_scene_copy(copy, &reload->plan);
    pthread_mutex_unlock(&reload->lock);
    return status;
}

/* What changed before this group began. */
static OzStatus catch_up(OzReload *reload)
{
    OzStatus status = OZ_OK;
    OzChanges changes = {0};
    char **settings = NULL;
    bool rebuilds = false;
    OZ_TRY(oz_changes_find(&changes, &reload->first, &reload->plan));
    OZ_TRY(oz_changes_settings(&settings, &changes));
    if (changes.count > 0) {
        OZ_TRY(ask_members(reload, settings, changes.count, &rebuilds));
    }
done:
    free_settings(settings, changes.count);
    oz_changes_free(&changes);
    return status;
}

OzStatus oz_reload_enter(OzReload *reload, const OzDevice *device, OzOutputs *const *members,
                         int64_t count, int workers)
{
    OzStatus status = OZ_OK;
    pthread_mutex_lock(&reload->lock);
    OZ_TRY(OZ_NEW(&reload->scenes, count));
    reload->count = count;
    for (int64_t m = 0; m < count; m++) {
        OZ_TRY(oz_scene_copy(&reload->scenes[m], &members[m]->scene));
    }
    reload->device = device;
    reload->members = members;
    reload->workers = workers;
    OZ_TRY(catch_up(reload));
done:
    pthread_mutex_unlock(&reload->lock);
    return status;
}

bool oz_reload_waits(const OzReload *reload, int64_t taken)
{
    return reload && atomic_load(&reload->published) > taken;
}

OzReloadRequest *oz_reload_get(OzReload *reload, int64_t taken)
{
    pthread_mutex_lock(&reload->lock);
    OzReloadRequest *request = reload->requests[taken];
    pthread_mutex_unlock(&reload->lock);
    return request;
}

void oz_reload_done(OzReload *reload, int64_t taken)
{
    pthread_mutex_lock(&reload->lock);
    if (--reload->requests[taken]->left == 0) {
        free_request(reload->requests[taken]);
        reload->requests[taken] = NULL;
    }
    pthread_mutex_unlock(&reload->lock);
}

OzStatus oz_reload_withdraw(OzReload *reload, int64_t taken)
{
    OzStatus status = OZ_OK;
    OzChanges changes = {0};
    char **settings = NULL;
    OzScene plan = {0};
    pthread_mutex_lock(&reload->lock);
    for (int64_t i = taken; i < reload->published; i++) {
        free_request(reload->requests[i]);
        reload->requests[i] = NULL;
    }
    atomic_store(&reload->published, taken);
    /* what a member lost is what the plan loses */
    OZ_TRY(oz_changes_find(&changes, &reload->scenes[0], &reload->members[0]->scene));
    OZ_TRY(oz_changes_settings(&settings, &changes));
    OZ_TRY(oz_scene_change(&plan, &reload->plan, settings, changes.count));
    oz_scene_free(&reload->plan);
    reload->plan = plan;
    for (int64_t m = 0; m < reload->count; m++) {
        oz_scene_free(&reload->scenes[m]);
        OZ_TRY(oz_scene_copy(&reload->scenes[m], &reload->members[m]->scene));
    }
done:
    pthread_mutex_unlock(&reload->lock);
    free_settings(settings, changes.count);
    oz_changes_free(&changes);
    return status;
}
