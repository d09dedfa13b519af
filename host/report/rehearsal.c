/* Rehearsing. What it times is what `orzo run` would do: the same kernels, on the same device. */
#include "report/rehearsal.h"

#include "base/clock.h"
#include "base/stage.h"
#include "sim/read_snapshot.h"
#include "sim/settle.h"

#include <string.h>

/* Watches a settling for as long as patience lasts. */
typedef struct Patience {
    OzStage stage;
    double start, deadline, time;
} Patience;

static OzStatus wait_for(void *context, double time, double ratio)
{
    Patience *patience = context;
    patience->time = time;
    oz_stage_say(&patience->stage, "settling: %.3f s, kinetic energy %.3g of what lifts all by a diameter", time, ratio);
    return oz_clock_now() < patience->deadline
               ? OZ_OK
               : oz_status_fail(OZ_ERR_INTERRUPTED, "settling takes too long");
}

static OzStatus settle(OzRehearsal *r, OzSim *sim, const OzScene *scene, double seconds)
{
    double now = oz_clock_now();
    Patience patience = {.start = now, .deadline = now + seconds};
    oz_stage_begin(&patience.stage, "settling");
    OzStatus status = oz_settle_run(sim, &r->settled_time, wait_for, &patience);
    oz_stage_end(&patience.stage);
    r->settled_in = oz_clock_now() - patience.start;
    r->cut = status == OZ_ERR_INTERRUPTED;
    if (r->cut) {
        double whole = scene->settle.time_max + scene->settle.rest_time;
        r->settled_time = patience.time;
        r->settling_left = r->settled_in * (whole / patience.time - 1);
    }
    return r->cut ? OZ_OK : status;
}

/* The first launch is timed only where it makes all the steps: drivers finish their kernels in it,
 * which may take longer than the whole stretch. */
static OzStatus make_steps(OzRehearsal *r, OzSim *sim, const OzScene *scene, double stretch)
{
    int64_t first = oz_sim_step(sim);
    int64_t whole = oz_step_clock_nearest(oz_sim_clock(sim), scene->duration);
    int64_t last = whole < INT64_MAX - first ? first + whole : INT64_MAX;
    double start = oz_clock_now();
    for (int launches = 0; oz_sim_step(sim) < last && (launches < 2 || r->spent < stretch);
         launches++) {
        if (launches == 1) {
            first = oz_sim_step(sim);
            start = oz_clock_now();
        }
        OZ_PASS(oz_sim_launch(sim, last));
        r->steps = oz_sim_step(sim) - first;
        r->spent = oz_clock_now() - start;
    }
    return OZ_OK;
}

static void take_start(OzSnapshot *now)
{
    size_t count = (size_t)now->count;
    memcpy(now->position, now->grains->position, 3 * count * sizeof(double));
    memcpy(now->quaternion, now->grains->quaternion, 4 * count * sizeof(double));
    oz_snapshot_turn_axes(now);
    oz_snapshot_move_walls(now);
}

static OzStatus measure_stiffness(OzRehearsal *r, const OzScene *scene)
{
    r->has_stiffness = oz_stiffness_applies(scene) && r->now.count > 0;
    return r->has_stiffness ? oz_stiffness_measure(&r->stiffness, &r->now) : OZ_OK;
}

static OzStatus rehearse(OzRehearsal *r, const OzScene *scene, const OzDevice *device,
                         const char *source_dir, double patience, double stretch)
{
    OzStatus status = OZ_OK;
    OzSim *sim = NULL;
    OzMember member = {scene, r->now.grains};
    OZ_TRY(oz_sim_create(&sim, device, &member, 1, source_dir));
    OZ_TRY(settle(r, sim, scene, patience));
    OZ_TRY(oz_read_snapshot_snapshot(sim, 0, &r->now, false));
    OZ_TRY(measure_stiffness(r, scene));
    if (stretch > 0) {
        OZ_TRY(make_steps(r, sim, scene, stretch));
    }
done:
    oz_sim_free(sim);
    return status;
}

OzStatus oz_rehearsal_run(OzRehearsal *rehearsal, const OzScene *scene, const OzGrains *grains,
                          const OzDevice *device, const char *source_dir, double patience,
                          double stretch)
{
    *rehearsal = (OzRehearsal){0};
    OZ_PASS(oz_snapshot_create(&rehearsal->now, scene, grains));
    if (scene->settle.present || stretch > 0) {
        OZ_PASS(rehearse(rehearsal, scene, device, source_dir, patience, stretch));
    } else {
        take_start(&rehearsal->now);
        OZ_PASS(measure_stiffness(rehearsal, scene));
    }
    return OZ_OK;
}

void oz_rehearsal_free(OzRehearsal *rehearsal)
{
    oz_snapshot_free(&rehearsal->now);
    *rehearsal = (OzRehearsal){0};
}
