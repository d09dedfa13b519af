/* The thread that draws and its queue. Knows no GL and no libav: those are the gallery's. */
#include "draw/studio.h"

#include "base/clock.h"
#include "base/memory.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

/* Copies that wait take no more than this, but one may always wait, bytes. */
static const double WAITING_MOST = 64e6;

/* A picture to draw, or with purpose 0 a gallery to finish. */
typedef struct Job {
    OzGallery *gallery;
    OzSnapshot snapshot;
    int purpose;
} Job;

struct OzStudio {
    pthread_t thread;
    bool started, closing;
    pthread_mutex_t lock;   /* of everything below, but for the renderer */
    pthread_cond_t changed; /* the queue, or closing */
    Job jobs[OZ_STUDIO_JOBS];
    int first, count; /* the job in hand is still counted */
    OzStatus failure; /* the first, with its text */
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

/* The oldest job, which stays in the queue; NULL when there is no more to come. */
static Job *take(OzStudio *studio)
{
    pthread_mutex_lock(&studio->lock);
    while (studio->count == 0 && !studio->closing) {
        pthread_cond_wait(&studio->changed, &studio->lock);
    }
    Job *job = studio->count > 0 ? &studio->jobs[studio->first] : NULL;
    pthread_mutex_unlock(&studio->lock);
    return job;
}

/* Takes the job in hand out of the queue. */
static void put_away(OzStudio *studio, Job *job, OzStatus status)
{
    oz_snapshot_free(&job->snapshot);
    pthread_mutex_lock(&studio->lock);
    if (status != OZ_OK && studio->failure == OZ_OK) {
        studio->failure = status;
        snprintf(studio->text, sizeof studio->text, "%s", oz_status_text());
    }
    studio->first = (studio->first + 1) % OZ_STUDIO_JOBS;
    studio->count--;
    pthread_cond_broadcast(&studio->changed);
    pthread_mutex_unlock(&studio->lock);
}

static OzStatus finish(OzStudio *studio, OzGallery *gallery)
{
    double drawing = 0, encoding = 0, start = oz_clock_now();
    oz_gallery_times(gallery, &drawing, &encoding);
    OzStatus status = oz_gallery_finish(gallery);
    pthread_mutex_lock(&studio->lock);
    studio->times.drawing += drawing;
    studio->times.encoding += encoding + oz_clock_now() - start;
    pthread_mutex_unlock(&studio->lock);
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

/* Waits until there is no more than this in the queue; fails with what failed so far. */
static OzStatus wait_until(OzStudio *studio, int count)
{
    pthread_mutex_lock(&studio->lock);
    while (studio->count > count) {
        pthread_cond_wait(&studio->changed, &studio->lock);
    }
    OzStatus failure = studio->failure;
    pthread_mutex_unlock(&studio->lock);
    return failure == OZ_OK ? OZ_OK : oz_status_fail(failure, "%s", studio->text);
}

/* There is room: only the calling thread fills the queue. */
static void push(OzStudio *studio, const Job *job)
{
    pthread_mutex_lock(&studio->lock);
    studio->jobs[(studio->first + studio->count) % OZ_STUDIO_JOBS] = *job;
    studio->count++;
    pthread_cond_broadcast(&studio->changed);
    pthread_mutex_unlock(&studio->lock);
}

static int jobs_before(const OzSnapshot *snapshot)
{
    double bytes = 16.0 * sizeof(double) * (double)snapshot->count; /* the arrays of a snapshot */
    double most = WAITING_MOST / (bytes + 1);
    return most < 2 ? 1 : most < OZ_STUDIO_JOBS ? (int)most - 1 : OZ_STUDIO_JOBS - 1;
}

OzStatus oz_studio_add(OzStudio *studio, OzGallery *gallery, const OzSnapshot *snapshot,
                       int purpose)
{
    OzStatus status = OZ_OK;
    Job job = {.gallery = gallery, .purpose = purpose};
    double begin = oz_clock_now();
    OZ_TRY(start(studio));
    OZ_TRY(wait_until(studio, jobs_before(snapshot)));
    OZ_TRY(oz_snapshot_copy(&job.snapshot, snapshot));
    push(studio, &job);
done:
    pthread_mutex_lock(&studio->lock);
    studio->times.waited += oz_clock_now() - begin;
    pthread_mutex_unlock(&studio->lock);
    return status;
}

OzStatus oz_studio_finish(OzStudio *studio, OzGallery *gallery)
{
    Job job = {.gallery = gallery};
    if (!studio || !gallery) {
        return OZ_OK;
    }
    if (!studio->started) {
        return oz_gallery_finish(gallery);
    }
    (void)wait_until(studio, OZ_STUDIO_JOBS - 1); /* its failure is told below */
    push(studio, &job);
    return wait_until(studio, 0);
}

OzStudioTimes oz_studio_take_times(OzStudio *studio)
{
    pthread_mutex_lock(&studio->lock);
    OzStudioTimes times = studio->times;
    memset(&studio->times, 0, sizeof studio->times);
    pthread_mutex_unlock(&studio->lock);
    return times;
}

void oz_studio_free(OzStudio *studio)
{
    if (!studio) {
        return;
    }
    pthread_mutex_lock(&studio->lock);
    studio->closing = true;
    pthread_cond_broadcast(&studio->changed);
    pthread_mutex_unlock(&studio->lock);
    if (studio->started) {
        pthread_join(studio->thread, NULL);
    }
    pthread_cond_destroy(&studio->changed);
    pthread_mutex_destroy(&studio->lock);
    free(studio);
}
