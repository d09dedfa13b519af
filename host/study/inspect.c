/* Printing what follows from a scene. */
#include "study/inspect.h"

#include "base/log.h"
#include "compute/drive.h"
#include "model/calibrate.h"
#include "model/place.h"
#include "model/predict.h"
#include "scene/keys.h"
#include "study/inspect_pieces.h"
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
    if (count > 0 && low < high) {
        fprintf(file, "  %-16s %.6g ... %.6g %s\n", name, low, high, unit);
    } else if (count > 0) {
        fprintf(file, "  %-16s %.6g %s\n", name, low, unit);
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

/* In the order of OzCalibrated. */
static const char *const calibrated[] = {
    NULL,
    "discrete: exact at every phase of first touch",
    "discrete: exact in the mean over the phases of first touch",
    "discrete: no damping gives what was asked; as if continuous",
};

static void print_contact(FILE *file, const OzScene *scene, const OzPrediction *row)
{
    const char *calibration = calibrated[oz_calibrate_outcome(scene, &row->values)];
    const OzContactConstants *c = &row->constants;
    if (row->wall < 0) {
        fprintf(file, "contact            of two grains\n");
    } else {
        fprintf(file, "contact            at wall %d\n", row->wall);
    }
    if (row->speed > 0) {
        fprintf(file, "  hit              at %.4g m/s, stiffness at its deepest point\n",
                row->speed);
    }
    fprintf(file, "  k_n              %.6g ... %.6g N/m\n", c->stiffness * row->mass_low,
            c->stiffness * row->mass_high);
    fprintf(file, "  c_n              %.6g ... %.6g kg/s\n", c->damping * row->mass_low,
            c->damping * row->mass_high);
    fprintf(file, "  steps            %.4g a contact\n", row->steps);
    fprintf(file,
            "  restitution      asked %.6g, this integrator gives %.6g (%.6g ... %.6g by phase)\n",
            row->values.restitution, row->hits.mean, row->hits.low, row->hits.high);
    if (calibration) {
        fprintf(file, "  calibration      %s\n", calibration);
    }
    if (row->values.law != OZ_LAW_HERTZ && row->values.restitution < OZ_CONTACT_RESTITUTION_LEAST) {
        fprintf(file, "  restitution      %g is used as %g\n", row->values.restitution,
                OZ_CONTACT_RESTITUTION_LEAST);
    }
    fprintf(file, "  stable           %s: largest step %.6g s, margin %.3g\n",
            row->stable ? "yes" : "NO", row->largest_step, row->margin);
    if (!row->tangential_stable) {
        fprintf(file, "  warning          a sticking tangential spring is unstable at this step\n");
    }
}

static OzStatus print_contacts(FILE *file, const OzScene *scene, const OzGrains *grains)
{
    OzPrediction *rows = NULL;
    int count = 0;
    OzStatus status = oz_predict_scene(&rows, &count, scene, grains);
    for (int i = 0; status == OZ_OK && i < count; i++) {
        print_contact(file, scene, &rows[i]);
    }
    free(rows);
    return status;
}

OzStatus oz_inspect_scene(const OzOptions *options, FILE *file)
{
    OzStatus status = OZ_OK;
    OzScene scene = {0};
    OzGrains grains = {0};
    OzDevice device = {0};
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
        print_grains(file, &grains);
        print_motion(file, &scene);
        OZ_TRY(print_contacts(file, &scene, &grains));
        OZ_TRY(oz_drive_describe(&device, &scene, &grains, file));
        OZ_TRY(oz_report_bed_print(file, &scene, &grains, &device, options->source_dir, PATIENCE));
    }
    if (!scene.movie.present && scene.snapshots.count == 0 && !(scene.snapshots.strobe > 0)) {
        fprintf(file, "not opened         GL and libav (neither movie nor snapshots)\n");
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
