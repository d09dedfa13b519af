/* Light contacts in single precision: how wrong a motion is by how many digits its overlaps have.
 * Grains that must roll do so, hits return what double returns, down to overlaps far below a
 * place's unit, on planes and cylinders, of spheres and rods; what float cannot hold is refused by
 * name. ORZO_NEEDS_DEVICE. */
#include "device_rig.h"

#include "run/members.h"
#include "sim/constants.h"
#include "sim/resolution.h"

/* A rod and a sphere of 5 mm above a slope, in an upright cylinder: one set of kernels for all
 * cases. */
static const char bed[] =
    "model: rods\n"
    "gravity: [%.17g, 0, %.17g]\n"
    "time: {step: %.17g, duration: %.17g}\n"
    "contact: {contact_time: %.17g, restitution: 0.4, friction: 0.3}\n"
    "grains:\n"
    "  - {kind: single, diameter: 5e-3, aspect: 0, position: [0, 0, %.17g]}\n"
    "  - {kind: single, diameter: 5e-3, aspect: 4, axis: [0, 1, 0], position: [0, 0.02, 0.01]}\n"
    "walls:\n"
    "  - {kind: plane, normal: [%.17g, 0, %.17g], motion: {frequency: 1e-3, amplitude: 1e-3}}\n"
    "  - {kind: cylinder, diameter: 0.1}\n";

static const double contact_time = 1e-3, gravity = 9.81, diameter = 5e-3;
static const double rise = 6.283185307179586e-6; /* m/s, of the slope */
enum { STEPS = 3000 };                           /* 100 contacts long */

/* Gravity as a share of the earth's; 0.03 makes an overlap of 25 units of a place, 1e-6 one of
 * 1e-3. */
static const double weights[] = {1, 0.1, 0.03, 1e-2, 1e-3, 1e-5, 1e-6};
enum { WEIGHTS = 7 };

/* k / m of the law, 1/s^2 (Pournin et al. 2005, sec. 3.1). */
static double stiffness(void)
{
    double pi = 3.14159265358979323846, damping = log(0.4);
    return (pi * pi + damping * damping) / (contact_time * contact_time);
}

static double unit_of(const Rig *rig)
{
    OzParameters parameters;
    int order[OZ_WALLS_MAX];
    must(oz_constants_fill(&parameters, order, &rig->scene, &rig->grains));
    return parameters.length_unit;
}

static void open_bed(Rig *rig, double gx, double gz, double slope)
{
    double step = contact_time / 30;
    rig_open(rig, bed, gx, gz, step, STEPS * step, contact_time, 0.01, sin(slope), cos(slope));
}

/* Puts a grain's centre so deep (m) into a plane through the origin, whose normal kernels know as
 * floats. */
static void put_on_slope(Rig *rig, int64_t i, double overlap)
{
    const double *normal = rig->scene.walls[0].normal;
    for (int c = 0; c < 3; c += 2) {
        rig->grains.position[3 * i + c] = (diameter / 2 - overlap) * (double)(float)normal[c];
    }
}

/* Speed of a grain over what rolling without sliding gives it, less one: the way down the slope is
 * `down`. The factor m R^2 / (m R^2 + I) is 5/7 for a sphere. */
static double rolling_error(const Rig *rig, const OzSnapshot *now, int64_t i, const double down[3],
                            double pull)
{
    double weight = rig->grains.mass[i] * diameter * diameter / 4;
    double right = pull * weight / (weight + rig->grains.inertia_axis[i]) * now->time,
           angular_velocity[3];
    cross3(&now->angular_velocity[3 * i], down, angular_velocity);
    double slow = dot3(&now->velocity[3 * i], down) / right - 1;
    double lazy = sqrt(dot3(angular_velocity, angular_velocity)) * diameter / 2 / right - 1;
    return fmax(fabs(slow), fabs(lazy));
}

/* Down a slope of 10 degrees, at which both roll. The spring that makes them roll yields by
 * 1e-4 of the speed that they reach, and 3000 steps round a speed by 2e-4 of it at most. */
static void test_rolling_down_a_slope(void **state)
{
    (void)state;
    for (int k = 0; k < WEIGHTS; k++) {
        Rig rig;
        double slope = 10 / 57.29577951308232, g = weights[k] * gravity;
        open_bed(&rig, 0, -g, slope);
        double overlap = g * cos(slope) / stiffness(), down[3] = {cos(slope), 0, -sin(slope)};
        put_on_slope(&rig, 0, overlap);
        put_on_slope(&rig, 1, overlap / 2); /* two ends carry it */
        rig.grains.velocity[2] = rig.grains.velocity[5] = rise;
        OzSnapshot now = state_after(&rig, NATIVE, STEPS);
        now.velocity[2] -= rise;
        now.velocity[5] -= rise;
        double sphere = rolling_error(&rig, &now, 0, down, g * sin(slope));
        double rod = rolling_error(&rig, &now, 1, down, g * sin(slope));
        print_message("slope: overlap %8.2g units: sphere off by %.1g, rod by %.1g\n",
                      overlap / unit_of(&rig), sphere, rod);
        /* 1e-4 for the spring, 2e-4 for rounding of speeds (see above); 1e-4 at the worst here */
        assert_true(sphere < 5e-4);
        assert_true(rod < 5e-4);
        oz_snapshot_free(&now);
        rig_close(&rig);
    }
}

/* Down the wall of the cylinder, against which gravity presses. The bound as above. */
static void test_rolling_down_a_cylinder(void **state)
{
    (void)state;
    for (int k = 0; k < WEIGHTS; k++) {
        Rig rig;
        double g = weights[k] * gravity, down[3] = {0, 0, -1};
        open_bed(&rig, g, -0.17 * g, 0);
        rig.grains.position[0] = 0.05 - diameter / 2 + g / stiffness();
        rig.grains.position[2] = 0.4;
        rig.grains.position[3] = -0.03; /* the rod falls and arrives nowhere */
        rig.grains.position[5] = 0.4;
        OzSnapshot now = state_after(&rig, NATIVE, STEPS);
        double sphere = rolling_error(&rig, &now, 0, down, 0.17 * g);
        print_message("cylinder: overlap %8.2g units: sphere off by %.1g\n",
                      g / stiffness() / unit_of(&rig), sphere);
        /* as above: 1e-4 at the worst */
        assert_true(sphere < 5e-4);
        oz_snapshot_free(&now);
        rig_close(&rig);
    }
}

/* The sphere hits a skew rod off its middle; what both do afterwards, against the host's doubles.
 * 1e-3: the bound of above; a contact missed by a step would make 1e-2 at the least. */
static void test_hits(void **state)
{
    (void)state;
    for (int k = 0; k < WEIGHTS; k++) {
        Rig rig;
        double overlap = weights[k] * gravity / stiffness(), speed = overlap * sqrt(stiffness());
        open_bed(&rig, 0, 0, 0);
        double unit = unit_of(&rig);
        double *x = rig.grains.position, apart = diameter + 0.3 * overlap;
        const double axis[3] = {0.6, 0.48, 0.64}, across[3] = {0.8, -0.36, -0.48};
        oz_grains_quaternion(axis, &rig.grains.quaternion[4]);
        for (int c = 0; c < 3; c++) {
            x[c] = x[3 + c] + 0.4 * diameter * axis[c] + apart * across[c];
        }
        rig.grains.velocity[0] = -speed;
        OzSnapshot now = state_after(&rig, NATIVE, 300);
        rig.scene.precision = OZ_PRECISION_DOUBLE;
        rig_start(&rig);
        rig_advance(&rig, 300);
        double error = 0;
        for (int c = 0; c < 6; c++) {
            error = fmax(error, fabs(now.velocity[c] - rig.now.velocity[c]) / speed);
        }
        print_message("hit: overlap %8.2g units: off by %.1g of the speed\n", overlap / unit,
                      error);
        assert_true(fabs(rig.now.velocity[0] + speed) > 0.1 * speed); /* they have met */
        assert_true(error < 1e-3);
        oz_snapshot_free(&now);
        rig_close(&rig);
    }
}

/* A speed takes what gravity adds to it in a step by whole digits: half a digit off at most, and by
 * nearly as much somewhere; 1e-4 is the rounding of the sum of 1000 steps. */
static void test_falling(void **state)
{
    static const double digits[] = {1000.4, 100.4, 10.4, 2.7};
    double worst = 0;
    (void)state;
    for (int k = 0; k < 4; k++) {
        Rig rig;
        double speed = 1.3, step = digits[k] * speed * 0x1p-23 / gravity;
        rig_open(&rig, bed, 0.0, -gravity, step, 1.0, 30 * step, 0.5, 0.0, 1.0);
        rig.grains.velocity[2] = -speed;
        OzSnapshot now = state_after(&rig, NATIVE, 1000);
        double error = fabs((-now.velocity[2] - speed) / (gravity * now.time) - 1);
        print_message("fall: gravity adds %4g digits in a step: off by %.1g\n", digits[k], error);
        /* half a digit, and the rounding of the sum */
        assert_true(error < 0.5 / digits[k] + 1e-4);
        worst = fmax(worst, error);
        oz_snapshot_free(&now);
        rig_close(&rig);
    }
    assert_true(worst > 0.01); /* why it is refused */
}

/* What is left is refused, and the advice is double. */
static void test_refusals(void **state)
{
    static const struct {
        double gravity, step, contact_time, height, duration;
        const char *reason; /* NULL: none */
    } cases[] = {
        {9.81, 3.3e-8, 1e-6, 2.5e-3, 2e-3, NULL},
        {9.81, 3.3e-11, 1e-9, 2.5e-3, 1e-8, "overlap"}, /* 1e-18 m */
        {9.81, 3.3e-8, 1e-6, 0.5, 1, "gravity adds"},   /* falls at 3 m/s */
        {9.81, 3.3e-5, 1e-3, 0.5, 1, NULL},
        {0, 3.3e-11, 1e-9, 0.5, 1, "hits"}, /* the slope's 6e-6 m/s */
    };
    (void)state;
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
        Rig rig;
        rig_open(&rig, bed, 0.0, -cases[k].gravity, cases[k].step, cases[k].duration,
                 cases[k].contact_time, cases[k].height, 0.0, 1.0);
        OzStatus status = oz_members_judge(&rig.scene, &rig.grains, false);
        assert_int_equal(status, cases[k].reason ? OZ_ERR_INPUT : OZ_OK);
        if (cases[k].reason) {
            assert_non_null(strstr(oz_status_text(), cases[k].reason));
            assert_non_null(strstr(oz_status_text(), "precision: double"));
            assert_int_equal(oz_members_judge(&rig.scene, &rig.grains, true), OZ_OK);
            rig.scene.precision = OZ_PRECISION_DOUBLE;
            assert_int_equal(oz_members_judge(&rig.scene, &rig.grains, false), OZ_OK);
        }
        rig_close(&rig);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rolling_down_a_slope),
        cmocka_unit_test(test_rolling_down_a_cylinder),
        cmocka_unit_test(test_hits),
        cmocka_unit_test(test_falling),
        cmocka_unit_test(test_refusals),
    };
    return cmocka_run_group_tests(tests, open_rig_device, close_rig_device);
}
