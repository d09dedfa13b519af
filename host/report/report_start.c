/* Finding a bed from which paths of grains can be compared. */
#include "report/report_start.h"

#include "base/clock.h"
#include "base/log.h"
#include "model/beam_limits.h"
#include "model/insert.h"
#include "model/motion.h"
#include "model/predict.h"
#include "model/prediction.h"
#include "sim/read_snapshot.h"
#include "sim/settle.h"
#include "sim/sim.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* s of computing for a bed to settle, or its grains to meet. */
static const double patience = 30, patience_quick = 6;
/* s of computing after which a step's time is known. */
static const double timing = 0.2;

enum {
    WARM_ELEMENTS = 50, /* of half the scene's time: how often contacts are counted */
    TIMED_STEPS = 64
};

static double patience_of(const OzOptions *options)
{
    return options->quick ? patience_quick : patience;
}

static OzStatus wait_for(void *deadline, double time, double ratio)
{
    (void)time;
    (void)ratio;
    return oz_clock_now() < *(double *)deadline
               ? OZ_OK
               : oz_status_fail(OZ_ERR_INTERRUPTED, "settling takes too long");
}

/* The shortest hit that rods can have; 0: nothing can touch. */
static OzStatus find_hit(double *cycle, const OzScene *scene, const OzGrains *grains)
{
    OzPrediction *rows = NULL;
    int count = 0;
    *cycle = 0;
    OzStatus status = oz_prediction_rows(&rows, &count, scene, grains);
    for (int i = 0; status == OZ_OK && i < count; i++) {
        double hit = rows[i].steps * scene->step;
        bool touched = rows[i].wall >= 0 || grains->count > 1;
        if (touched && isfinite(hit) && hit > 0 && (*cycle == 0 || hit < *cycle)) {
            *cycle = hit;
        }
    }
    free(rows);
    return status;
}

static OzStatus find_cycle(OzReportStart *start)
{
    OzBeamLimit limit;
    start->cycle_name = start->is_flat ? "period" : "contact";
    if (start->is_flat) {
        OZ_PASS(oz_beam_limits_find(&limit, &start->scene, &start->grains));
        start->cycle = limit.rate > 0 ? 8 * atan(1) / limit.rate : 0;
    } else {
        OZ_PASS(find_hit(&start->cycle, &start->scene, &start->grains));
    }
    if (!(start->cycle > 0)) {
        return oz_status_fail(OZ_ERR_INPUT,
                              "%s: nothing can touch here, any step is right; expected two "
                              "grains, or a grain and a wall",
                              start->scene.path);
    }
    return OZ_OK;
}

static OzStatus load(OzReportStart *start, const char *path, const OzOptions *options)
{
    OZ_PASS(oz_scene_load(&start->scene, path, options->settings, options->setting_count));
    if (start->scene.sweep.key) {
        return oz_status_fail(OZ_ERR_INPUT, "%s: a sweep over %s; expected a scene without one",
                              path, start->scene.sweep.key);
    }
    start->is_flat = start->scene.model == OZ_MODEL_TRIGRAINS;
    OZ_PASS(oz_insert_grains(&start->grains, &start->scene));
    return find_cycle(start);
}

static void copy(double *to, const double *from, int64_t count)
{
    if (count > 0) {
        memcpy(to, from, (size_t)count * sizeof *to);
    }
}

/* The grains' start becomes what a snapshot shows. */
static void take_state(OzGrains *grains, const OzSnapshot *now)
{
    copy(grains->position, now->position, 3 * now->count);
    copy(grains->quaternion, now->quaternion, 4 * now->count);
    copy(grains->velocity, now->velocity, 3 * now->count);
    copy(grains->angular_velocity, now->angular_velocity, 3 * now->count);
    OzElements *elements = grains->elements;
    if (elements) {
        copy(elements->position, now->element_position, 2 * elements->free_count);
        copy(elements->angle, now->element_angle, elements->free_count);
        copy(elements->velocity, now->element_velocity, 2 * elements->free_count);
        copy(elements->angular_velocity, now->element_angular_velocity, elements->free_count);
    }
}

/* Touching pairs and touches of walls. */
static int64_t touches_of(const OzSnapshot *now)
{
    OzContactSums sums = oz_contact_list_sum(&now->contacts);
    return sums.pairs + sums.walls;
}

/* Whether time 0 can be put anywhere in the run, at whole periods. */
static bool has_movable_clock(const OzScene *scene)
{
    for (int w = 0; w < scene->wall_count; w++) {
        const OzWall *wall = &scene->walls[w];
        const OzMotion *motion = &wall->motion;
        bool other = motion->frequency > 0 && fabs(motion->frequency * scene->period - 1) > 1e-9;
        if (wall->since > 0 || wall->until > 0 ||
            (motion->present && (other || motion->angular_velocity != 0 ||
                                 (motion->frequency == 0 && oz_motion_speed(motion) > 0)))) {
            return false;
        }
    }
    return true;
}

/* Runs the scene until grains touch. */
static OzStatus warm(OzReportStart *start, OzSim *sim, OzSnapshot *now, double deadline)
{
    const OzScene *scene = &start->scene;
    double element = scene->duration / 2 / WARM_ELEMENTS, time = 0;
    if (scene->period > 0) {
        element = scene->period * fmax(1, floor(element / scene->period));
    }
    element = fmax(element, scene->step);
    while (touches_of(now) * 2 < now->count && time + element <= scene->duration / 2 &&
           oz_clock_now() < deadline) {
        time += element;
        OZ_PASS(oz_sim_advance(sim, oz_step_clock_nearest(oz_sim_clock(sim), time)));
        OZ_PASS(oz_read_snapshot_snapshot(sim, 0, now, true));
    }
    if (time > 0) {
        snprintf(start->how, sizeof start->how, "the bed as it is after %.3g s", time);
    }
    return OZ_OK;
}

static OzStatus settle(OzReportStart *start, OzSim *sim, OzSnapshot *now, double deadline)
{
    double begin = oz_clock_now(), spent;
    OzStatus status = oz_settle_run(sim, &start->settled, wait_for, &deadline);
    spent = oz_clock_now() - begin;
    bool cut = status == OZ_ERR_INTERRUPTED;
    OZ_TRY(cut ? OZ_OK : status);
    OZ_TRY(oz_read_snapshot_snapshot(sim, 0, now, true));
    snprintf(start->how, sizeof start->how,
             cut ? "the bed settled in part: %.3g s of computing are spent on it"
                 : "the bed settled for %.3g s",
             cut ? spent : start->settled);
    if (cut) {
        start->settled = start->scene.settle.time_max + start->scene.settle.rest_time;
    }
done:
    return status;
}

/* Wall time of a step, in launches. */
static OzStatus time_steps(OzReportStart *start, OzSim *sim)
{
    int64_t made = 0;
    OZ_PASS(oz_sim_advance(sim, oz_sim_step(sim) + 1)); /* the driver makes itself ready */
    double begin = oz_clock_now();
    while (made == 0 || oz_clock_now() - begin < timing) {
        OZ_PASS(oz_sim_advance(sim, oz_sim_step(sim) + TIMED_STEPS));
        made += TIMED_STEPS;
    }
    start->step_seconds = (oz_clock_now() - begin) / (double)made;
    return OZ_OK;
}

/* Lets the bed come to its start. A guard that stops the scene as written ends this as
 * OZ_ERR_BLOWUP. */
static OzStatus prepare(OzReportStart *start, OzSnapshot *now, const OzOptions *options,
                        const OzDevice *device)
{
    OzStatus status = OZ_OK;
    OzSim *sim = NULL;
    OzMember member = {&start->scene, &start->grains};
    double deadline = oz_clock_now() + patience_of(options);
    OZ_TRY(oz_sim_create(&sim, device, &member, 1, options->source_dir));
    if (start->scene.settle.present) {
        OZ_TRY(settle(start, sim, now, deadline));
    } else {
        OZ_TRY(oz_read_snapshot_snapshot(sim, 0, now, true));
        if (now->count >= OZ_REPORT_START_FEW && has_movable_clock(&start->scene)) {
            OZ_TRY(warm(start, sim, now, deadline));
        }
    }
    start->touches = touches_of(now) > 0;
    OZ_TRY(time_steps(start, sim));
done:
    oz_sim_free(sim);
    return status;
}

static OzStatus measure_stiffness(OzReportStart *start, const OzSnapshot *now)
{
    if (oz_stiffness_applies(&start->scene) && start->touches) {
        OZ_PASS(oz_stiffness_measure(&start->stiffness, now));
        start->has_stiffness = start->stiffness.contacts > 0;
    }
    return OZ_OK;
}

OzStatus oz_report_start_find(OzReportStart *start, const char *path, const OzOptions *options,
                              const OzDevice *device)
{
    OzStatus status = OZ_OK;
    OzSnapshot now = {0};
    *start = (OzReportStart){.how = "grains as placed"};
    OZ_TRY(load(start, path, options));
    if (isinf(start->scene.duration)) {
        status = oz_status_fail(OZ_ERR_INPUT,
                                "%s: an endless run has no end to compare at; expected "
                                "--set time.duration=T",
                                start->scene.path);
        goto done;
    }
    OZ_TRY(oz_snapshot_create(&now, &start->scene, &start->grains));
    status = prepare(start, &now, options, device);
    if (status == OZ_ERR_BLOWUP) {
        oz_log_line("%s; paths begin with the grains as placed", oz_status_text());
        snprintf(start->how, sizeof start->how, "grains as placed: the scene as written stops");
        start->settled = 0;
        status = OZ_OK;
    } else if (status == OZ_OK) {
        OZ_TRY(measure_stiffness(start, &now));
        take_state(&start->grains, &now);
    }
done:
    oz_snapshot_free(&now);
    return status;
}

void oz_report_start_free(OzReportStart *start)
{
    oz_grains_free(&start->grains);
    oz_scene_free(&start->scene);
    *start = (OzReportStart){0};
}

static OzStatus limit_pairs(double *largest, const OzScene *scene, const OzGrains *grains)
{
    OzPrediction *rows = NULL;
    int count = 0;
    OzStatus status = oz_prediction_rows(&rows, &count, scene, grains);
    for (int i = 0; status == OZ_OK && i < count; i++) {
        if (rows[i].wall >= 0 || grains->count > 1) {
            *largest = fmin(*largest, rows[i].largest_step);
        }
    }
    free(rows);
    return status;
}

OzStatus oz_report_start_limit(double *largest, const OzReportStart *start, OzIntegrator integrator,
                               int64_t substeps)
{
    OzScene scene = start->scene; /* shallow: never freed */
    OzBeamLimit limit;
    scene.integrator = integrator;
    scene.beams.substeps = substeps;
    *largest = INFINITY;
    if (start->is_flat) {
        OZ_PASS(oz_beam_limits_find(&limit, &scene, &start->grains));
        *largest = limit.largest_step;
        return OZ_OK;
    }
    OZ_PASS(limit_pairs(largest, &scene, &start->grains));
    if (start->has_stiffness) {
        *largest = fmin(*largest, oz_predict_largest_step(integrator, start->stiffness.stiffness,
                                                          start->stiffness.damping));
    }
    return OZ_OK;
}

OzStatus oz_report_start_say(FILE *file, const OzReportStart *start)
{
    double largest;
    OZ_PASS(oz_report_start_limit(&largest, start, start->scene.integrator,
                                  start->scene.beams.substeps));
    fprintf(file, "stability: as written, the largest stable step is %.4g s, %.3g times the step; ",
            largest, largest / start->scene.step);
    if (start->has_stiffness) {
        fprintf(file, "of the bed's %lld contacts together\n",
                (long long)start->stiffness.contacts);
    } else {
        fprintf(file, "of any %s\n",
                start->is_flat ? "grain with a whole edge in contact"
                               : "single contact: a bed's contacts together may bear less");
    }
    return OZ_OK;
}
