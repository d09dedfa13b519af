/* Aligned rods under `single` and `line`. */
#include "report/report_parallel.h"

#include "base/folder.h"
#include "base/gnuplot.h"
#include "base/memory.h"
#include "base/random.h"
#include "model/insert.h"
#include "report/report_energy.h"
#include "scene/keys.h"
#include "sim/reference.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Slow enough for overlaps of some percent, fast enough to keep all pairs in motion. */
#define SPEED 0.02

static const int ladder[] = {10, 14, 20, 30, 50, 100, 200, 500};

enum { RUNGS = sizeof ladder / sizeof ladder[0], RUNGS_QUICK = 5, KINDS = 2, PATH_SIZE = 1024 };

/* Angular accelerations of all grains, over the last step and the one before. */
typedef struct Torques {
    double *angular_velocity, *now, *before;
    double jumps, squares; /* sums over grains and steps */
    int64_t count, steps;
} Torques;

static void take_torques(Torques *t, const double *angular_velocity, double step)
{
    for (int64_t i = 0; i < t->count; i++) {
        t->before[i] = t->now[i];
        t->now[i] = (angular_velocity[i] - t->angular_velocity[i]) / step;
        t->angular_velocity[i] = angular_velocity[i];
        if (t->steps >= 2) { /* the first step has no torque before it */
            double jump = t->now[i] - t->before[i];
            t->jumps += jump * jump;
            t->squares += t->now[i] * t->now[i];
        }
    }
    t->steps++;
}

static double energy(const OzSnapshot *now)
{
    return oz_report_energy_now(now) + now->ledger.elastic;
}

static OzStatus walk(OzParallelNoise *noise, OzReference *reference, OzSnapshot *now)
{
    OzStatus status = OZ_OK;
    Torques t = {.count = 3 * now->count};
    int64_t steps = llround(now->scene->duration / now->scene->step);
    OZ_TRY(OZ_NEW(&t.angular_velocity, t.count));
    OZ_TRY(OZ_NEW(&t.now, t.count));
    OZ_TRY(OZ_NEW(&t.before, t.count));
    OZ_TRY(oz_reference_snapshot(reference, now));
    double before = energy(now);
    for (int64_t step = 1; step <= steps; step++) {
        OZ_TRY(oz_reference_advance(reference, step));
        OZ_TRY(oz_reference_snapshot(reference, now));
        take_torques(&t, now->angular_velocity, now->scene->step);
    }
    noise->energy = energy(now) / before - 1;
    noise->jump = sqrt(t.jumps / t.squares);
done:
    free(t.angular_velocity);
    free(t.now);
    free(t.before);
    return status;
}

static OzStatus load(OzScene *scene, const char *path, OzParallel parallel, int steps,
                     const OzOptions *options)
{
    OZ_PASS(oz_scene_load(scene, path, options->settings, options->setting_count));
    scene->step = scene->contact.contact_time / steps;
    scene->contact.parallel = parallel;
    for (int w = 0; w < scene->wall_count; w++) {
        scene->walls[w].contact.parallel = parallel;
    }
    return OZ_OK;
}

OzStatus oz_report_parallel_measure(OzParallelNoise *noise, const char *path, OzParallel parallel,
                                    int steps, const OzOptions *options)
{
    OzStatus status = OZ_OK;
    OzScene scene = {0};
    OzGrains grains = {0};
    OzReference *reference = NULL;
    OzSnapshot now = {0};
    OZ_TRY(load(&scene, path, parallel, steps, options));
    OZ_TRY(oz_insert_grains(&grains, &scene));
    OzRandom random = oz_random_stream(scene.seed, 0);
    for (int64_t i = 0; i < 3 * grains.count; i++) {
        grains.velocity[i] = oz_random_uniform(&random, -SPEED, SPEED);
    }
    OZ_TRY(oz_reference_create(&reference, &scene, &grains));
    OZ_TRY(oz_snapshot_create(&now, &scene, &grains));
    status = walk(noise, reference, &now);
    if (status == OZ_ERR_BLOWUP) {
        *noise = (OzParallelNoise){INFINITY, INFINITY};
        status = OZ_OK;
    }
done:
    oz_snapshot_free(&now);
    oz_reference_free(reference);
    oz_grains_free(&grains);
    oz_scene_free(&scene);
    return status;
}

static OzStatus write_rows(FILE *csv, const char *path, const OzOptions *options)
{
    printf("%s: 40 contact times of aligned rods without loss\n", path);
    printf("  %-7s %6s %22s %30s\n", "contact", "steps", "energy gained, share",
           "torque's jump in a step, share");
    fprintf(csv, "parallel,steps_per_contact,energy_gained,torque_jump\n");
    for (int kind = 0; kind < KINDS; kind++) {
        for (int r = 0; r < (options->quick ? RUNGS_QUICK : RUNGS); r++) {
            OzParallelNoise noise;
            const char *name = oz_keys_choice_name("contact.parallel", kind);
            OZ_PASS(oz_report_parallel_measure(&noise, path, (OzParallel)kind, ladder[r], options));
            printf("  %-7s %6d %22.3g %30.3g\n", name, ladder[r], noise.energy, noise.jump);
            fprintf(csv, "%s,%d,%.9g,%.9g\n", name, ladder[r], noise.energy, noise.jump);
        }
    }
    return OZ_OK;
}

static OzStatus draw(const char *folder)
{
    FILE *gnuplot = NULL;
    OZ_PASS(oz_gnuplot_open(&gnuplot, folder, "aligned.png"));
    if (!gnuplot) {
        return OZ_OK;
    }
    fprintf(gnuplot,
            "set terminal pngcairo size 1100,480 noenhanced font 'DejaVu Sans,11'\n"
            "set output '%s/aligned.png'\nset multiplot layout 1,2\nset logscale xy\n"
            "set grid xtics ytics lc rgb '#dddddd'\nset format y '%%g'\n"
            "set xlabel 'steps per contact'\nset xrange [8:600]\nset key top right\n",
            folder);
    static const char *const titles[] = {"energy gained or lost in 40 contact times, share",
                                         "change of torque from a step to the next, share"};
    for (int panel = 0; panel < 2; panel++) {
        fprintf(gnuplot, "set ylabel '%s'\nplot ", titles[panel]);
        for (int kind = 0; kind < KINDS; kind++) {
            const char *name = oz_keys_choice_name("contact.parallel", kind);
            fprintf(gnuplot,
                    "'< grep ^%s, \"%s/aligned.csv\" | tr , \" \"' using 2:(abs($%d)) with "
                    "linespoints lw 2 pt 7 lc rgb '%s' title 'parallel: %s'%s",
                    name, folder, 3 + panel, kind ? "#0072b2" : "#d55e00", name,
                    kind + 1 < KINDS ? ", " : "\n");
        }
    }
    return oz_gnuplot_close(gnuplot, folder, "aligned.png");
}

OzStatus oz_report_parallel_study(const char *path, const char *folder, const OzOptions *options)
{
    OzStatus status = OZ_OK;
    FILE *csv = NULL;
    OZ_TRY(oz_folder_create_file(&csv, folder, "aligned.csv"));
    OZ_TRY(oz_folder_note(folder, "aligned.png"));
    status = write_rows(csv, path, options);
    if (fclose(csv) != 0 && status == OZ_OK) {
        status =
            oz_status_fail(OZ_ERR_FILE, "cannot write %s/aligned.csv: %s", folder, strerror(errno));
    }
    OZ_TRY(status);
    OZ_TRY(draw(folder));
done:
    return status;
}
