/* Printing what follows from a scene. */
#include "study/inspect.h"

#include "base/log.h"
#include "compute/drive.h"
#include "model/place.h"
#include "observe/schedule.h"
#include "plan.h"
#include "scene/keys.h"
#include "study/inspect_contacts.h"
#include "study/inspect_pieces.h"
#include "study/inspect_range.h"
#include "study/report_bed.h"

#include <math.h>
#include <stdlib.h>

/* s of computing: 1000 rods come to rest in less on any machine of today. */
#define PATIENCE 4.0

static void print_range(FILE *file, const char *name, const double *values, int64_t count,
                        const char *unit)
{
    double low = INFINITY, high = -INFINITY;
    for (int64_t i = 0; i < count; i++) {
        low = fmin(low, values[i]);
        high = fmax(high, values[i]);
    }
    if (count > 0) {
        oz_inspect_range_print(file, name, low, high, unit);
    }
}

static void print_grains(FILE *file, const OzGrains *grains)
{
    fprintf(file, "grains             %lld\n", (long long)grains->count);
    print_range(file, "diameter", grains->diameter, grains->count, "m");
    print_range(file, "length", grains->length, grains->count, "m (shaft)");
    print_range(file, "mass", grains->mass, grains->count, "kg");
    print_range(file, "inertia", grains->inertia, grains->count, "kg m^2, across the shaft");
    print_range(file, "inertia_axis", grains->inertia_axis, grains->count, "kg m^2, about it");
}

static void print_motion(FILE *file, const OzScene *scene)
{
    for (int w = 0; w < scene->wall_count; w++) {
        const OzMotion *motion = &scene->walls[w].motion;
        if (motion->present) {
            fprintf(file,
                    "wall %d             moves %.6g m up and down at %g Hz: %.4g times gravity\n",
                    w, motion->amplitude, motion->frequency, motion->acceleration_ratio);
        }
    }
}

static void print_pictures(FILE *file, const OzScene *scene)
{
    char missed[512];
    OzSchedule schedule = oz_schedule_create(scene, -1);
    if (!scene->movie.present && scene->snapshots.count == 0 && !(scene->snapshots.strobe > 0)) {
        fprintf(file, "not opened         GL and libav (neither movie nor snapshots)\n");
    }
    if (oz_schedule_missed(&schedule, missed, sizeof missed)) {
        fprintf(file, "warning            %s\n", missed);
    }
}

/* Whether a run would refuse member i of a sweep; said by name. */
static OzStatus judge_member(const OzPlan *plan, int64_t i)
{
    OzScene scene = {0};
    OzGrains grains = {0};
    char *name = NULL;
    OzStatus status = oz_plan_load(plan, i, &scene, &grains);
    if (status != OZ_OK && oz_plan_name(plan, i, &name) == OZ_OK) {
        oz_log_line("%s: %s", name, oz_status_text());
    }
    free(name);
    oz_grains_free(&grains);
    oz_scene_free(&scene);
    return status;
}

/* Fails as a run of the scene would before its first step. */
static OzStatus judge(const OzOptions *options, const OzScene *scene, const OzGrains *grains)
{
    OzPlan plan = {0};
    OzStatus status = OZ_OK, loss = OZ_OK;
    int64_t lost = 0;
    if (scene->sweep.count == 0) {
        return oz_plan_judge(scene, grains, options->force);
    }
    OZ_TRY(oz_plan_create(&plan, options));
    for (int64_t i = 0; i < plan.count; i++) {
        OzStatus own = judge_member(&plan, i);
        loss = loss == OZ_OK ? own : loss;
        lost += own != OZ_OK;
    }
    if (lost > 0) {
        status = oz_status_fail(loss, "%lld of %lld members cannot be run", (long long)lost,
                                (long long)plan.count);
    }
done:
    oz_plan_free(&plan);
    return status;
}

static OzStatus print_rods(FILE *file, const OzScene *scene, const OzGrains *grains,
                           const OzDevice *device, const OzOptions *options)
{
    OzStatus status = OZ_OK;
    print_grains(file, grains);
    print_motion(file, scene);
    OZ_TRY(oz_inspect_contacts_print(file, scene, grains));
    OZ_TRY(oz_drive_describe(device, scene, grains, file));
    OZ_TRY(oz_report_bed_print(file, scene, grains, device, options->source_dir, PATIENCE));
done:
    return status;
}

OzStatus oz_inspect_scene(const OzOptions *options, FILE *file)
{
    OzStatus status = OZ_OK;
    OzScene scene = {0};
    OzGrains grains = {0};
    OzDevice device = {0};
    char burst[1024] = "";
    OZ_TRY(oz_scene_load(&scene, options->paths[0], options->settings, options->setting_count));
    OZ_TRY(oz_place_grains(&grains, &scene));
    fprintf(file, "scene              %s%s%s\n", scene.path, scene.title ? ": " : "",
            scene.title ? scene.title : "");
    fprintf(file, "integrator         %s, step %g s, %.0f steps\n",
            oz_keys_choice_name("integrator", (int)scene.integrator), scene.step,
            round(scene.duration / scene.step));
    if (scene.step != scene.written_step) {
        fprintf(file, "  step             %.17g s, fitted to the contact time: %g was written\n",
                scene.step, scene.written_step);
    }
    OZ_TRY(oz_device_open(&device, options->device, options->threads));
    if (scene.model == OZ_MODEL_TRIGRAINS) {
        OZ_TRY(oz_inspect_pieces_print(file, &scene, &grains));
        OZ_TRY(oz_drive_describe(&device, &scene, &grains, file));
    } else {
        status = print_rods(file, &scene, &grains, &device, options);
        if (status == OZ_ERR_BLOWUP) { /* while it settled, which an unstable step explains */
            snprintf(burst, sizeof burst, "%s", oz_status_text());
            status = OZ_OK;
        }
        OZ_TRY(status);
    }
    print_pictures(file, &scene);
    fflush(file);
    OZ_TRY(judge(options, &scene, &grains));
    if (burst[0]) {
        status = oz_status_fail(OZ_ERR_BLOWUP, "%s", burst);
    }
done:
    oz_device_close(&device);
    oz_grains_free(&grains);
    oz_scene_free(&scene);
    if (status != OZ_OK) {
        oz_log_line("%s", oz_status_text());
    }
    return status;
}
