/* Stop bits into text. */
#include "sim/guard.h"

#include <stdio.h>
#include <string.h>

OzStatus oz_guard_fail(const OzModel *model, const OzControlHead *control, const OzSnapshot *now,
                       bool settling)
{
    char text[512] = "", advice[320];
    for (int i = 0; i < model->stop_count; i++) {
        if (control->stop_bits & model->stops[i].bit) {
            size_t used = strlen(text);
            snprintf(text + used, sizeof text - used, "%s%s", used ? "; " : "",
                     model->stops[i].words);
        }
    }
    model->advise(advice, sizeof advice, control, now);
    char grain[32] = "";
    if (control->stop_index != OZ_NEVER) {
        snprintf(grain, sizeof grain, ", grain %d",
                 model->grain_of(now->grains, control->stop_index));
    }
    return oz_status_fail(OZ_ERR_BLOWUP, "%s: stopped at step %lld%s, time %.9g s%s: %s; %s",
                          now->scene->path, (long long)now->step, settling ? " of settling" : "",
                          now->time, grain, text, advice);
}
