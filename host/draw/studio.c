/* The thread that draws and its queue. Knows no GL and no libav: those are the gallery's. */
#include "draw/studio.h"

#include "base/clock.h"
#include "base/memory.h"

#include <math.h>
#include <pthread.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

/* Copies in the queue take no more than this, unless two do, bytes. */
static const double WAITING_MOST = 64e6;

/* A picture to draw, or with purpose 0 a gallery to finish. */
typedef struct Job {
    OzGallery *gallery;
    OzSnapshot snapshot;
    int purpose;
} Job;

struct OzStudio {
    pthread_t thread;
    pthread_mutex_t lock;   /* of everything below, but for the renderer */
    pthread_cond_t changed; /* what was added or done, or closing */
    bool started, closing;
    Job jobs[OZ_STUDIO_JOBS]; /* number n is in place n % OZ_STUDIO_JOBS */
    int64_t added, done;      /* so many so far; the difference waits or is in hand */
    OzStatus failure;         /* the first, with its text */
    char text[2048];
    OzStudioTimes times;
    OzRenderer *renderer; /* of the thread alone */
};

OzStatus oz_studio_create(OzStudio **studio)
{
    OzStatus status = OZ_NEW(studio, 1);
    if (status == OZ_OK) {
        pthread_mutex_init(&(*studio)->lock, NULL);
        pthread_cond_init(&(*studio)->changed, NULL);
    }
    return status;
}

OzRenderer **oz_studio_renderer(OzStudio *studio)
{
    return &studio->renderer;
}

static void lock(OzStudio *studio)
{
    pthread_mutex_lock(&studio->lock);
}

static void unlock(OzStudio *studio)
{
    pthread_mutex_unlock(&studio->lock);
}

/* The oldest job, which stays in its place; NULL when there is no more to come. */
static Job *take(OzStudio *studio)
{
    lock(studio);
    while (studio->added == studio->done && !studio->closing) {
        pthread_cond_wait(&studio->changed, &studio->lock);
    }
    bool any = studio->added > studio->done;
    Job *job = any ? &studio->jobs[studio->done % OZ_STUDIO_JOBS] : NULL;
    unlock(studio);
    return job;
}

/* Gives up the place of the job in hand. */
static void put_away(OzStudio *studio, Job *job, OzStatus status)
{
    oz_snapshot_free(&job->snapshot);
    lock(studio);
    if (status != OZ_OK && studio->failure == OZ_OK) {
        studio->failure = status;
        snprintf(studio->text, sizeof studio->text, "%s", oz_status_text());
    }
    studio->done++;
    pthread_cond_broadcast(&studio->changed);
    unlock(studio);
}

static OzStatus finish(OzStudio *studio, OzGallery *gallery)
{
    double drawing = 0, encoding = 0, start = oz_clock_now();
    oz_gallery_times(gallery, &drawing, &encoding);
    OzStatus status = oz_gallery_finish(gallery);
    lock(studio);
    studio->times.drawing += drawing;
    studio->times.encoding += encoding + oz_clock_now() - start;
    unlock(studio);
    return status;
}

static void *work(void *argument)
{
    OzStudio *studio = argument;
    /* The simulation goes first: it waits for pictures only when the queue is full, and then leaves
     * its cores to them. GL's and the encoder's own threads inherit this. */
    setpriority(PRIO_PROCESS, (id_t)gettid(), 10);
    for (Job *job = take(studio); job; job = take(studio)) {
        OzStatus status = OZ_OK;
        if (job->purpose == 0) {
            status = finish(studio, job->gallery);
        } else if (studio->failure == OZ_OK) { /* which this thread alone writes */
            status = oz_gallery_add(job->gallery, &job->snapshot, job->purpose);
        }
        put_away(studio, job, status);
    }
    oz_renderer_free(studio->renderer);
    return NULL;
}

/* This and what follows down to wait_for_all want the lock held. */
static OzStatus start(OzStudio *studio)
{
    int code = studio->started ? 0 : pthread_create(&studio->thread, NULL, work, studio);
    if (code != 0) {
        return oz_status_fail(OZ_ERR_MEMORY, "cannot start a thread for pictures: %s",
                              strerror(code));
    }
    studio->started = true;
    return OZ_OK;
}

static OzStatus tell_failure(const OzStudio *studio)
{
    return studio->failure == OZ_OK ? OZ_OK : oz_status_fail(studio->failure, "%s", studio->text);
}

/* Waits while there are this many or more. */
static void push(OzStudio *studio, const Job *job, int most)
{
    while (studio->added - studio->done >= most) {
        pthread_cond_wait(&studio->changed, &studio->lock);
    }
    studio->jobs[studio->added++ % OZ_STUDIO_JOBS] = *job;
    pthread_cond_broadcast(&studio->changed);
}

/* Until all that was added so far is done. */
static void wait_for_all(OzStudio *studio)
{
    int64_t added = studio->added;
    while (studio->done < added) {
        pthread_cond_wait(&studio->changed, &studio->lock);
    }
}

/* How many such snapshots may be in the queue, by the numbers in their arrays. */
static int jobs_most(const OzSnapshot *snapshot)
{
    double words = 16.0 * (double)snapshot->count + 6.0 * (double)snapshot->piece_count;
    double most = fmin(WAITING_MOST / (sizeof(double) * words + 1), OZ_STUDIO_JOBS);
    return most < 2 ? 2 : (int)most;
}

OzStatus oz_studio_add(OzStudio *studio, OzGallery *gallery, const OzSnapshot *snapshot,
                       int purpose)
{
    OzStatus status = OZ_OK;
    Job job = {.gallery = gallery, .purpose = purpose};
    double begin = oz_clock_now();
    lock(studio);
    OZ_TRY(tell_failure(studio));
    OZ_TRY(start(studio));
    OZ_TRY(oz_snapshot_copy(&job.snapshot, snapshot));
    push(studio, &job, jobs_most(snapshot));
done:
    studio->times.waited += oz_clock_now() - begin;
    unlock(studio);
    return status;
}

OzStatus oz_studio_finish(OzStudio *studio, OzGallery *gallery)
{
    Job job = {.gallery = gallery};
    OzStatus status = OZ_OK;
    if (!studio || !gallery) {
        return OZ_OK;
    }
    lock(studio);
    if (studio->started) {
        push(studio, &job, OZ_STUDIO_JOBS);
        wait_for_all(studio);
        status = tell_failure(studio);
    } else {
        status = oz_gallery_finish(gallery);
    }
    unlock(studio);
    return status;
}

OzStudioTimes oz_studio_take_times(OzStudio *studio)
{
    lock(studio);
    OzStudioTimes times = studio->times;
    memset(&studio->times, 0, sizeof studio->times);
    unlock(studio);
    return times;
}

void oz_studio_free(OzStudio *studio)
{
    if (!studio) {
        return;
    }
    lock(studio);
    studio->closing = true;
    pthread_cond_broadcast(&studio->changed);
    unlock(studio);
    if (studio->started) {
        pthread_join(studio->thread, NULL);
    }
    pthread_cond_destroy(&studio->changed);
    pthread_mutex_destroy(&studio->lock);
    free(studio);
}
