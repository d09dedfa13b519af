/* Launches that a wall clock can follow. */
#include "run/pace.h"

#include "base/clock.h"
#include "run/swap.h"

#include <math.h>
#include <unistd.h>

double oz_pace_of(const OzOptions *options, const OzScene *scene)
{
    const OzMovieSettings *movie = &scene->movie;
    double shown = movie->length > 0 ? scene->duration / movie->length : movie->speed;
    if (!options->has_pace) {
        return 0;
    }
    return options->pace > 0 ? options->pace : shown;
}

/* How far the next launch may go: to the event, to a change of the run that is repeated, and with a
 * pace no farther than a short time shows. */
int64_t oz_pace_next(const OzWorker *worker)
{
    const double look_every = 0.02; /* s */
    int64_t next = worker->event_step, step = oz_sim_step(worker->sim),
            other = oz_swap_next(worker);
    next = other < next ? other : next;
    if (worker->pace > 0) {
        double steps = look_every * worker->pace / worker->members[0]->scene.step;
        next = (double)(next - step) > steps + 1 ? step + (int64_t)steps + 1 : next;
    }
    return next;
}

/* Waits for the wall clock. Who has fallen behind does not race to catch up. */
void oz_pace_keep(OzWorker *worker)
{
    const double behind_most = 0.1; /* s */
    double time = oz_sim_time(worker->sim), now = oz_clock_now();
    if (worker->pace <= 0) {
        return;
    }
    double due = worker->pace_clock + (time - worker->pace_time) / worker->pace;
    if (worker->pace_clock == 0 || now - due > behind_most) {
        worker->pace_clock = now;
        worker->pace_time = time;
    } else if (due > now) {
        usleep((useconds_t)(1e6 * fmin(due - now, behind_most)));
    }
}
