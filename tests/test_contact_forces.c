/* What a contact does, against mechanics' closed forms: stored energies, stiffnesses along the
 * contact, where the force acts, how the tangential spring turns. */
#include "rig.h"

#include "model/contact.h"

#include "sim/dialect.h"

static const double radius = 0.5e-3, mass = 2e-6;

/* A contact of two bodies without sliding. */
static OzContact contact_at(double overlap, double rate)
{
    return (OzContact){.normal = {0, 0, 1},
                       .overlap = overlap,
                       .rate = rate,
                       .velocity = {0, 0, -rate},
                       .mass = mass,
                       .radius = radius / 2,
                       .lightness = 1,
                       .touching = 1};
}

static OzLawConstants constants_of(const char *contact, int law)
{
    Rig rig;
    rig_open(&rig, "model: rods\ntime: {step: 1e-6, duration: 1}\ncontact: {%s}\ngrains: []\n",
             contact);
    OzContactConstants c = oz_contact_constants_of(&rig.scene.contact, &rig.scene.contact);
    rig_close(&rig);
    oz_host_switches_rods(&(OzSwitches){.law = law, .friction = 1, .history = 1});
    return (OzLawConstants){.stiffness = c.stiffness,
                            .damping = c.damping,
                            .tangential_stiffness = c.tangential_stiffness,
                            .tangential_damping = c.tangential_damping,
                            .friction = 1e9};
}

static const char *const laws[] = {
    [OZ_LAW_HOOKE] = "contact_time: 1e-4, restitution: 0.5",
    [OZ_LAW_HERTZ] = "law: hertz, hertz_stiffness: 1e6, normal_damping_rate: 1e3, "
                     "tangential_damping_rate: 1e2",
    [OZ_LAW_HERTZ_MINDLIN] = "law: hertz-mindlin, youngs_modulus: 1e8, poisson_ratio: 0.3, "
                             "restitution: 0.5",
};

/* The energy is the spring's work on the way in. Simpson's rule on overlaps that grow as the square
 * of its variable, which makes polynomials of what is integrated: exact but for rounding. */
static void test_energy_is_the_springs_work(void **state)
{
    (void)state;
    enum { PANELS = 200 };
    for (int law = OZ_LAW_HOOKE; law <= OZ_LAW_HERTZ_MINDLIN; law++) {
        OzLawConstants constants = constants_of(laws[law], law);
        double deepest = 2e-5, work = 0;
        for (int i = 0; i <= PANELS; i++) {
            double s = (double)i / PANELS, weight = i == 0 || i == PANELS ? 1 : i % 2 ? 4 : 2;
            OzResponse at = oz_contact_response(contact_at(s * s * deepest, 0), constants);
            work += weight / (3 * PANELS) * at.spring * 2 * s * deepest;
        }
        OzResponse last = oz_contact_response(contact_at(deepest, 0), constants);
        /* the rule's own error for the sixth power is 1e-8 at 200 panels */
        assert_true(fabs(last.energy / work - 1) < 1e-7);
    }
}

/* Mindlin (1949): the stiffness along the contact over that across it is 2 (1 - nu) / (2 - nu),
 * whatever modulus, radius and overlap; across it is dF/dx = 3/2 F / x. */
static void test_mindlins_ratio(void **state)
{
    (void)state;
    OzLawConstants constants = constants_of(laws[OZ_LAW_HERTZ_MINDLIN], OZ_LAW_HERTZ_MINDLIN);
    for (double overlap = 1e-8; overlap < 1e-4; overlap *= 10) {
        OzResponse at = oz_contact_response(contact_at(overlap, 0), constants);
        double normal = 1.5 * at.spring / overlap;
        /* rounding of products and roots, as below: 2e-16 each */
        assert_true(fabs(at.tangential_stiffness / normal / (2 * 0.7 / 1.7) - 1) < 1e-14);
    }
}

/* `restitution_at: contact`: what feels the contact is an oscillator of the mass lightness^2 m,
 * whose damping ratio c / (2 sqrt(k m_c)) is that of a central hit: so the dashpot of m at
 * lightness l is that of a body of l^2 m which turns not, with the spring that m has. */
static void test_damping_of_the_mass_that_is_felt(void **state)
{
    (void)state;
    for (int law = OZ_LAW_HOOKE; law <= OZ_LAW_HERTZ_MINDLIN; law += 2) {
        OzLawConstants constants = constants_of(laws[law], law);
        OzContact felt = contact_at(1e-5, 0.1), whole = felt;
        oz_host_switches_now.rods.at_contact = 1;
        felt.lightness = 0.4;
        OzResponse light = oz_contact_response(felt, constants);
        OzResponse central = oz_contact_response(whole, constants);
        double ratio_light = light.dashpot / sqrt(light.spring * 0.16 * mass);
        double ratio_central = central.dashpot / sqrt(central.spring * mass);
        /* the ratio to rounding of some products and roots */
        assert_true(light.spring == central.spring);
        assert_true(fabs(ratio_light / ratio_central - 1) < 1e-14);
    }
}

/* The dashpot along a Mindlin contact is the share asked of the one across it. */
static void test_mindlins_tangential_dashpot(void **state)
{
    (void)state;
    OzLawConstants constants = constants_of(
        "law: hertz-mindlin, youngs_modulus: 1e8, poisson_ratio: 0.3, restitution: 0.5, "
        "tangential_damping: 0.3",
        OZ_LAW_HERTZ_MINDLIN);
    OzResponse at = oz_contact_response(contact_at(1e-5, 0.1), constants);
    /* two products' rounding */
    assert_true(fabs(at.tangential_damping / (0.3 * at.dashpot / 0.1) - 1) < 1e-14);
}

/* Two bodies about a contact at the upper one's end: what they are as one. */
static OzContact pair_contact(OzGrain a, OzGrain b)
{
    OzVec3 arm_a, arm_b,
        apart = oz_vec3(a.position.x - b.position.x, 0, a.position.z - b.position.z);
    OzClosest at = {0, -1};
    mask crossed;
    return oz_grain_contact(a, b, apart, at, &arm_a, &arm_b, &crossed);
}

/* 1/m* = 1/m_a + 1/m_b, 1/R* likewise; what a push meets is 1/m_a + 1/m_b + lever^2/I, where a rod
 * is hit at its end from below, and lightness is the root of that mass over m*. */
static void test_two_bodies_as_one(void **state)
{
    (void)state;
    OzGrain sphere = {.radius = 1e-3, .mass = 3e-6, .inverse_inertia = 1e6};
    OzGrain rod = {.position = {2e-3, 0, 2.99e-3}, .radius = 2e-3, .mass = 6e-6};
    rod.half_shaft = (OzVec3){2e-3, 0, 0};
    rod.inverse_inertia = 1 / 8e-12;
    oz_host_switches_rods(&(OzSwitches){.law = OZ_LAW_HERTZ_MINDLIN, .at_contact = 1});
    OzContact unlike = pair_contact(sphere, rod);
    /* rounding of products and quotients */
    assert_true(fabs(unlike.mass / 2e-6 - 1) < 1e-14);
    assert_true(fabs(unlike.radius / (2e-3 / 3) - 1) < 1e-14);
    double felt = 1 / (1 / 3e-6 + 1 / 6e-6 + 4e-6 / 8e-12);
    /* rounding; the overlap is 1e-5 of coordinates of 3e-3, which have 4e-19 as last digit */
    assert_true(fabs(unlike.lightness / sqrt(felt / 2e-6) - 1) < 1e-14);
    assert_true(fabs(unlike.overlap / 1e-5 - 1) < 1e-12 && fabs(unlike.normal.z - 1) < 1e-14);
    oz_host_switches_rods(&(OzSwitches){.law = OZ_LAW_HERTZ_MINDLIN, .equal = 1, .round = 1});
    OzGrain other = sphere;
    other.position.z = 1.9e-3;
    OzContact alike = pair_contact(sphere, other);
    /* rounding */
    assert_true(fabs(alike.mass / 1.5e-6 - 1) < 1e-14);
    assert_true(fabs(alike.radius / 0.5e-3 - 1) < 1e-14 && alike.lightness == 1);
}

/* A pair that turns as one body turns its spring along: the length stays, and so does the angle to
 * the normal and to the pair's axis of turning. Of one turn by a small angle, the fourth power of
 * it is what the series leaves (3/8 of it in the plane of the turn). */
static void test_spring_turns_with_the_pair(void **state)
{
    (void)state;
    for (double angle = 1e-3; angle < 0.2; angle *= 3) {
        OzVec3 turned = {sin(angle), 0, cos(angle)}, along = {cos(angle), 0, -sin(angle)};
        OzVec3 spring = oz_contact_turn(oz_vec3(3e-6, 0, 0), turned);
        /* 3/8 of the fourth power; projected: across the normal, but for rounding */
        assert_true(fabs(oz_dot(spring, along) / 3e-6 - 1) < 0.4 * pow(angle, 4) + 1e-15);
        assert_true(fabs(oz_dot(spring, turned)) < 1e-15 * 3e-6);
        spring = oz_contact_turn(oz_vec3(0, 2e-6, 0), turned);
        assert_true(spring.x == 0 && spring.y == 2e-6 && spring.z == 0);
    }
    /* a quarter of a round in 2000 turns: their fourth powers, summed, times 3/8: 2.85e-10 */
    OzVec3 spring = {0, 0, 1e-6};
    for (int i = 1; i <= 2000; i++) {
        double angle = 2 * atan(1) * i / 2000;
        spring = oz_contact_turn(spring, oz_vec3(cos(angle), 0, sin(angle)));
    }
    /* 2.85e-16 of a length of 1e-6 */
    assert_true(fabs(spring.x + 1e-6) < 3e-16 && fabs(spring.z) < 3e-16);
}

/* Cundall & Strack (1979): a contact that slides carries friction's limit and no more, and its
 * spring is cut to what the dashpot leaves of it; one that sticks keeps spring and dashpot as they
 * are. Of a step that advances the spring before the force (share 1), that is what is stored. */
static void test_spring_of_a_sliding_contact(void **state)
{
    (void)state;
    OzLawConstants constants = constants_of(laws[OZ_LAW_HOOKE], OZ_LAW_HOOKE);
    OzContact contact = contact_at(1e-5, 0);
    contact.velocity = (OzVec3){-0.3, 0.4, 0}; /* b against a */
    for (int slides = 0; slides < 2; slides++) {
        OzMemory memory = {.stretch = {3e-6, -4e-6, 0}};
        OzVec3 before = memory.stretch;
        double dt = 1e-6, stiffness = mass * constants.tangential_stiffness;
        double dashpot = mass * constants.tangential_damping * 0.5;
        double limit = mass * constants.stiffness * 1e-5 * (constants.friction = slides ? 0.05 : 5);
        OzContactForce force = oz_contact_force(contact, constants, &memory, dt, 1);
        OzVec3 spring = memory.stretch;
        /* along (3, -4) / 5, against the sliding */
        double carried = (0.6 * spring.x - 0.8 * spring.y) * stiffness;
        double tangential = 0.6 * force.force.x - 0.8 * force.force.y;
        double stretched = (0.6 * before.x - 0.8 * before.y + dt * 0.5) * stiffness;
        /* each to the rounding of sums of some products */
        assert_true(fabs(tangential / (slides ? limit : stretched + dashpot) - 1) < 1e-13);
        assert_true(fabs(carried + dashpot - tangential) < 1e-13 * tangential);
        assert_true(fabs(0.8 * spring.x + 0.6 * spring.y) < 1e-20);
        /* what sliding takes is friction's: no dashpot's, no spring's */
        double noted = 0.6 * force.dashpot.x - 0.8 * force.dashpot.y;
        assert_true(fabs(noted - (slides ? 0 : dashpot)) < 1e-13 * dashpot);
    }
}

/* Where a dashpot pulls at a contact's end, friction's limit is mu times what it pulls with, and
 * friction still is against the sliding. */
static void test_friction_of_a_contact_that_pulls(void **state)
{
    (void)state;
    OzLawConstants constants = constants_of(laws[OZ_LAW_HOOKE], OZ_LAW_HOOKE);
    constants.friction = 0.3;
    OzContact contact = contact_at(1e-7, -0.2); /* parting */
    contact.velocity.x = 0.5;
    OzMemory memory = {.stretch = {0, 0, 0}};
    OzContactForce force = oz_contact_force(contact, constants, &memory, 1e-6, 1);
    double pull = mass * (constants.damping * 0.2 - constants.stiffness * 1e-7);
    /* rounding of some products */
    assert_true(pull > 0 && fabs(force.force.z / -pull - 1) < 1e-14);
    assert_true(fabs(force.force.x / (-0.3 * pull) - 1) < 1e-14);
}

/* A sphere pressed into the floor by a tenth of its radius, sliding: one step of the law. */
static void slide(const char *point, double *fall, double *slow, double *turn)
{
    Rig rig;
    rig_open(&rig,
             "model: rods\ntime: {step: 1e-7, duration: 1}\nintegrator: symplectic-euler\n"
             "gravity: [0, 0, 0]\n"
             "contact: {contact_time: 1e-4, restitution: 1, friction: 0.25, contact_point: %s}\n"
             "grains: [{kind: single, diameter: 1e-3, position: [0, 0, 0.45e-3],"
             " velocity: [1000, 0, 0]}]\nwalls: [{kind: plane}]\n",
             point);
    rig_start(&rig);
    rig_advance(&rig, 1);
    *fall = rig.now.velocity[2] / 1e-7;
    *slow = (1000 - rig.now.velocity[0]) / 1e-7;
    *turn = rig.now.angular_velocity[1] / 1e-7;
    rig_close(&rig);
}

/* Coulomb: friction is mu N = mu k xi. It acts at the wall, half the overlap above its lowest point
 * (`midpoint`) or at the lowest point of the sphere itself (`surfaces`), and turns a sphere of
 * 2/5 m r^2 by its lever. Rounding alone, of a speed whose last digit is 1e-10 of the change. */
static void test_where_a_walls_force_acts(void **state)
{
    (void)state;
    const double pi = 4 * atan(1);
    double fall, slow, turn, overlap = 0.05e-3, r = 0.5e-3;
    for (int surfaces = 0; surfaces < 2; surfaces++) {
        slide(surfaces ? "surfaces" : "midpoint", &fall, &slow, &turn);
        double pressed = pi * pi / (1e-4 * 1e-4) * overlap;
        double lever = surfaces ? r : r - overlap / 2;
        /* the fall starts from rest: rounding of products; the last digit of 1000 m/s is 1e-10 of
         * what friction takes; the turn starts from rest too */
        assert_true(fabs(fall / pressed - 1) < 1e-14);
        assert_true(fabs(slow / (0.25 * pressed) - 1) < 1e-9);
        assert_true(fabs(turn / (0.25 * pressed * lever / (0.4 * r * r)) - 1) < 1e-14);
    }
}

/* How much of the spring's pull on a grain that begins to slide (and sticks) is felt in the first
 * step: explicit Euler looks before it moves, symplectic Euler at the step just made, and Verlet,
 * which weights the force at its end by 1/2, at the mean of both. */
static void test_springs_share_of_the_first_step(void **state)
{
    (void)state;
    static const double shares[INTEGRATORS] = {0, 1, 0.25};
    const double pi = 4 * atan(1), dt = 1e-6, speed = 1e-3;
    double pull = 2.0 / 7 * pi * pi / (1e-4 * 1e-4) * dt * dt * speed; /* kappa_t v dt^2 */
    for (int i = 0; i < INTEGRATORS; i++) {
        Rig rig;
        rig_open(&rig,
                 "model: rods\ntime: {step: 1e-6, duration: 1}\nintegrator: %s\n"
                 "gravity: [0, 0, 0]\ncontact: {contact_time: 1e-4, restitution: 1, friction: 9}\n"
                 "grains: [{kind: single, diameter: 1e-3, position: [0, 0, 0.499e-3],"
                 " velocity: [1e-3, 0, 0]}]\nwalls: [{kind: plane}]\n",
                 integrator_names[i]);
        rig_start(&rig);
        rig_advance(&rig, 1);
        /* the speed's last digit is 1e-13 of the pull, 3e-4 of the speed */
        assert_true(fabs((speed - rig.now.velocity[0]) / pull - shares[i]) < 1e-12);
        rig_close(&rig);
    }
}

/* A sphere pressed into a round wall aside of both axes is pushed to the wall's axis. */
static void test_round_wall_pushes_inward(void **state)
{
    (void)state;
    Rig rig;
    const double pi = 4 * atan(1), overlap = 1e-5;
    rig_open(&rig, "model: rods\ntime: {step: 1e-7, duration: 1}\nintegrator: symplectic-euler\n"
                   "gravity: [0, 0, 0]\ncontact: {contact_time: 1e-4, restitution: 1}\n"
                   "grains: [{kind: single, diameter: 1e-3, position: [-1.506e-3, 2.008e-3, 1]}]\n"
                   "walls: [{kind: cylinder, diameter: 6e-3}]\n");
    rig_start(&rig);
    /* the overlap is 1e-5 of coordinates of 3e-3 with a last digit of 4e-19: 1e-13 */
    assert_true(fabs(oz_contact_list_sum(&rig.now.contacts).overlap_max / overlap - 1) < 1e-12);
    rig_advance(&rig, 1);
    double pushed = pi * pi / (1e-4 * 1e-4) * overlap * 1e-7;
    /* and so is what it pushes with */
    assert_true(fabs(rig.now.velocity[0] / (0.6 * pushed) - 1) < 1e-12);
    assert_true(fabs(rig.now.velocity[1] / (-0.8 * pushed) - 1) < 1e-12);
    assert_true(rig.now.velocity[2] == 0);
    rig_close(&rig);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_energy_is_the_springs_work),
        cmocka_unit_test(test_mindlins_ratio),
        cmocka_unit_test(test_damping_of_the_mass_that_is_felt),
        cmocka_unit_test(test_mindlins_tangential_dashpot),
        cmocka_unit_test(test_two_bodies_as_one),
        cmocka_unit_test(test_spring_turns_with_the_pair),
        cmocka_unit_test(test_spring_of_a_sliding_contact),
        cmocka_unit_test(test_friction_of_a_contact_that_pulls),
        cmocka_unit_test(test_where_a_walls_force_acts),
        cmocka_unit_test(test_springs_share_of_the_first_step),
        cmocka_unit_test(test_round_wall_pushes_inward),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
