/* Where the time of a group of members went, in the log. */
#pragma once

#include "run/worker.h"

/* Says it; of pictures only when there were any. */
void oz_costs_log(const OzWorker *workers, int worker_count, int64_t member_count,
                  OzRenderQueue *render_queue);
