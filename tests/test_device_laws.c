/* The contact options in kernels against the host reference. ORZO_NEEDS_DEVICE. Each scene is a
 * program of its own, which takes seconds to compile. */
#include "device_rig.h"

/* The crowd is seen after some hits, the cluster in the middle of its squeeze. */
enum { CROWD_STEPS = 300, CLUSTER_STEPS = 60 };

/* A shaken box with a slanted lid: precision, contact keys, drag, populations. */
static const char box[] =
    "model: rods\nprecision: %s\ntime: {step: 1e-5, duration: 1}\nintegrator: %s\n"
    "observe: {ledger: true}\ncontact: {%s}\n%sgrains:\n%s\n"
    "walls:\n"
    "  - {kind: plane, motion: {frequency: 300, amplitude: 1e-4}}\n"
    "  - {kind: cylinder, diameter: 6e-3, contact: {friction: 0.2}}\n"
    "  - {kind: plane, point: [0, 0, 0.011], normal: [0.1, 0, -1]}\n";

#define HOOKE "contact_time: 3e-4, restitution: 0.5, friction: 0.4, "
#define MIXTURE                                                                                    \
    "  - {kind: random, count: 20, diameter: 0.6e-3, fill: 0.2}\n"                                 \
    "  - {kind: random, count: 20, diameter: 0.5e-3, aspect: 3, fill: 0.2}\n"                      \
    "  - {kind: random, count: 21, diameter: [0.4e-3, 0.8e-3], aspect: [0.5, 3], fill: 0.2}"
#define DRAG "drag: {viscosity: 1e-3, coefficient: 0.4, density: 1000, wind: [0.3, 0, 0.1]}\n"
/* Upright rods that touch along their length, thrown at one another. */
#define ALIGNED                                                                                    \
    "  - {kind: lattice, diameter: 0.5e-3, aspect: 3, cells: [5, 5, 1],"                           \
    " spacing: [0.501e-3, 0.501e-3, 2e-3], position: [-1e-3, -1e-3, 3e-3]}\n"                      \
    "  - {kind: lattice, diameter: 0.5e-3, aspect: 2, cells: [5, 5, 1],"                           \
    " spacing: [0.501e-3, 0.501e-3, 2e-3], position: [-1e-3, -1e-3, 5.2e-3]}"

static void assert_close(const char *what, double a, double b, double part)
{
    if (!(fabs(a - b) <= part * fmax(fabs(a), fabs(b)))) {
        fail_msg("%s: %.17g is not %.17g within %g of it", what, a, b, part);
    }
}

/* Forces and springs of every contact, within part of the largest of each. */
static void assert_same_contacts(const OzContactList *a, const OzContactList *b, double part)
{
    double push = 0, spring = 0, off_push = 0, off_spring = 0;
    double couple = 0, off_couple = 0;
    assert_int_equal(a->count, b->count);
    for (int64_t i = 0; i < a->count; i++) {
        const OzContactEntry *x = &a->entry[i], *y = &b->entry[i];
        assert_true(x->a == y->a && x->b == y->b && x->part_a == y->part_a);
        push = fmax(push, fabs(y->push));
        off_push = fmax(off_push, fabs(x->push - y->push));
        off_push = fmax(off_push, farthest(x->tangential, y->tangential, 3));
        couple = fmax(couple, sqrt(dot3(y->couple, y->couple)));
        off_couple = fmax(off_couple, farthest(x->couple, y->couple, 3));
        spring = fmax(spring, sqrt(dot3(y->spring, y->spring)));
        off_spring = fmax(off_spring, farthest(x->spring, y->spring, 3));
    }
    assert_true(push > 0 && off_push <= part * push && off_spring <= part * spring);
    assert_true(off_couple <= part * couple);
}

/* Upright rods that press against one another from all sides. */
static void squeeze(OzGrains *grains)
{
    for (int64_t i = 0; i < 3 * grains->count; i++) {
        grains->velocity[i] -= i % 3 < 2 ? 100 * grains->position[i] : 0;
    }
}

/* Rounding of one step, a thousand times larger after some hits: 1e-16 of a velocity in double,
 * 3e-8 in float. A wrong term shows in the first digits. */
static void check(const char *precision, const char *integrator, const char *contact, bool cluster,
                  double tolerance)
{
    Rig rig;
    int steps = cluster ? CLUSTER_STEPS : CROWD_STEPS;
    rig_open(&rig, box, precision, integrator, contact, cluster ? DRAG : "",
             cluster ? ALIGNED : MIXTURE);
    throw_grains(&rig.grains, cluster ? 0.02 : 0.4, 20);
    if (cluster) {
        squeeze(&rig.grains);
    }
    OzSnapshot seen = state_after(&rig, NATIVE, steps);
    rig_start(&rig);
    rig_advance(&rig, steps);
    double off = farthest(seen.velocity, rig.now.velocity, 3 * seen.count);
    off = fmax(off, farthest(seen.axis, rig.now.axis, 3 * seen.count));
    if (!(off < tolerance &&
          farthest(seen.position, rig.now.position, 3 * seen.count) < tolerance)) {
        fail_msg("%s: off by %g", contact, off);
    }
    assert_true(oz_contact_list_sum(&seen.contacts).pairs > (cluster ? 20 : 0) &&
                seen.ledger.dissipated > 0);
    assert_int_equal(oz_contact_list_sum(&seen.contacts).pairs,
                     oz_contact_list_sum(&rig.now.contacts).pairs);
    assert_same_contacts(&seen.contacts, &rig.now.contacts, 1e3 * tolerance);
    assert_close("elastic", seen.ledger.elastic, rig.now.ledger.elastic, 1e3 * tolerance);
    assert_close("dissipated", seen.ledger.dissipated, rig.now.ledger.dissipated, 1e3 * tolerance);
    assert_close("friction", seen.ledger.friction, rig.now.ledger.friction, 1e3 * tolerance);
    oz_snapshot_free(&seen);
    rig_close(&rig);
}

static void test_line(void **state)
{
    (void)state;
    check("double", "velocity-verlet", HOOKE "parallel: line", true, 1e-9);
}

static void test_smooth_damping_of_the_contacts_own_mass(void **state)
{
    (void)state;
    check("double", "velocity-verlet",
          HOOKE "damping: smooth, restitution_at: contact, restitution_calibration: discrete",
          false, 1e-9);
}

static void test_hertz_mindlin(void **state)
{
    (void)state;
    check("double", "symplectic-euler",
          "law: hertz-mindlin, youngs_modulus: 3e6, poisson_ratio: 0.3, restitution: 0.5, "
          "friction: 0.4, rolling_friction: 0.2, twisting_friction: 0.1, surface_energy: 1e-3",
          false, 1e-9);
}

/* Float, with everything on that can be. */
static void test_options_together(void **state)
{
    (void)state;
    check(
        "float", "symplectic-euler",
        "law: hertz, hertz_stiffness: 2e3, normal_damping_rate: 2e3, tangential_damping_rate: 3e3,"
        " friction: 0.4, parallel: line, attraction: clamp, rolling: constant, rolling_friction: "
        "0.2, "
        "surface_energy: 1e-3",
        true, 1e-2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_line),
        cmocka_unit_test(test_smooth_damping_of_the_contacts_own_mass),
        cmocka_unit_test(test_hertz_mindlin),
        cmocka_unit_test(test_options_together),
    };
    return cmocka_run_group_tests(tests, open_rig_device, close_rig_device);
}
