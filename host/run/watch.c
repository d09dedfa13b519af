/* inotify, and a poll beside it. */
#include "run/watch.h"

#include "base/interrupt.h"
#include "base/log.h"
#include "base/memory.h"
#include "base/thread.h"

#include <errno.h>
#include <poll.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/eventfd.h>
#include <sys/inotify.h>
#include <sys/stat.h>
#include <unistd.h>

enum {
    LOOK_EVERY = 500, /* ms, where inotify sees nothing                             */
    QUIET = 10,       /* ms without an event, after which an editor is done writing */
    FILES = 2
};

/* Microseconds after which what could not be read is tried again: editors that truncate first write
 * within milliseconds. */
static const useconds_t AGAIN = 200000;

/* By which a file that has changed is told. */
typedef struct Stamp {
    dev_t device;
    ino_t inode;
    off_t size;
    struct timespec changed;
} Stamp;

struct OzWatch {
    pthread_t thread;
    OzReload *reload;
    char *paths[FILES]; /* NULL: there is none */
    Stamp stamps[FILES];
    int notify, end; /* descriptors; notify -1: there is no inotify */
};

static Stamp stamp_of(const char *path)
{
    struct stat info;
    Stamp stamp = {0};
    if (path && stat(path, &info) == 0) {
        stamp.device = info.st_dev;
        stamp.inode = info.st_ino;
        stamp.size = info.st_size;
        stamp.changed = info.st_mtim;
    }
    return stamp;
}

static bool is_same(const Stamp *a, const Stamp *b)
{
    return a->device == b->device && a->inode == b->inode && a->size == b->size &&
           a->changed.tv_sec == b->changed.tv_sec && a->changed.tv_nsec == b->changed.tv_nsec;
}

/* Notes how the files are now; whether that is news. */
static bool look(OzWatch *watch)
{
    bool news = false;
    for (int i = 0; i < FILES; i++) {
        Stamp now = stamp_of(watch->paths[i]);
        news |= !is_same(&now, &watch->stamps[i]);
        watch->stamps[i] = now;
    }
    return news;
}

static void add_folder(const OzWatch *watch, const char *path)
{
    char *folder = path ? strdup(path) : NULL, *slash = folder ? strrchr(folder, '/') : NULL;
    if (folder) {
        if (slash) {
            slash[slash == folder] = '\0';
        }
        inotify_add_watch(watch->notify, slash ? folder : ".",
                          IN_CLOSE_WRITE | IN_MODIFY | IN_MOVED_TO | IN_CREATE | IN_DELETE |
                              IN_MOVED_FROM);
    }
    free(folder);
}

void oz_watch_read(OzReload *reload)
{
    char message[4096];
    bool taken = oz_reload_read(reload, message, sizeof message);
    if (!taken) {
        usleep(AGAIN);
        taken = oz_reload_read(reload, message, sizeof message);
    }
    if (!taken) {
        oz_log_line("%s; the run goes on as it was", message);
    }
    if (message[0]) {
        oz_reload_announce(reload, taken, message);
    }
}

/* Waits for an event or the time to look; false: it is over. */
static bool wait_for(const OzWatch *watch, int milliseconds, bool *any)
{
    struct pollfd files[] = {{watch->end, POLLIN, 0}, {watch->notify, POLLIN, 0}};
    char events[4096];
    int ready = poll(files, watch->notify >= 0 ? 2 : 1, milliseconds);
    *any = ready > 0 && files[1].revents & POLLIN && read(watch->notify, events, sizeof events) > 0;
    return !(files[0].revents & POLLIN);
}

static void *work(void *argument)
{
    OzWatch *watch = argument;
    bool any = false;
    oz_watch_read(watch->reload); /* what was saved since the scene was loaded */
    while (wait_for(watch, LOOK_EVERY, &any)) {
        while (any) { /* an editor's writes come in several */
            if (!wait_for(watch, QUIET, &any)) {
                return NULL;
            }
        }
        if (look(watch)) {
            oz_watch_read(watch->reload);
        }
    }
    return NULL;
}

OzStatus oz_watch_start(OzWatch **out, OzReload *reload, const OzScene *scene)
{
    OzStatus status = OZ_OK;
    OzWatch *watch = NULL;
    const char *paths[FILES] = {scene->path, scene->base};
    *out = NULL;
    OZ_TRY(OZ_NEW(&watch, 1));
    watch->reload = reload;
    watch->notify = inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
    watch->end = eventfd(0, EFD_CLOEXEC);
    for (int i = 0; i < FILES; i++) {
        OZ_TRY(oz_memory_text(&watch->paths[i], paths[i]));
        if (watch->notify >= 0) {
            add_folder(watch, paths[i]);
        }
    }
    look(watch);
    int code = watch->end < 0 ? errno : oz_thread_start(&watch->thread, work, watch);
    if (code != 0) {
        status = oz_status_fail(OZ_ERR_MEMORY, "cannot watch %s: %s", scene->path, strerror(code));
        goto done;
    }
    *out = watch;
    return OZ_OK;
done:
    if (watch) {
        for (int i = 0; i < FILES; i++) {
            free(watch->paths[i]);
        }
        if (watch->notify >= 0) {
            close(watch->notify);
        }
        if (watch->end >= 0) {
            close(watch->end);
        }
    }
    free(watch);
    return status;
}

void oz_watch_end(OzWatch *watch)
{
    if (!watch) {
        return;
    }
    eventfd_write(watch->end, 1);
    pthread_join(watch->thread, NULL);
    close(watch->end);
    if (watch->notify >= 0) {
        close(watch->notify);
    }
    for (int i = 0; i < FILES; i++) {
        free(watch->paths[i]);
    }
    free(watch);
}
