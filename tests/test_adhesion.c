/* Adhesion in the host reference: contacts that pull with 2 pi w R* while bodies overlap
 * (Derjaguin, Muller & Toporov 1975), against their closed forms. */
#include "rig.h"

#include "model/contact.h"

static const double pi = 3.14159265358979323846, diameter = 1e-3, energy = 1e-3;

static const char *const laws[] = {
    "contact_time: 1e-4, restitution: 0.5, friction: 0.3",
    "law: hertz-mindlin, youngs_modulus: 1e8, poisson_ratio: 0.3, restitution: 0.5, friction: 0.3"};

/* A sphere under a ceiling falls off where it weighs more than 2 pi w R, whatever the law: it
 * begins where the spring bears a thousandth of that, as when it weighs the rest. */
static void test_pull_off_at_a_wall(void **state)
{
    (void)state;
    for (int k = 0; k < 4; k++) {
        Rig rig;
        rig_open(&rig,
                 "model: rods\ntime: {step: 3e-6, duration: 1}\nintegrator: velocity-verlet\n"
                 "contact: {%s, surface_energy: %g}\n"
                 "grains: [{kind: single, diameter: 1e-3, position: [0, 0, -0.5e-3]}]\n"
                 "walls: [{kind: plane, normal: [0, 0, -1]}]\n",
                 laws[k / 2], energy);
        double pull = 2 * pi * energy * diameter / 2, mass = rig.grains.mass[0];
        double stiffness =
            oz_contact_constants_of(&rig.scene.contact, &rig.scene.contact).stiffness;
        rig.grains.position[2] += k / 2
                                      ? pow(1e-3 * pull / (stiffness * sqrt(diameter / 2)), 2.0 / 3)
                                      : 1e-3 * pull / (mass * stiffness);
        rig.scene.gravity[2] = -(k % 2 ? 1.001 : 0.999) * pull / mass;
        rig_start(&rig);
        rig_advance(&rig, 20000);
        assert_int_equal(oz_contact_list_sum(&rig.now.contacts).walls, k % 2 ? 0 : 1);
        rig_close(&rig);
    }
}

/* Two free spheres that touch rest where the spring m* kappa xi bears 2 pi w R*, of 1/R* = 2/R. */
static void test_two_spheres_hold_each_other(void **state)
{
    (void)state;
    Rig rig;
    rig_open(&rig,
             "model: rods\ntime: {step: 3e-6, duration: 1}\nintegrator: velocity-verlet\n"
             "gravity: [0, 0, 0]\ncontact: {%s, surface_energy: %g}\ngrains:\n"
             "  - {kind: single, diameter: 1e-3, position: [0, 0, 0]}\n"
             "  - {kind: single, diameter: 1e-3, position: [0.999999e-3, 0, 0]}\n",
             laws[0], energy);
    double kappa = oz_contact_constants(&rig.scene.contact).stiffness;
    double depth = 2 * pi * energy * diameter / 4 / (0.5 * rig.grains.mass[0] * kappa);
    rig_start(&rig);
    rig_advance(&rig, 10000);
    OzContactSums sums = oz_contact_list_sum(&rig.now.contacts);
    assert_int_equal(sums.pairs, 1);
    /* a depth of 2e-9 m is a difference of places of 1e-3 m: 1e-10 of it */
    assert_true(fabs(sums.overlap_max / depth - 1) < 1e-8);
    /* half of what adhesion gave is in the spring */
    double stored = -0.5 * 2 * pi * energy * diameter / 4 * depth;
    assert_true(fabs(sums.energy / stored - 1) < 1e-8);
    rig_close(&rig);
}

/* Friction goes by what presses without adhesion: a sphere that weighs nothing is held at a wall by
 * 2 pi w R and slides when pulled along with more than mu times that. */
static void test_friction_of_what_sticks(void **state)
{
    (void)state;
    for (int slides = 0; slides < 2; slides++) {
        Rig rig;
        rig_open(&rig,
                 "model: rods\ntime: {step: 3e-6, duration: 1}\nintegrator: velocity-verlet\n"
                 "contact: {%s, surface_energy: %g, rolling_friction: 1}\n"
                 "grains: [{kind: single, diameter: 1e-3, position: [0, 0, 0.499999e-3]}]\n"
                 "walls: [{kind: plane}]\n",
                 laws[0], energy);
        double pull = 2 * pi * energy * diameter / 2 / rig.grains.mass[0];
        double along = (slides ? 1.1 : 0.9) * 0.3 * pull;
        memset(rig.scene.gravity, 0, sizeof rig.scene.gravity);
        rig_start(&rig);
        rig_advance(&rig, 5000);
        memcpy(rig.grains.position, rig.now.position, 3 * sizeof(double));
        rig.scene.gravity[0] = along;
        rig_start(&rig);
        rig_advance(&rig, 10000);
        double speed = slides ? (along - 0.3 * pull) * rig.now.time : 0;
        /* the spring takes up 1e-3 of the time; rolling yields to 1e-3 of sliding */
        assert_true(fabs(rig.now.velocity[0] - speed) < 1e-2 * along * rig.now.time);
        rig_close(&rig);
    }
}

/* Rods and spheres that stick to each other and to walls with edges: what the ledger does not
 * account for. */
static void test_the_ledger_closes(void **state)
{
    (void)state;
    Rig rig;
    rig_open(&rig,
             "model: rods\nseed: 3\ntime: {step: 1e-5, duration: 1}\nobserve: {ledger: true}\n"
             "integrator: velocity-verlet\ncontact: {contact_time: 6e-4, restitution: 0.5, "
             "friction: 0.3, surface_energy: 1e-2, parallel: line}\ngrains:\n"
             "  - {kind: random, count: 24, diameter: 1e-3, aspect: [2, 4], fill: 0.2}\n"
             "  - {kind: random, count: 12, diameter: [0.8e-3, 1.5e-3], fill: 0.2}\nwalls:\n"
             "  - {kind: cylinder, diameter: 7e-3}\n"
             "  - {kind: plane, motion: {frequency: 30, acceleration_ratio: 3}}\n"
             "  - {kind: disc, point: [0, 0, 4e-3], diameter: 2e-3}\n");
    rig_start(&rig);
    double before = mechanical_energy(&rig.now) + rig.now.ledger.elastic;
    rig_advance(&rig, 10000);
    const OzLedger *l = &rig.now.ledger;
    double after = mechanical_energy(&rig.now) + l->elastic;
    double residual = after - before + l->dissipated + l->friction - l->work_walls;
    /* a hundredth is what users are promised */
    assert_true(fabs(residual) < 0.01 * (l->dissipated + l->friction));
    rig_close(&rig);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_pull_off_at_a_wall),
        cmocka_unit_test(test_two_spheres_hold_each_other),
        cmocka_unit_test(test_friction_of_what_sticks),
        cmocka_unit_test(test_the_ledger_closes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
