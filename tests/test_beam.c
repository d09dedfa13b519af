/* Beams: free vibration of two triangles against closed forms, energy as the force's potential, and
 * what conserves momentum and angular momentum. */
#include "element_rig.h"

static const double pi = 3.14159265358979323846;
static const double rest[2] = {0, 0};

/* Two triangles alike, mirrored about the y axis, and a beam along x. No gravity. */
static void open_pair(ElementRig *rig, const char *shear, double step)
{
    rig_read(rig,
             "gravity: [0, 0]\nintegrator: gear4\nobserve: {ledger: true}\n"
             "time: {step: %.17g, duration: 1}\nbeams: {damping_shear: %s}",
             step, shear);
    rig_pair(rig);
}

/* Elongation, and the bending angles of both ends, now. */
typedef struct Bend {
    double elongation, a, b;
} Bend;

static Bend bend_of(const ElementRig *rig)
{
    const OzElements *elements = rig->grains.elements;
    const double *x = rig->now.element_position, *angle = rig->now.element_angle;
    double direction = atan2(x[3] - x[1], x[2] - x[0]);
    return (Bend){hypot(x[2] - x[0], x[3] - x[1]) - elements->beam_length[0],
                  angle[0] - direction - elements->beam_rest_a[0],
                  angle[1] - direction - elements->beam_rest_b[0]};
}

typedef enum Mode { AXIAL, SYMMETRIC, ANTISYMMETRIC } Mode;

/* Rates of one mode alone, small enough for what is not linear to stay below 1e-8. */
static void push_mode(OzElements *elements, Mode mode)
{
    const double small = 1e-2; /* rad/s: angles of some 1e-6 */
    double length = elements->beam_length[0];
    if (mode == AXIAL) {
        elements->velocity[0] = -1e-5;
        elements->velocity[2] = 1e-5;
        return;
    }
    elements->angular_velocity[0] = small;
    elements->angular_velocity[1] = mode == SYMMETRIC ? -small : small;
    if (mode == ANTISYMMETRIC) {
        double turning = -4 * small * elements->inertia[0] / (elements->mass[0] * length * length);
        elements->velocity[1] = -0.5 * length * turning;
        elements->velocity[3] = 0.5 * length * turning;
    }
}

/* Of y = exp(-decay t) cos(frequency t + phase): four samples h apart give both. */
static void solve_samples(const double y[4], double h, double *frequency, double *decay)
{
    double determinant = y[1] * y[1] - y[0] * y[2];
    double p = (y[1] * y[2] - y[0] * y[3]) / determinant;
    double q = (y[2] * y[2] - y[1] * y[3]) / determinant;
    *decay = -log(q) / (2 * h);
    *frequency = acos(p / (2 * sqrt(q))) / h;
}

/* Undamped angular frequency and decay rate expected (physics: two triangles m, J and a beam). */
static void expect_mode(const OzScene *scene, const OzElements *elements, Mode mode, double *omega0,
                        double *decay)
{
    double m = elements->mass[0], inertia = elements->inertia[0], length = elements->beam_length[0];
    double bending = scene->beams.stiffness * scene->beams.second_moment;
    double damping = scene->beams.damping * scene->beams.second_moment;
    double swing = 1 + 4 * inertia / (m * length * length);
    bool balanced = scene->beams.damping_shear == OZ_SHEAR_BALANCED;
    switch (mode) {
    case AXIAL:
        *omega0 = sqrt(2 * scene->beams.stiffness / m);
        *decay = scene->beams.damping / m;
        break;
    case SYMMETRIC:
        *omega0 = sqrt(2 * bending / (length * inertia));
        *decay = damping / (2 * length * inertia);
        break;
    default:
        *omega0 = sqrt(6 * bending / (length * inertia) * swing);
        *decay = damping / (2 * length * inertia) * (balanced ? swing : 1);
    }
}

/* Gear's error at 1000 steps a period is below 1e-9. */
static void check_mode(const char *shear, Mode mode)
{
    ElementRig rig;
    double omega0, decay, found, found_decay, y[4];
    open_pair(&rig, shear, 1e-7);
    push_mode(rig.grains.elements, mode);
    expect_mode(&rig.scene, rig.grains.elements, mode, &omega0, &decay);
    double frequency = sqrt(omega0 * omega0 - decay * decay);
    int64_t between = (int64_t)(2 * pi / frequency / 8 / rig.scene.step);
    rig_start(&rig);
    for (int k = 0; k < 4; k++) {
        rig_advance(&rig, (k + 1) * between);
        Bend bend = bend_of(&rig);
        y[k] = mode == AXIAL ? bend.elongation : bend.a;
        double other = mode == ANTISYMMETRIC ? bend.a : -bend.a;
        /* alike by symmetry, but for rounding */
        assert_true(mode == AXIAL || fabs(bend.b - other) < 1e-11 * fabs(bend.a));
    }
    solve_samples(y, (double)between * rig.scene.step, &found, &found_decay);
    print_message("mode %d %s: frequency %.9g of %.9g, decay %.9g of %.9g\n", (int)mode, shear,
                  found, frequency, found_decay, decay);
    /* what is not linear is 1e-8 of it, some times more through the four samples: 5e-8 */
    assert_true(fabs(found / frequency - 1) < 3e-7);
    assert_true(fabs(found_decay / decay - 1) < 3e-7);
    rig_close(&rig);
}

static void test_modes(void **state)
{
    (void)state;
    for (int mode = AXIAL; mode <= ANTISYMMETRIC; mode++) {
        check_mode("none", (Mode)mode);
        check_mode("balanced", (Mode)mode);
    }
}

/* A grain of four triangles set into wild motion, bent by a tenth of a radian. */
static void check_momentum(const char *shear, double angular_change)
{
    ElementRig rig;
    double before[3], after[3];
    rig_read(&rig,
             "gravity: [0, 0]\nintegrator: rk4\nobserve: {ledger: true}\n"
             "time: {step: 1e-6, duration: 1}\nbeams: {damping_shear: %s}",
             shear);
    rig_wild_square(&rig, 600);
    rig_start(&rig);
    rig_momentum(&rig.now, before);
    double energy = rig_energy(&rig.now), most = 0;
    for (int64_t step = 50; step <= 2000; step += 50) {
        rig_advance(&rig, step);
        most = fmax(most, rig.now.beams.bend_max);
    }
    rig_momentum(&rig.now, after);
    /* 2000 additions of numbers whose largest is the momentum: 1e-13 of it is some hundred of its
     * last digits; the angular momentum also has rk4's error, of fifth order */
    double size = hypot(before[0], before[1]), arm = size * 1e-3;
    assert_true(fabs(after[0] - before[0]) < 1e-13 * size);
    assert_true(fabs(after[1] - before[1]) < 1e-13 * size);
    double change = fabs(after[2] - before[2]) / arm;
    print_message("%s: bent by up to %.2f rad; angular momentum changed by %.1e\n", shear, most,
                  change);
    /* rk4's error in angular momentum: 5e-13 */
    assert_true(angular_change > 0 ? change > angular_change : change < 1e-11);
    assert_true(most > 0.05);
    OzElementLedger l = rig.now.element_ledger;
    double lost = l.beam_axial + l.beam_bending;
    /* rk4's error, of fifth order in a step: 3e-10 */
    assert_true(fabs(rig_energy(&rig.now) + lost - energy) < 1e-9 * energy);
    assert_true(lost > 0.5 * energy);
    rig_close(&rig);
}

static void test_momentum(void **state)
{
    (void)state;
    check_momentum("balanced", 0);
    check_momentum("none", 1e-3);
}

/* A turn by whole turns bends nothing: angles are not wrapped anywhere but in the beam. */
static void test_turning(void **state)
{
    (void)state;
    ElementRig rig;
    rig_read(&rig, "gravity: [0, 0]\nintegrator: rk4\ntime: {step: 1e-6, duration: 1}");
    rig_grains(&rig, 1, 4, 4);
    rig_square(&rig, 0, 2e-3, rest, 0, rest, 4);
    OzElements *elements = rig.grains.elements;
    for (int i = 0; i < 4; i++) {
        double x = elements->position[2 * i], y = elements->position[2 * i + 1], turn = 31;
        elements->position[2 * i] = cos(turn) * x - sin(turn) * y;
        elements->position[2 * i + 1] = sin(turn) * x + cos(turn) * y;
        elements->angle[i] += turn;
    }
    rig_start(&rig);
    /* the last digit of an angle of 31 rad is 4e-15; energy goes with its square */
    assert_true(rig.now.beams.bend_max < 2e-14);
    assert_true(rig.now.beams.energy < 1e-31);
    rig_close(&rig);
}

/* A beam is at rest in the state that it is made in, whatever its elements' angles there. */
static void test_rest(void **state)
{
    (void)state;
    ElementRig rig;
    open_pair(&rig, "balanced", 1e-7);
    OzElements *elements = rig.grains.elements;
    elements->angle[0] = 0.4;
    elements->angle[1] = -0.3;
    elements->position[3] = 1e-3;
    oz_elements_rest_beam(elements, 0);
    rig_start(&rig);
    /* a last digit of angles below 1 rad */
    assert_true(rig.now.beams.bend_max < 1e-15);
    assert_true(rig.now.beams.stretch_max == 1 && rig.now.beams.stretch_min == 1);
    rig_close(&rig);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_modes),
        cmocka_unit_test(test_momentum),
        cmocka_unit_test(test_turning),
        cmocka_unit_test(test_rest),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
