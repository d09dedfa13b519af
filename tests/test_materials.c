/* Grains and walls of several materials: on the host against closed forms, on the device against
 * the host. ORZO_NEEDS_DEVICE */
#include "mixture_rig.h"

#include "model/prediction.h"

static const double pi = 3.14159265358979323846;

/* Times and speeds of a hit of two spheres along x, as seen at every step. */
typedef struct Hit {
    double lasts; /* s, as many steps as they touch */
    double restitution;
} Hit;

static Hit hit(Rig *rig, int steps)
{
    Hit seen = {0, 0};
    rig_start(rig);
    double before = rig->now.velocity[0] - rig->now.velocity[3];
    for (int step = 1; step <= steps; step++) {
        rig_advance(rig, step);
        seen.lasts += rig->now.contacts.count > 0 ? rig->scene.step : 0;
    }
    seen.restitution = (rig->now.velocity[3] - rig->now.velocity[0]) / before;
    return seen;
}

#define MATERIALS                                                                                  \
    "materials:\n"                                                                                 \
    "  - {name: glass, density: 2500, contact_time: 3e-4, restitution: 0.9, friction: 0.16}\n"     \
    "  - {name: steel, density: 7800, contact_time: 1e-4, restitution: 0.5, friction: 0.36}\n"

/* Springs in series: the pair's time is the root mean square of both, and each body gives back its
 * e^2 of what it held, by the square of its time. Masses are their materials'. */
static void test_a_hit_of_two_materials(void **state)
{
    (void)state;
    for (int own = 0; own < 2; own++) {
        Rig rig;
        rig_open(
            &rig,
            "model: rods\ngravity: [0, 0, 0]\ntime: {step: 2e-7, duration: 1}\n"
            "integrator: velocity-verlet\n" MATERIALS "%s"
            "grains:\n"
            "  - {kind: single, material: steel, diameter: 1e-3, position: [0, 0, 0], "
            "velocity: [0.1, 0, 0]}\n"
            "  - {kind: single, material: glass, diameter: 1e-3, position: [1.001e-3, 0, 0]}\n",
            own ? "pairs:\n  - {between: [glass, steel], contact_time: 4e-4, "
                  "restitution: 0.7}\n"
                : "");
        double volume = pi / 6 * 1e-9;
        assert_true(fabs(rig.grains.mass[0] / (7800 * volume) - 1) < 1e-12);
        assert_true(fabs(rig.grains.mass[1] / (2500 * volume) - 1) < 1e-12);
        double time = own ? 4e-4 : sqrt((9e-8 + 1e-8) / 2);
        double e = own ? 0.7 : sqrt((9 * 0.81 + 1 * 0.25) / 10);
        Hit seen = hit(&rig, 3000);
        assert_true(fabs(seen.lasts - time) < 2 * rig.scene.step); /* it begins within a step */
        assert_true(fabs(seen.restitution - e) < 1e-3);            /* of a step in a thousand */
        rig_close(&rig);
    }
}

/* Hertz: 2.943275 xi / v with xi = (5/4 m* v^2 / K)^(2/5), K = 4/3 E* sqrt(R*) (Johnson
 * 1985, 11.24); with hertz K is the harmonic mean. */
static void test_a_hertzian_hit_of_two_materials(void **state)
{
    (void)state;
    for (int mindlin = 0; mindlin < 2; mindlin++) {
        Rig rig;
        rig_open(&rig,
                 "model: rods\ngravity: [0, 0, 0]\ntime: {step: 2e-7, duration: 1}\n"
                 "integrator: velocity-verlet\ncontact: {%s}\nmaterials:\n"
                 "  - {name: soft, density: 1000, %s}\n  - {name: hard, density: 8000, %s}\n"
                 "grains:\n"
                 "  - {kind: single, material: hard, diameter: 2e-3, position: [0, 0, 0], "
                 "velocity: [0.5, 0, 0]}\n"
                 "  - {kind: single, material: soft, diameter: 1e-3, position: [1.501e-3, 0, 0]}\n",
                 mindlin ? "law: hertz-mindlin, restitution: 1"
                         : "law: hertz, normal_damping_rate: 0, tangential_damping_rate: 0",
                 mindlin ? "youngs_modulus: 1e7, poisson_ratio: 0.45" : "hertz_stiffness: 1e5",
                 mindlin ? "youngs_modulus: 4e7, poisson_ratio: 0.2" : "hertz_stiffness: 5e5");
        double modulus = 1 / ((1 - 0.45 * 0.45) / 1e7 + (1 - 0.2 * 0.2) / 4e7);
        double one = 8000 * pi / 6 * 8e-9, other = 1000 * pi / 6 * 1e-9, v = 0.5;
        double mass = one * other / (one + other), radius = 1e-3 * 0.5e-3 / 1.5e-3;
        double stiffness = mindlin ? 4.0 / 3 * modulus * sqrt(radius) : 2 / (1 / 1e5 + 1 / 5e5);
        double xi = pow(1.25 * mass * v * v / stiffness, 0.4);
        Hit seen = hit(&rig, 1500);
        assert_true(fabs(seen.lasts - 2.943275 * xi / v) < 2 * rig.scene.step);
        assert_true(fabs(seen.restitution - 1) < 1e-3); /* some hundred steps and more */
        rig_close(&rig);
    }
}

/* A sphere that slides without rolling, as rolling takes nothing here: mu g, mu of the pair. */
static void test_sliding_on_another_material(void **state)
{
    (void)state;
    for (int own = 0; own < 2; own++) {
        Rig rig;
        rig_open(
            &rig,
            "model: rods\ntime: {step: 1e-5, duration: 1}\nintegrator: velocity-verlet\n" MATERIALS
            "%s"
            "grains:\n  - {kind: single, material: glass, diameter: 1e-3, "
            "position: [0, 0, 0.5e-3], velocity: [1, 0, 0]}\n"
            "  - {kind: single, material: steel, diameter: 1e-3, "
            "position: [0, 1, 0.5e-3], velocity: [1, 0, 0]}\n"
            "walls: [{kind: plane, material: steel}]\n",
            own ? "pairs: [{between: [steel, glass], friction: 0.1}]\n" : "");
        double friction = own ? 0.1 : sqrt(0.16 * 0.36);
        rig_start(&rig);
        rig_advance(&rig, 5000);
        double one = (1 - rig.now.velocity[0]) / (9.81 * rig.now.time);
        double other = (1 - rig.now.velocity[3]) / (9.81 * rig.now.time);
        /* it drops onto its spring in the first hundredth of the time */
        assert_true(fabs(one / friction - 1) < 5e-3);
        assert_true(fabs(other / 0.36 - 1) < 5e-3);
        rig_close(&rig);
    }
}

/* What the ledger of a mixture does not account for: a hundredth is what users are promised. */
static void test_the_ledger_closes(void **state)
{
    (void)state;
    Rig rig;
    open_mixture(&rig, "double", hooke, "contact_time", "2e-4");
    rig_start(&rig);
    double before = mechanical_energy(&rig.now) + rig.now.ledger.elastic;
    rig_advance(&rig, 3000);
    const OzLedger *l = &rig.now.ledger;
    double after = mechanical_energy(&rig.now) + l->elastic;
    double residual = after - before + l->dissipated + l->friction - l->work_walls;
    assert_true(fabs(residual) < 0.01 * (l->dissipated + l->friction));
    rig_close(&rig);
}

/* Grains of one material at walls of others need no kernels of their own. */
static void test_walls_alone_cost_nothing(void **state)
{
    (void)state;
    Rig rig;
    rig_open(&rig, "model: rods\ntime: {step: 1e-5, duration: 1}\n" MATERIALS
                   "grains: [{kind: single, material: steel, diameter: 1e-3, "
                   "position: [0, 0, 1e-3]}]\n"
                   "walls: [{kind: plane, material: glass}, {kind: plane, point: [0, 0, 1], "
                   "normal: [0, 0, -1], material: steel}]\n");
    assert_int_equal(oz_mixing_count(&rig.scene), 1);
    assert_true(rig.scene.contact.contact_time == 1e-4 && rig.scene.contact.friction == 0.36);
    assert_true(rig.scene.walls[1].contact.restitution == 0.5);
    assert_true(fabs(rig.scene.walls[0].contact.friction - 0.24) < 1e-15);
    rig_close(&rig);
}

/* What check predicts of each two: steps and restitution of the values that are mixed. */
static void test_predictions(void **state)
{
    (void)state;
    Rig rig;
    OzPrediction *rows = NULL;
    int count = 0;
    open_mixture(&rig, "double", hooke, "contact_time", "2e-4");
    must(oz_prediction_rows(&rows, &count, &rig.scene, &rig.grains));
    assert_int_equal(count, 6 + 3 * 3);
    for (int i = 0; i < count; i++) {
        const OzContactValues *v = &rows[i].values;
        assert_true(fabs(rows[i].hits.mean - v->restitution) < 0.02); /* 20 to 30 steps */
        assert_true(fabs(rows[i].steps - v->contact_time / rig.scene.step) < 1e-9);
    }
    assert_int_equal(rows[4].one, 1);
    assert_int_equal(rows[4].other, 2);
    assert_true(rows[4].values.restitution == 0.8);
    assert_int_equal(rows[6].wall, 0);
    assert_true(rows[6].values.friction == 0.6);
    assert_true(rows[9 + 2].values.friction == 0.05);
    free(rows);
    rig_close(&rig);
}

/* What is written of a scene loads to the same, and a change of one value reaches all that are
 * mixed of it. A value of `contact` that no material takes may be missing. */
static void test_written_and_changed(void **state)
{
    (void)state;
    Rig rig;
    OzScene next;
    char *settings[] = {"materials.1.friction=0.64", "pairs.0.restitution=0.6"};
    rig_open(&rig, "model: rods\ntime: {step: 1e-6, duration: 1}\n" MATERIALS
                   "pairs: [{between: [glass, steel], restitution: 0.8}]\ngrains:\n"
                   "  - {kind: single, material: steel, diameter: 1e-3, position: [0, 0, 1e-3]}\n"
                   "  - {kind: single, material: glass, diameter: 1e-3, position: [0, 0, 3e-3]}\n"
                   "walls: [{kind: plane, material: glass}]\n");
    must(oz_scene_change(&next, &rig.scene, NULL, 0));
    assert_memory_equal(&next.contact, &rig.scene.contact, sizeof next.contact);
    assert_memory_equal(&next.walls[0].contact, &rig.scene.walls[0].contact, sizeof next.contact);
    assert_true(next.populations[0].density == 7800);
    oz_scene_free(&next);
    must(oz_scene_change(&next, &rig.scene, settings, 2));
    OzMixed mixed;
    oz_mixing_contact(&mixed, &next, 1);
    assert_true(mixed.values.restitution == 0.6);
    assert_true(fabs(mixed.values.friction - 0.32) < 1e-15);
    oz_mixing_contact(&mixed, &next, 4);
    assert_true(mixed.wall == 0 && fabs(mixed.values.friction - 0.32) < 1e-15);
    oz_scene_free(&next);
    rig_close(&rig);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_hit_of_two_materials),
        cmocka_unit_test(test_a_hertzian_hit_of_two_materials),
        cmocka_unit_test(test_sliding_on_another_material),
        cmocka_unit_test(test_the_ledger_closes),
        cmocka_unit_test(test_walls_alone_cost_nothing),
        cmocka_unit_test(test_predictions),
        cmocka_unit_test(test_written_and_changed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
