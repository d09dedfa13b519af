/* The stability map. */
#include "report/report_map.h"

#include "base/folder.h"
#include "base/gnuplot.h"
#include "base/log.h"
#include "model/contact.h"
#include "model/insert.h"
#include "model/predict.h"
#include "scene/keys.h"
#include "sim/reference.h"

#include <errno.h>
#include <math.h>
#include <string.h>

enum { STEPS_CELLS = 48, RESTITUTION_CELLS = 30, PATH_SIZE = 1024 };

#define STEPS_LOW  2.0
#define STEPS_HIGH 200.0
#define CONTACTS   100.0 /* contact times of a run */
#define NUDGE      0.5   /* of the speed that would lift it off */

/* A swing that grew less than this is taken as bounded: a symplectic method's own wobble. */
#define DRIFT   1.5
#define EXPLODE 100.0

static const char *const text =
    "model: rods\n"
    "time: {step: 1e-4, duration: 1}\n"
    "contact: {contact_time: 1e-3, restitution: 0.5, friction: 0}\n"
    "precision: double\n"
    "grains:\n  - {kind: single, diameter: 5e-3, position: [0, 0, 2.5e-3]}\n"
    "walls:\n  - {kind: plane}\n";

static const char *const verdict_names[] = {"stable", "drifting", "exploded"};

static OzMapVerdict judge(double amplitude)
{
    if (!(amplitude <= EXPLODE)) {
        return OZ_MAP_EXPLODED;
    }
    return amplitude <= DRIFT ? OZ_MAP_STABLE : OZ_MAP_DRIFTING;
}

/* Puts the sphere where its weight is carried, with a nudge. *frequency receives sqrt(kappa). */
static void nudge(const OzScene *scene, OzGrains *grains, double *depth, double *frequency)
{
    *frequency = sqrt(oz_contact_constants(&scene->walls[0].contact).stiffness);
    *depth = -scene->gravity[2] / (*frequency * *frequency);
    grains->position[2] = 0.5 * grains->diameter[0] - *depth;
    grains->velocity[2] = NUDGE * *depth * *frequency;
}

OzStatus oz_report_map_try(OzMapVerdict *verdict, double *amplitude, OzIntegrator integrator,
                           double steps_per_contact, double restitution)
{
    OzStatus status = OZ_OK;
    OzScene scene = {0};
    OzGrains grains = {0};
    OzReference *reference = NULL;
    OzSnapshot end = {0};
    double depth = 0, frequency = 0;
    OZ_TRY(oz_scene_parse(&scene, "map", text, NULL, 0));
    OZ_TRY(oz_insert_grains(&grains, &scene));
    scene.integrator = integrator;
    scene.step = scene.contact.contact_time / steps_per_contact;
    scene.walls[0].contact.restitution = restitution;
    nudge(&scene, &grains, &depth, &frequency);
    OZ_TRY(oz_reference_create(&reference, &scene, &grains));
    OZ_TRY(oz_snapshot_create(&end, &scene, &grains));
    status = oz_reference_advance(reference, llround(CONTACTS * steps_per_contact));
    if (status == OZ_OK) {
        OZ_TRY(oz_reference_snapshot(reference, &end));
        double way = end.position[2] - (0.5 * grains.diameter[0] - depth);
        *amplitude = hypot(end.velocity[2], frequency * way) / grains.velocity[2];
    } else if (status == OZ_ERR_BLOWUP) {
        *amplitude = INFINITY;
        status = OZ_OK;
    }
    *verdict = judge(*amplitude);
done:
    oz_snapshot_free(&end);
    oz_reference_free(reference);
    oz_grains_free(&grains);
    oz_scene_free(&scene);
    return status;
}

static double steps_of(int cell)
{
    return STEPS_LOW * pow(STEPS_HIGH / STEPS_LOW, (cell + 0.5) / STEPS_CELLS);
}

static double restitution_of(int cell)
{
    return (cell + 0.5) / RESTITUTION_CELLS;
}

static OzStatus write_map(FILE *csv, int integrator)
{
    const char *name = oz_keys_choice_name("integrator", integrator);
    for (int r = 0; r < RESTITUTION_CELLS; r++) {
        for (int n = 0; n < STEPS_CELLS; n++) {
            OzMapVerdict verdict;
            double amplitude;
            OZ_PASS(oz_report_map_try(&verdict, &amplitude, (OzIntegrator)integrator, steps_of(n),
                                      restitution_of(r)));
            fprintf(csv, "%s,%.6g,%.6g,%.6g,%d,%s\n", name, steps_of(n), restitution_of(r),
                    amplitude, (int)verdict, verdict_names[verdict]);
        }
    }
    return OZ_OK;
}

/* Steps per contact below which theory calls a lasting contact unstable. */
static double theory(int integrator, double restitution)
{
    OzContactValues values = {.contact_time = 1, .restitution = restitution};
    OzContactConstants c = oz_contact_constants(&values);
    return 1 / oz_predict_largest_step((OzIntegrator)integrator, c.stiffness, c.damping);
}

static void send_theory(FILE *gnuplot, int integrator)
{
    fprintf(gnuplot, "$theory%d << EOD\n", integrator);
    for (double e = 0.01; e < 0.9995; e += 0.005) {
        fprintf(gnuplot, "%.6g %.6g\n", theory(integrator, e), e);
    }
    fprintf(gnuplot, "EOD\n");
}

static OzStatus draw(const char *folder, const char *csv)
{
    FILE *gnuplot = NULL;
    OZ_PASS(oz_gnuplot_open(&gnuplot, folder, "stability.png"));
    if (!gnuplot) {
        return OZ_OK;
    }
    fprintf(
        gnuplot,
        "set terminal pngcairo size 1500,560 noenhanced font 'DejaVu Sans,11'\n"
        "set output '%s/stability.png'\nset datafile separator ','\n"
        "set multiplot layout 1,%d title 'A sphere resting on a plane, nudged, after 100 contact "
        "times'\nset logscale x\nset xrange [%g:%g]\nset yrange [0:1]\n"
        "set xlabel 'steps per contact'\nset ylabel 'restitution'\nset key below\nset bmargin 6\n"
        "set datafile separator whitespace\n",
        folder, OZ_PREDICT_INTEGRATORS, STEPS_LOW, STEPS_HIGH);
    for (int i = 0; i < OZ_PREDICT_INTEGRATORS; i++) {
        const char *name = oz_keys_choice_name("integrator", i);
        send_theory(gnuplot, i);
        fprintf(gnuplot, "set title '%s'\nplot ", name);
        static const char *const colours[] = {"#0072b2", "#e69f00", "#d55e00"};
        for (int v = 0; v < 3; v++) {
            fprintf(
                gnuplot,
                "'< grep ^%s, \"%s\" | tr , \" \"' using ($5 == %d ? $2 : NaN):3 with points pt 5 "
                "ps 0.9 lc rgb '%s' title '%s', ",
                name, csv, v, colours[v], verdict_names[v]);
        }
        fprintf(gnuplot, "$theory%d with lines lw 3 lc rgb 'black' title 'theory'\n", i);
    }
    return oz_gnuplot_close(gnuplot, folder, "stability.png");
}

OzStatus oz_report_map_draw(const char *folder)
{
    OzStatus status = OZ_OK;
    char path[PATH_SIZE];
    FILE *csv = NULL;
    const OzFolderUse use = {.keep = true};
    OzFolder owned = {0};
    OZ_TRY(oz_folder_open(&owned, folder, &use));
    OZ_TRY(oz_folder_create_file(&csv, folder, "stability.csv"));
    OZ_TRY(oz_folder_note(folder, "stability.png"));
    snprintf(path, sizeof path, "%s/stability.csv", folder);
    fprintf(csv, "integrator,steps_per_contact,restitution,amplitude,verdict,meaning\n");
    for (int i = 0; status == OZ_OK && i < OZ_PREDICT_INTEGRATORS; i++) {
        status = write_map(csv, i);
    }
    if (fclose(csv) != 0 && status == OZ_OK) {
        status = oz_status_fail(OZ_ERR_FILE, "cannot write %s: %s", path, strerror(errno));
    }
    OZ_TRY(status);
    OZ_TRY(draw(folder, path));
    oz_log_line("%s/stability.csv and stability.png", folder);
done:
    oz_folder_close(&owned);
    return status;
}
