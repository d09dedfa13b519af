/* Settling a scene and saying how stiff its bed is. */
#include "study/report_bed.h"

#include "base/clock.h"
#include "compute/capture.h"
#include "compute/settle.h"
#include "compute/stiffness.h"
#include "model/calibrate.h"
#include "model/place.h"
#include "model/predict.h"

#include <math.h>
#include <string.h>

static bool is_patient(void *deadline, double time, double ratio)
{
    (void)time;
    (void)ratio;
    return oz_clock_now() < *(double *)deadline;
}

static OzStatus settle(OzSnapshot *now, double *seconds, bool *cut, const OzDevice *device,
                       const char *source_dir, double patience)
{
    OzStatus status = OZ_OK;
    OzSim *sim = NULL;
    OzMember member = {now->scene, now->grains};
    OZ_TRY(oz_sim_create(&sim, device, &member, 1, source_dir));
    double deadline = oz_clock_now() + patience;
    status = oz_settle_run(sim, seconds, is_patient, &deadline);
    *cut = status == OZ_ERR_INTERRUPTED;
    OZ_TRY(*cut ? OZ_OK : status);
    OZ_TRY(oz_capture_snapshot(sim, 0, now, false));
done:
    oz_sim_free(sim);
    return status;
}

static void take_start(OzSnapshot *now)
{
    size_t count = (size_t)now->count;
    memcpy(now->position, now->grains->position, 3 * count * sizeof(double));
    memcpy(now->quaternion, now->grains->quaternion, 4 * count * sizeof(double));
    oz_snapshot_turn_axes(now);
    oz_snapshot_move_walls(now);
}

static void print(FILE *file, const OzScene *scene, const OzStiffness *bed)
{
    OzContactConstants pair = oz_calibrate_contact(scene, &scene->contact);
    if (bed->contacts == 0) {
        fprintf(file, "  stable           not known: nothing touches yet\n");
        return;
    }
    fprintf(file, "  contacts         %lld\n", (long long)bed->contacts);
    fprintf(file, "  stiffness        %.4g 1/s^2, %.3g times that of a pair of centres\n",
            bed->stiffness, bed->stiffness / pair.stiffness);
    fprintf(file, "  damping          %.4g 1/s\n", bed->damping);
    fprintf(file, "  stable           %s: largest step %.4g s, margin %.3g\n",
            bed->largest_step > scene->step ? "yes" : "NO, it cannot come to rest",
            bed->largest_step, bed->largest_step / scene->step);
}

OzStatus oz_report_bed_print(FILE *file, const OzScene *scene, const OzGrains *grains,
                             const OzDevice *device, const char *source_dir, double patience)
{
    OzStatus status = OZ_OK;
    OzSnapshot now = {0};
    OzStiffness bed;
    double seconds = 0;
    bool cut = false;
    if (!oz_stiffness_applies(scene) || grains->count == 0) {
        return OZ_OK;
    }
    OZ_TRY(oz_snapshot_create(&now, scene, grains));
    if (scene->settle.present) {
        OZ_TRY(settle(&now, &seconds, &cut, device, source_dir, patience));
        fprintf(file, "bed                settled%s\n",
                cut ? " in part: no more than a few seconds are spent on it here" : "");
    } else {
        take_start(&now);
        fprintf(file, "bed                as it starts\n");
    }
    OZ_TRY(oz_stiffness_measure(&bed, &now));
    print(file, scene, &bed);
    if (bed.largest_step < scene->step) {
        oz_stiffness_say(&bed, scene);
    }
done:
    oz_snapshot_free(&now);
    return status;
}

OzStatus oz_report_bed_say(const char *path, char *const *settings, int setting_count,
                           const char *device_name, int threads, const char *source_dir)
{
    OzStatus status = OZ_OK;
    OzScene scene = {0};
    OzGrains grains = {0};
    OzDevice device = {0};
    OZ_TRY(oz_scene_load(&scene, path, settings, setting_count));
    OZ_TRY(oz_place_grains(&grains, &scene));
    OZ_TRY(oz_device_open(&device, device_name, threads));
    printf("%s, step %.4g s\n", scene.name, scene.step);
    OZ_TRY(oz_report_bed_print(stdout, &scene, &grains, &device, source_dir, INFINITY));
done:
    oz_device_close(&device);
    oz_grains_free(&grains);
    oz_scene_free(&scene);
    return status;
}
