/* The last lines of a run. */
#include "run/costs.h"

#include "base/log.h"

#include <stdio.h>

/* Of all workers together: counts of a mean member, the longest time. */
static OzSimCounts add_counts(const OzWorker *workers, int worker_count, int64_t member_count,
                              double *spent)
{
    OzSimCounts sum = {0};
    *spent = 0;
    for (int k = 0; k < worker_count; k++) {
        const OzWorker *worker = &workers[k];
        OzSimCounts counts = oz_sim_counts(worker->sim);
        sum.steps = counts.steps > sum.steps ? counts.steps : sum.steps;
        sum.refreshes += counts.refreshes * worker->member_count;
        sum.rebuilds += counts.rebuilds * worker->member_count;
        sum.crossed += counts.crossed;
        *spent = worker->spent > *spent ? worker->spent : *spent;
    }
    sum.refreshes /= member_count;
    sum.rebuilds /= member_count;
    return sum;
}

void oz_costs_log(const OzWorker *workers, int worker_count, int64_t member_count,
                  OzRenderQueue *render_queue)
{
    double spent = 0;
    char waiting[96] = "", beside[160] = "";
    OzSimCounts counts = add_counts(workers, worker_count, member_count, &spent);
    OzRenderQueueTimes pictures = oz_render_queue_take_times(render_queue);
    double steps = counts.steps > 0 ? (double)counts.steps : 1;
    double waited = pictures.waited / worker_count;
    if (spent <= 0 || counts.steps == 0) {
        return; /* ended before its first step */
    }
    if (pictures.waited > 0) {
        snprintf(waiting, sizeof waiting, ", of which %.2f s waiting for pictures", waited);
        snprintf(beside, sizeof beside,
                 ", that waiting left out; beside it drawing %.2f s and encoding %.2f s",
                 pictures.drawing, pictures.encoding);
    }
    oz_log_line("%lld steps in %.2f s%s; %.1f us a step%s; list refreshed every %.1f, rebuilt "
                "every %.0f steps",
                (long long)counts.steps, spent, waiting, 1e6 * (spent - waited) / steps, beside,
                steps / (double)(counts.refreshes ? counts.refreshes : 1),
                steps / (double)(counts.rebuilds ? counts.rebuilds : 1));
    if (counts.crossed > 0) {
        oz_log_line("warning: %lld contacts of crossing shafts had no normal",
                    (long long)counts.crossed);
    }
}
