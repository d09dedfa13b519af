/* Saying how stiff a scene's bed is. */
#include "report/report_bed.h"

#include "model/calibrate.h"
#include "model/insert.h"

#include <math.h>

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

void oz_report_bed_print(FILE *file, const OzScene *scene, const OzRehearsal *rehearsal)
{
    if (!rehearsal->has_stiffness) {
        return;
    }
    fprintf(file, "bed                %s%s\n", scene->settle.present ? "settled" : "as it starts",
            rehearsal->cut ? " in part: no more than a few seconds are spent on it here" : "");
    print(file, scene, &rehearsal->stiffness);
    if (rehearsal->stiffness.largest_step < scene->step) {
        oz_stiffness_say(&rehearsal->stiffness, scene);
    }
}

OzStatus oz_report_bed_say(const char *path, char *const *settings, int setting_count,
                           const char *device_name, int threads, const char *source_dir)
{
    OzStatus status = OZ_OK;
    OzScene scene = {0};
    OzGrains grains = {0};
    OzDevice device = {0};
    OzRehearsal rehearsal = {0};
    OZ_TRY(oz_scene_load(&scene, path, settings, setting_count));
    OZ_TRY(oz_insert_grains(&grains, &scene));
    OZ_TRY(oz_device_open(&device, device_name, threads));
    printf("%s, step %.4g s\n", scene.name, scene.step);
    OZ_TRY(oz_rehearsal_run(&rehearsal, &scene, &grains, &device, source_dir, INFINITY, 0));
    oz_report_bed_print(stdout, &scene, &rehearsal);
done:
    oz_rehearsal_free(&rehearsal);
    oz_device_close(&device);
    oz_grains_free(&grains);
    oz_scene_free(&scene);
    return status;
}
