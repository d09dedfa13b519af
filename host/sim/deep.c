/* Counting and naming deep contacts. */
#include "sim/deep.h"

#include "base/log.h"

#include <inttypes.h>

void oz_deep_say(const OzScene *scene, const OzDeepFound *found, bool settling)
{
    const char *body = found->at_wall ? "a wall" : "another grain";
    const char *unit = found->at_wall ? "half its radius" : "the smaller radius";
    double depth = found->at_wall ? 2 * found->depth : found->depth;
    if (scene->model == OZ_MODEL_TRIGRAINS) {
        body = "another body";
        unit = "a triangle (or of a disc's diameter)";
    }
    oz_log_line("warning: %s, seed %" PRIu64 ": grain %d overlaps %s by %.3g of %s at step %lld%s, "
                "time %.9g s: deeper than guards.overlap.warn; such contacts are counted in "
                "deep_count",
                scene->path, scene->seed, found->grain, body, depth, unit, (long long)found->step,
                settling ? " of settling" : "", found->time);
}

void oz_deep_note(OzBatch *batch, int member, const OzDeepFound *found)
{
    if (found->count == 0) {
        return;
    }
    batch->deep_count[member] += found->count;
    if (!batch->deep_told[member]) {
        batch->deep_told[member] = true;
        oz_deep_say(batch->members[member].scene, found, batch->walls_still);
    }
}
