/* Single precision far from the origin and at tiny steps: overlaps keep their digits, slow grains do not stall.
 * The force of a known overlap shows what the device made of it. ORZO_NEEDS_DEVICE. */
#include "device_rig.h"

enum { PAIRS = 32 };

/* Pairs of spheres of 1 mm, elastic and frictionless; x and y of the first one are moved by each test. */
static const char pairs[] = "model: rods\n"
                            "gravity: [0, 0, 0]\n"
                            "integrator: symplectic-euler\n"
                            "time: {step: %g, duration: 1}\n"
                            "contact: {contact_time: 1e-3, restitution: 1, friction: 0}\n"
                            "grains:\n"
                            "  - {kind: lattice, cells: [64, 1, 1], spacing: [0.01, 0.01, 0.01],\n"
                            "     diameter: 1e-3, position: [0, 0, 0]}\n";

static const double diameter = 1e-3, overlap = 1e-5;

/* Pairs touch in directions of their own, at a distance from the origin. */
static void place_pairs(OzGrains *grains, double distance)
{
    OzRandom random = oz_random_stream(11, 0);
    for (int64_t k = 0; k < PAIRS; k++) {
        double *one = &grains->position[6 * k], *other = one + 3, direction[3];
        oz_random_direction(&random, direction);
        for (int c = 0; c < 3; c++) {
            one[c] = (c == 0 ? distance : 0) + (c == 1 ? 0.003 * (double)k : 0) +
                     oz_random_uniform(&random, 0, 1e-4);
            other[c] = one[c] + (diameter - overlap) * direction[c];
        }
    }
}

/* The largest error of an overlap, in diameters, from the speed that one step's force gives. */
static double overlap_error(double distance)
{
    Rig rig;
    double step = 1e-6, worst = 0;
    rig_open(&rig, pairs, step);
    place_pairs(&rig.grains, distance * diameter);
    OzSnapshot now = state_after(&rig, NATIVE, 1);
    double rate = 9.869604401089358 / 2 / (1e-3 * 1e-3); /* k / m: pi^2 / t_c^2 of half the mass */
    for (int64_t k = 0; k < PAIRS; k++) {
        const double *v = &now.velocity[6 * k];
        double speed = sqrt(dot3(v, v));
        worst = fmax(worst, fabs(speed / (rate * step) - overlap) / diameter);
    }
    oz_snapshot_free(&now);
    rig_close(&rig);
    return worst;
}

/* The bounds are what orzo promises; plain floats err by 6e-7, 1e-5 and 2e-4 diameters there. */
static void test_overlaps_keep_their_digits(void **state)
{
    static const double at[] = {40, 450, 4500}, bound[] = {1e-6, 2e-6, 1e-5};
    (void)state;
    for (int i = 0; i < 3; i++) {
        double error = overlap_error(at[i]);
        print_message("%g diameters from the origin: %.2g diameters\n", at[i], error);
        assert_true(error < bound[i]);
    }
}

/* A grain at 1e-6 m/s moves a hundredth of a float's spacing (or of orzo's unit) a step of 1e-6 s. */
static void test_slow_grains_do_not_stall(void **state)
{
    Rig rig;
    (void)state;
    rig_open(&rig, pairs, 1e-6);
    rig.grains.velocity[0] = 1e-6;
    double start = rig.grains.position[0];
    OzSnapshot now = state_after(&rig, NATIVE, 100000);
    double moved = now.position[0] - start;
    print_message("moved %.9g m of 1e-7\n", moved);
    /* the start is rounded to one unit of 2.4e-10 m, carried in the remainder to 1e-7 of that; the remainder's
     * own rounding, 6e-8 of a unit a step, adds up to far less than 1e-3 of the way */
    assert_true(fabs(moved - 1e-7) < 1e-10);
    oz_snapshot_free(&now);
    rig_close(&rig);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_overlaps_keep_their_digits),
        cmocka_unit_test(test_slow_grains_do_not_stall),
    };
    return cmocka_run_group_tests(tests, open_rig_device, close_rig_device);
}
