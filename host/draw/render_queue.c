/* The thread that draws and its queue. Knows no GL and no libav: those are the pictures'. */
#include "draw/render_queue.h"

#include "base/clock.h"
#include "base/memory.h"
#include "base/thread.h"

#include <math.h>
#include <pthread.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

/* Copies in the queue take no more than this, unless two do, bytes. */
static const double WAITING_MOST = 64e6;

enum { ROOM = 2 * OZ_RENDER_QUEUE_JOBS }; /* pictures, and what need not wait for them */

/* What is to be done with pictures. */
typedef struct Job {
    OzPictures *pictures;
    enum { DRAW, TAKE, FINISH } kind;
    OzSnapshot snapshot; /* to draw, for this purpose */
    int purpose;
    OzScene scene; /* to take, with this caption */
    char caption[200];
} Job;

struct OzRenderQueue {
    pthread_t thread;
    pthread_mutex_t lock;   /* of everything below, but for the renderer */
    pthread_cond_t changed; /* what was added or done, or closing */
    bool started, closing;
    Job jobs[ROOM];      /* number n is in place n % ROOM */
    int64_t added, done; /* so many so far; the difference waits or is in hand */
    OzStatus failure;    /* the first, with its text */
    char text[2048];
    OzRenderQueueTimes times;
    OzRenderer *renderer; /* of the thread alone */
    OzLive live;
};

OzStatus oz_render_queue_create(OzRenderQueue **render_queue)
{
    OzStatus status = OZ_NEW(render_queue, 1);
    if (status == OZ_OK) {
        pthread_mutex_init(&(*render_queue)->lock, NULL);
        pthread_cond_init(&(*render_queue)->changed, NULL);
    }
    return status;
}

OzRenderer **oz_render_queue_renderer(OzRenderQueue *render_queue)
{
    return &render_queue->renderer;
}

OzLive *oz_render_queue_live(OzRenderQueue *render_queue)
{
    return &render_queue->live;
}

static void lock(OzRenderQueue *render_queue)
{
    pthread_mutex_lock(&render_queue->lock);
}

static void unlock(OzRenderQueue *render_queue)
{
    pthread_mutex_unlock(&render_queue->lock);
}

/* The oldest job, which stays in its place; NULL when there is no more to come. */
static Job *take(OzRenderQueue *render_queue)
{
    lock(render_queue);
    while (render_queue->added == render_queue->done && !render_queue->closing) {
        pthread_cond_wait(&render_queue->changed, &render_queue->lock);
    }
    bool any = render_queue->added > render_queue->done;
    Job *job = any ? &render_queue->jobs[render_queue->done % ROOM] : NULL;
    unlock(render_queue);
    return job;
}

/* Gives up the place of the job in hand. */
static void put_away(OzRenderQueue *render_queue, Job *job, OzStatus status)
{
    oz_snapshot_free(&job->snapshot);
    oz_scene_free(&job->scene);
    lock(render_queue);
    if (status != OZ_OK && render_queue->failure == OZ_OK) {
        render_queue->failure = status;
        snprintf(render_queue->text, sizeof render_queue->text, "%s", oz_status_text());
    }
    render_queue->done++;
    pthread_cond_broadcast(&render_queue->changed);
    unlock(render_queue);
}

static OzStatus finish(OzRenderQueue *render_queue, OzPictures *pictures)
{
    double drawing = 0, encoding = 0, start = oz_clock_now();
    oz_pictures_times(pictures, &drawing, &encoding);
    OzStatus status = oz_pictures_finish(pictures);
    lock(render_queue);
    render_queue->times.drawing += drawing;
    render_queue->times.encoding += encoding + oz_clock_now() - start;
    unlock(render_queue);
    return status;
}

static OzStatus serve(OzRenderQueue *render_queue, Job *job)
{
    if (job->kind == FINISH) {
        return finish(render_queue, job->pictures);
    }
    if (render_queue->failure != OZ_OK) { /* which this thread alone writes */
        return OZ_OK;
    }
    if (job->kind == TAKE) {
        oz_pictures_take(job->pictures, &job->scene, job->caption);
        return OZ_OK;
    }
    OzStatus status = oz_pictures_add(job->pictures, &job->snapshot, job->purpose);
    if (status != OZ_OK && job->purpose == OZ_PICTURES_LIVE) { /* is nobody's result */
        oz_live_fail(&render_queue->live);
        return OZ_OK;
    }
    return status;
}

static void *work(void *argument)
{
    OzRenderQueue *render_queue = argument;
    /* The simulation goes first: it waits for pictures only when the queue is full, and then leaves
     * its cores to them. GL's and the encoder's own threads inherit this. */
    setpriority(PRIO_PROCESS, (id_t)gettid(), 10);
    for (Job *job = take(render_queue); job; job = take(render_queue)) {
        put_away(render_queue, job, serve(render_queue, job));
    }
    oz_renderer_free(render_queue->renderer);
    return NULL;
}

/* This and what follows down to wait_for_all want the lock held. */
static OzStatus start(OzRenderQueue *render_queue)
{
    int code =
        render_queue->started ? 0 : oz_thread_start(&render_queue->thread, work, render_queue);
    if (code != 0) {
        return oz_status_fail(OZ_ERR_MEMORY, "cannot start a thread for pictures: %s",
                              strerror(code));
    }
    render_queue->started = true;
    return OZ_OK;
}

static OzStatus tell_failure(const OzRenderQueue *render_queue)
{
    return render_queue->failure == OZ_OK
               ? OZ_OK
               : oz_status_fail(render_queue->failure, "%s", render_queue->text);
}

/* Waits while there are this many or more. */
static void push(OzRenderQueue *render_queue, const Job *job, int most)
{
    while (render_queue->added - render_queue->done >= most) {
        pthread_cond_wait(&render_queue->changed, &render_queue->lock);
    }
    render_queue->jobs[render_queue->added++ % ROOM] = *job;
    pthread_cond_broadcast(&render_queue->changed);
}

/* Until all that was added so far is done. */
static void wait_for_all(OzRenderQueue *render_queue)
{
    int64_t added = render_queue->added;
    while (render_queue->done < added) {
        pthread_cond_wait(&render_queue->changed, &render_queue->lock);
    }
}

/* How many such snapshots may be in the queue, by the numbers in their arrays. */
static int jobs_most(const OzSnapshot *snapshot)
{
    double words = 16.0 * (double)snapshot->count + 6.0 * (double)snapshot->element_count;
    double most = fmin(WAITING_MOST / (sizeof(double) * words + 1), OZ_RENDER_QUEUE_JOBS);
    return most < 2 ? 2 : (int)most;
}

OzStatus oz_render_queue_add(OzRenderQueue *render_queue, OzPictures *pictures,
                             const OzSnapshot *snapshot, int purpose)
{
    OzStatus status = OZ_OK;
    Job job = {.pictures = pictures, .kind = DRAW, .purpose = purpose};
    double begin = oz_clock_now();
    lock(render_queue);
    OZ_TRY(tell_failure(render_queue));
    OZ_TRY(start(render_queue));
    OZ_TRY(oz_snapshot_copy(&job.snapshot, snapshot));
    push(render_queue, &job, jobs_most(snapshot));
done:
    render_queue->times.waited += oz_clock_now() - begin;
    unlock(render_queue);
    return status;
}

OzStatus oz_render_queue_finish(OzRenderQueue *render_queue, OzPictures *pictures)
{
    Job job = {.pictures = pictures, .kind = FINISH};
    OzStatus status = OZ_OK;
    if (!render_queue || !pictures) {
        return OZ_OK;
    }
    lock(render_queue);
    if (render_queue->started) {
        push(render_queue, &job, ROOM);
        wait_for_all(render_queue);
        status = tell_failure(render_queue);
    } else {
        status = oz_pictures_finish(pictures);
    }
    unlock(render_queue);
    return status;
}

bool oz_render_queue_is_idle(OzRenderQueue *render_queue)
{
    lock(render_queue);
    bool idle = render_queue->added == render_queue->done;
    unlock(render_queue);
    return idle;
}

OzStatus oz_render_queue_take(OzRenderQueue *render_queue, OzPictures *pictures,
                              const OzScene *scene, const char *caption)
{
    OzStatus status = OZ_OK;
    Job job = {.pictures = pictures, .kind = TAKE};
    if (!render_queue || !pictures) {
        return OZ_OK;
    }
    snprintf(job.caption, sizeof job.caption, "%s", caption);
    lock(render_queue);
    OZ_TRY(tell_failure(render_queue));
    OZ_TRY(oz_scene_copy(&job.scene, scene));
    if (render_queue->started) {
        push(render_queue, &job, ROOM);
    } else {
        oz_pictures_take(pictures, &job.scene, caption);
    }
done:
    unlock(render_queue);
    if (status != OZ_OK) {
        oz_scene_free(&job.scene);
    }
    return status;
}

OzStatus oz_render_queue_state(OzRenderQueue *render_queue, OzPictures *pictures,
                               const OzSnapshot *now, OzStateVisit *visit)
{
    OzStatus status = OZ_OK;
    if (!render_queue || !pictures) {
        return OZ_OK;
    }
    lock(render_queue);
    wait_for_all(render_queue);
    OZ_TRY(tell_failure(render_queue));
    OZ_TRY(oz_pictures_state(pictures, now, visit));
done:
    unlock(render_queue);
    return status;
}

OzRenderQueueTimes oz_render_queue_take_times(OzRenderQueue *render_queue)
{
    lock(render_queue);
    OzRenderQueueTimes times = render_queue->times;
    memset(&render_queue->times, 0, sizeof render_queue->times);
    unlock(render_queue);
    return times;
}

void oz_render_queue_free(OzRenderQueue *render_queue)
{
    if (!render_queue) {
        return;
    }
    lock(render_queue);
    render_queue->closing = true;
    pthread_cond_broadcast(&render_queue->changed);
    unlock(render_queue);
    if (render_queue->started) {
        pthread_join(render_queue->thread, NULL);
    }
    oz_live_free(&render_queue->live);
    pthread_cond_destroy(&render_queue->changed);
    pthread_mutex_destroy(&render_queue->lock);
    free(render_queue);
}
