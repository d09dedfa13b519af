/* Energy by force point, in a loop on the host and in a pile on the device. */
#include "report/report_midpoint.h"

#include "base/folder.h"
#include "model/insert.h"
#include "observe/element_energy.h"
#include "scene/keys.h"
#include "sim/element_forces.h"
#include "sim/read_snapshot.h"
#include "sim/sim.h"

#include <errno.h>
#include <math.h>
#include <string.h>

enum {
    LEGS = 4,
    LEG_STEPS = 2000, /* Simpson's error at first touch is then below 1e-6 of the work */
    SAMPLES = 200     /* of a pile                                                      */
};

/* Height of the pressed triangle, m, and its angle, rad. Its corner goes 0.1 mm deep at most. */
static const double path_of_loop[LEGS + 1][2] = {
    {1.3e-3, -0.1}, {1.1e-3, -0.1}, {1.1e-3, 0.5}, {1.3e-3, 0.5}, {1.3e-3, -0.1}};

static const char *const loop_scene =
    "model: trigrains\ntime: {step: 1e-6, duration: 0}\ngravity: [0, 0]\ngrains:\n"
    "  - {kind: single, shape: vertices, position: [0, -3.333333e-3],\n"
    "     vertices: [-1e-2, 0, 0, -1e-2, 1e-2, 0]}\n"
    "  - {kind: single, shape: vertices, position: [3e-4, 1.3e-3],\n"
    "     vertices: [0, -1.2e-3, 8e-4, 6e-4, -8e-4, 6e-4]}\n";

/* Force upwards and torque on the second grain at a place of the path, and what is stored. */
static OzStatus press(OzElementForces *forces, const OzElements *elements, const double place[2],
                      double load[2], double *stored)
{
    double position[4] = {elements->position[0], elements->position[1], elements->position[2],
                          place[0]};
    double angle[2] = {0, place[1]}, velocity[4] = {0}, angular_velocity[2] = {0};
    OzElementState state = {.position = position,
                            .angle = angle,
                            .velocity = velocity,
                            .angular_velocity = angular_velocity};
    OZ_PASS(oz_element_forces_evaluate(forces, &state));
    load[0] = forces->force[3];
    load[1] = forces->torque[1];
    *stored = fmax(*stored, oz_contact_list_sum(forces->list).energy);
    return OZ_OK;
}

/* By Simpson's rule along one leg. */
static OzStatus walk_leg(OzElementForces *forces, const OzElements *elements, int leg, double *work,
                         double *stored)
{
    const double *from = path_of_loop[leg], *to = path_of_loop[leg + 1];
    for (int i = 0; i <= 2 * LEG_STEPS; i++) {
        double s = (double)i / (2 * LEG_STEPS), load[2];
        double place[2] = {from[0] + s * (to[0] - from[0]), from[1] + s * (to[1] - from[1])};
        double weight = (i == 0 || i == 2 * LEG_STEPS ? 1 : i % 2 ? 4 : 2) / (6.0 * LEG_STEPS);
        OZ_PASS(press(forces, elements, place, load, stored));
        *work += weight * (load[0] * (to[0] - from[0]) + load[1] * (to[1] - from[1]));
    }
    return OZ_OK;
}

OzStatus oz_report_midpoint_loop(double *share, OzForcePoint point)
{
    OzStatus status = OZ_OK;
    OzScene scene = {0};
    OzGrains grains = {0};
    OzElementForces forces = {0};
    OzContactList list = {0};
    double work = 0, stored = 0;
    OZ_TRY(oz_scene_parse(&scene, "loop", loop_scene, NULL, 0));
    scene.triangles.force_point = point;
    OZ_TRY(oz_insert_grains(&grains, &scene));
    OZ_TRY(oz_element_forces_create(&forces, &scene, &grains));
    forces.list = &list;
    for (int leg = 0; leg < LEGS; leg++) {
        OZ_TRY(walk_leg(&forces, grains.elements, leg, &work, &stored));
    }
    *share = work / stored;
done:
    oz_element_forces_free(&forces);
    oz_contact_list_free(&list);
    oz_grains_free(&grains);
    oz_scene_free(&scene);
    return status;
}

/* One look at a pile, J. */
typedef struct Look {
    double time, kinetic, unaccounted;
} Look;

/* All energy less what came in, plus what went out. */
static Look look_at(const OzSnapshot *now)
{
    double kinetic = oz_element_energy_translational(now) + oz_element_energy_rotational(now);
    double all = kinetic + oz_element_energy_potential(now) + oz_element_energy_stored(now);
    return (Look){now->time, kinetic,
                  all + oz_element_energy_lost(now) - now->element_ledger.work_walls};
}

static double mean_kinetic(const Look *looks, int from, int to)
{
    double sum = 0;
    for (int i = from; i < to; i++) {
        sum += looks[i].kinetic;
    }
    return sum / (to - from);
}

static void sum_up(OzMidpointPile *pile, const Look *looks)
{
    const Look *middle = &looks[SAMPLES / 2], *last = &looks[SAMPLES - 1];
    pile->peak = 0;
    for (int i = 0; i < SAMPLES; i++) {
        pile->peak = fmax(pile->peak, looks[i].kinetic);
    }
    pile->before = mean_kinetic(looks, SAMPLES / 2, 3 * SAMPLES / 4) / pile->peak;
    pile->after = mean_kinetic(looks, 3 * SAMPLES / 4, SAMPLES) / pile->peak;
    pile->power = (last->unaccounted - middle->unaccounted) / (last->time - middle->time);
}

static void write_looks(FILE *csv, const OzScene *scene, const Look *looks)
{
    const char *point =
        oz_keys_choice_name("triangles.force_point", (int)scene->triangles.force_point);
    for (int i = 0; csv && i < SAMPLES; i++) {
        fprintf(csv, "%s,%.6g,%.6g,%.6g\n", point, looks[i].time, looks[i].kinetic,
                looks[i].unaccounted - looks[0].unaccounted);
    }
}

OzStatus oz_report_midpoint_pile(OzMidpointPile *pile, const OzScene *scene, const OzDevice *device,
                                 const char *source_dir, FILE *csv)
{
    OzStatus status = OZ_OK;
    OzGrains grains = {0};
    OzSim *sim = NULL;
    OzSnapshot now = {0};
    Look looks[SAMPLES];
    OzMember member = {scene, &grains};
    int64_t steps = llround(scene->duration / scene->step);
    OZ_TRY(oz_insert_grains(&grains, scene));
    OZ_TRY(oz_sim_create(&sim, device, &member, 1, source_dir));
    OZ_TRY(oz_snapshot_create(&now, scene, &grains));
    for (int i = 0; i < SAMPLES; i++) {
        OZ_TRY(oz_sim_advance(sim, steps * (i + 1) / SAMPLES));
        OZ_TRY(oz_read_snapshot_snapshot(sim, 0, &now, true));
        looks[i] = look_at(&now);
    }
    sum_up(pile, looks);
    write_looks(csv, scene, looks);
done:
    oz_snapshot_free(&now);
    oz_sim_free(sim);
    oz_grains_free(&grains);
    return status;
}

static OzStatus study_point(OzForcePoint point, const char *path, const OzDevice *device,
                            const OzOptions *options, FILE *csv)
{
    OzStatus status = OZ_OK;
    OzScene scene = {0};
    OzMidpointPile pile;
    double share;
    OZ_TRY(oz_scene_load(&scene, path, options->settings, options->setting_count));
    scene.triangles.force_point = point;
    scene.observe.ledger = true;
    scene.duration *= options->quick ? 0.5 : 1;
    OZ_TRY(oz_report_midpoint_loop(&share, point));
    OZ_TRY(oz_report_midpoint_pile(&pile, &scene, device, options->source_dir, csv));
    printf("  %-9s %12.2e %14.2e %14.2e %14.2e W\n",
           oz_keys_choice_name("triangles.force_point", (int)point), share, pile.before, pile.after,
           pile.power);
    fflush(stdout);
done:
    oz_scene_free(&scene);
    return status;
}

OzStatus oz_report_midpoint_study(const char *path, const char *folder, const OzOptions *options)
{
    OzStatus status = OZ_OK;
    OzDevice device = {0};
    FILE *csv = NULL;
    OZ_TRY(oz_device_open(&device, options->device, options->threads));
    OZ_TRY(oz_folder_create_file(&csv, folder, "midpoint.csv"));
    fprintf(csv, "force_point,time,kinetic,unaccounted\n");
    printf("where the force of two triangles acts\n  %-9s %12s %14s %14s %14s\n", "", "loop's work",
           "kinetic/peak", "later", "injected");
    OZ_TRY(study_point(OZ_FORCE_CENTROID, path, &device, options, csv));
    OZ_TRY(study_point(OZ_FORCE_MIDPOINT, path, &device, options, csv));
done:
    if (csv && fclose(csv) != 0 && status == OZ_OK) {
        status = oz_status_fail(OZ_ERR_FILE, "cannot write %s/midpoint.csv: %s", folder,
                                strerror(errno));
    }
    oz_device_close(&device);
    return status;
}
