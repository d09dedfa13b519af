/* Changing a run's scene while it runs. A request is one transaction: it is read, checked and
 * compared for every member, and then all members take it, or none; what it says is told at once to
 * whoever asked (a scene file that was edited, a page, a signal), from any thread. Workers take
 * accepted requests between two launches, in order (run/swap.h). */
#pragma once

#include "cli.h"
#include "compute/device.h"
#include "run/outputs.h"
#include "sim/take_over.h"

typedef struct OzReload OzReload;

/* An accepted request. */
typedef struct OzReloadRequest {
    OzScene *scenes; /* one a member of the group; owned by the reload */
    int64_t count;
    OzTakeOver how;
    int left; /* workers that have still to take it */
} OzReloadRequest;

/* For the run of options->paths[0], whose scene, sweep included, is given and copied. The caller
 * frees (NULL is fine) after all threads that use it. */
OzStatus oz_reload_create(OzReload **reload, const OzOptions *options, const OzScene *scene);
void oz_reload_free(OzReload *reload);

/* From now on these members run, shared out among so many workers; they are borrowed until
 * oz_reload_leave. What was changed before they began is their first request. */
OzStatus oz_reload_enter(OzReload *reload, const OzDevice *device, OzOutputs *const *members,
                         int64_t count, int workers);
void oz_reload_leave(OzReload *reload);

/* Sets keys ("contact.friction=0.2", values as YAML; "-key" takes one out): whether all members
 * take it, from the next moment on. message receives what changes, "contact.friction 0.1 -> 0.2",
 * or why not: the running scene goes on as it was. */
bool oz_reload_set(OzReload *reload, char *const *settings, int count, char *message, size_t size);

/* The same with the scene file as it is now, of which only what has changed since it was last taken
 * is set. Nothing to change: true, and an empty message. */
bool oz_reload_read(OzReload *reload, char *message, size_t size);

/* Who shall hear what becomes of changes that it did not ask for itself; set while nobody asks. */
typedef struct OzReloadListener {
    void (*hear)(void *context, bool applied, const char *message); /* NULL: nobody does */
    void *context;
} OzReloadListener;
void oz_reload_listen(OzReload *reload, OzReloadListener listener);

/* Tells the listener; from any thread. */
void oz_reload_announce(const OzReload *reload, bool applied, const char *message);

/* What runs now, sweep included, copied (phases of walls aside); the caller frees. */
OzStatus oz_reload_scene(OzReload *reload, OzScene *copy);

/* Whether there is a request beyond the `taken` first ones of this group; costs nothing. The
 * request itself, which stays until every worker has said that it is done with it. */
bool oz_reload_waits(const OzReload *reload, int64_t taken);
OzReloadRequest *oz_reload_get(OzReload *reload, int64_t taken);
void oz_reload_done(OzReload *reload, int64_t taken);

/* A request that was accepted cannot be carried out after all (a program that does not build): what
 * runs is what the members' outputs have, later requests are dropped. */
OzStatus oz_reload_withdraw(OzReload *reload, int64_t taken);
