/* Verdicts, what is measured in a packing (a crystal of known density), and one short experiment of
 * `orzo report --validate`. ORZO_NEEDS_DEVICE. */
#include "hand_bed.h"
#include "hand_contacts.h"
#include "program.h"

#include "report/report_validate.h"
#include "report/report_validate_looks.h"
#include "report/report_validate_packing.h"
#include "report/report_validate_rows.h"

static const double PI = 3.14159265358979323846;

static void verdicts_come_from_intervals(void **state)
{
    (void)state;
    const OzKnown known = {.low = 1, .high = 2};
    assert_int_equal(oz_report_validate_judge(&known, 1.5, 0), OZ_AGREES);
    assert_int_equal(oz_report_validate_judge(&known, 1.5, 0.5), OZ_AGREES);
    assert_int_equal(oz_report_validate_judge(&known, 2.3, 0.4), OZ_AGREES);
    assert_int_equal(oz_report_validate_judge(&known, 2.3, 0.2), OZ_DIFFERS);
    assert_int_equal(oz_report_validate_judge(&known, 0.5, 0.2), OZ_DIFFERS);
    assert_int_equal(oz_report_validate_judge(&known, 1.5, 0.6), OZ_UNDECIDED);
    assert_int_equal(oz_report_validate_judge(&known, 1.5, INFINITY), OZ_UNDECIDED);
    assert_int_equal(oz_report_validate_judge(&known, NAN, 0.1), OZ_DIFFERS);
}

/* Face-centred cubic spheres that fill a cylinder of 8 mm up to 8 mm: places as multiples of half
 * the cube's edge whose sum is even. Returns how many; bed NULL: counts alone. */
static int64_t crystal(Bed *bed, double diameter)
{
    double half = diameter / sqrt(2);
    int64_t count = 0;
    int reach = (int)(4e-3 / half) + 1;
    for (int x = -reach; x <= reach; x++) {
        for (int y = -reach; y <= reach; y++) {
            for (int z = 0; z * half < 8e-3; z++) {
                bool inside = half * hypot(x, y) < 4e-3 - diameter / 2;
                if (!inside || (x + y + z) % 2 != 0) {
                    continue;
                }
                if (bed) {
                    double *place = &bed->snapshot.position[3 * count];
                    memcpy(place, (double[]){x * half, y * half, z * half}, 3 * sizeof *place);
                }
                count++;
            }
        }
    }
    return count;
}

static void a_crystal_has_its_density_and_twelve_contacts(void **state)
{
    (void)state;
    const double diameter = 0.5e-3;
    Bed bed;
    OzTrialNumbers numbers = {0};
    bed_create(&bed, crystal(NULL, diameter), diameter, 0);
    crystal(&bed, diameter);
    for (int64_t a = 0; a < bed.grains.count; a++) {
        for (int64_t b = a + 1; b < bed.grains.count; b++) {
            const double *x = &bed.snapshot.position[3 * a], *y = &bed.snapshot.position[3 * b];
            double way = hypot(hypot(x[0] - y[0], x[1] - y[1]), x[2] - y[2]);
            OzContactEntry entry = {.a = (int32_t)a, .b = (int32_t)b};
            if (way < 1.01 * diameter) { /* found in the order of ids */
                assert_int_equal(oz_contact_list_add(&bed.snapshot.contacts, &entry), OZ_OK);
            }
        }
    }
    bed.snapshot.has_contacts = true;
    oz_report_validate_packing_look(numbers, &bed.snapshot, 1);
    /* of 1e5 points the share deviates by 0.0014 */
    assert_near(numbers[OZ_LOOK_PACKING_DENSITY], PI / (3 * sqrt(2)), 0.005);
    assert_near(numbers[OZ_LOOK_PACKING_CONTACTS], 12, 0);
    assert_near(numbers[OZ_LOOK_PACKING_BACKBONE], 12, 0);
    bed_free(&bed);
}

/* Spheres with their centres on a cone, and some that lie beside the tray; the surface over them is
 * a cone again, with ripples of (spacing / diameter)^2 / 8 of a diameter. */
static void a_heap_has_the_slope_of_its_cone(void **state)
{
    (void)state;
    enum { SIDE = 81, COUNT = SIDE * SIDE };
    const double radius = 10e-3, spacing = 2 * radius / (SIDE - 1), rise = tan(25 * PI / 180);
    Bed bed;
    OzTrialNumbers numbers = {0};
    bed_create(&bed, COUNT, 1e-3, 0);
    bed.walls[0] = (OzWall){.kind = OZ_WALL_DISC, .diameter = 2 * radius, .normal = {0, 0, 1}};
    for (int64_t i = 0; i < COUNT; i++) {
        double x = spacing * (double)(i % SIDE) - radius, y = spacing * (double)(i / SIDE) - radius;
        double far = hypot(x, y), place[3] = {x, y, 6e-3 - rise * far};
        memcpy(&bed.snapshot.position[3 * i], place, sizeof place);
        if (far > radius) {
            bed.snapshot.position[3 * i + 2] = -8e-3;
        }
    }
    oz_report_validate_looks_heap(numbers, &bed.snapshot, 1);
    assert_near(numbers[OZ_LOOK_HEAP_SLOPE], 25, 0.2);
    bed_free(&bed);
}

/* A head-on hit seen at three moments: the last overlap and gap are 1:3, a quarter of the way. */
static void a_hit_ends_between_looks(void **state)
{
    (void)state;
    Bed bed;
    OzTrialNumbers numbers = {0};
    const double overlaps[] = {1e-6, 4e-6, 1e-6, -3e-6};
    bed_create(&bed, 1, 1e-3, 0);
    bed.grains.velocity[2] = -2;
    bed.snapshot.velocity[2] = 1;
    for (int look = 0; look < 4; look++) {
        bed.snapshot.time = 1e-3 * look;
        bed.snapshot.position[2] = 0.5e-3 - overlaps[look];
        oz_report_validate_looks_hit(numbers, &bed.snapshot, look);
    }
    assert_near(numbers[OZ_LOOK_HIT_OVERLAP], 4e-6, 1e-18);
    assert_near(numbers[OZ_LOOK_HIT_DURATION], 2.25e-3, 1e-15);
    assert_near(numbers[OZ_LOOK_HIT_RESTITUTION], 0.5, 0);
    bed_free(&bed);
}

static const OzValidation *row_of(const char *name)
{
    const OzValidation *row = oz_report_validate_rows_all;
    while (row->name && strcmp(row->name, name) != 0) {
        row++;
    }
    assert_non_null(row->name);
    return row;
}

/* Two grains that slow down as 1/(1 + t/tau), with tau by theory, cool at its rate. */
static void a_gas_by_theory_cools_at_its_rate(void **state)
{
    (void)state;
    const OzValidation *row = row_of("cooling");
    const double d = 1e-3, room = 10e-3, n = 2 / pow(room, 3), share = n * PI / 6 * d * d * d;
    const double g = (1 - share / 2) / pow(1 - share, 3);
    /* tau = 6 / ((1 - e^2) times the rate of hits, 4 sqrt(pi) n d^2 g sqrt(T)) */
    const double hits = 4 * sqrt(PI) * n * d * d * g * sqrt(0.25 / 3), tau = 6 / (0.19 * hits);
    OzTrialNumbers numbers[OZ_TRIAL_VARIANTS] = {{0}};
    Bed bed;
    bed_create(&bed, 2, d, 0);
    memcpy(bed.scene.boundary.size, (const double[]){room, room, room}, 3 * sizeof room);
    bed.scene.contact.restitution = 0.9;
    for (int look = 0; look <= row->trial.looks; look++) {
        bed.snapshot.time = 0.02 * tau * look;
        double speed = 0.5 / (1 + bed.snapshot.time / tau);
        bed.snapshot.velocity[0] = 0.3 + speed; /* a drift is no heat */
        bed.snapshot.velocity[3] = 0.3 - speed;
        row->trial.look(numbers[0], &bed.snapshot, look);
    }
    assert_near(row->known[0].value((const OzTrialNumbers *)numbers), 1, 1e-9); /* of the fit */
    bed_free(&bed);
}

/* A centre of mass 30 degrees beside the vertical below the drum's axis. */
static void a_drum_shows_its_slope(void **state)
{
    (void)state;
    const OzValidation *row = row_of("drum");
    OzTrialNumbers numbers[OZ_TRIAL_VARIANTS] = {{0}};
    Bed bed;
    bed_create(&bed, 1, 1e-3, 0);
    memcpy(bed.walls[0].point, (const double[3]){1e-3, 0, 2e-3}, sizeof bed.walls[0].point);
    bed.snapshot.position[0] = 1e-3 + 3e-3 * sin(PI / 6);
    bed.snapshot.position[2] = 2e-3 - 3e-3 * cos(PI / 6);
    for (int look = 0; look <= row->trial.looks; look++) {
        row->trial.look(numbers[1], &bed.snapshot, look);
    }
    assert_near(row->known[0].value((const OzTrialNumbers *)numbers), 30, 1e-9);
    bed_free(&bed);
}

/* A deep bed of which the floor carries what Janssen says for K = 0.5, and a shallow one the same.
 */
static void a_silo_shows_its_k(void **state)
{
    (void)state;
    const OzValidation *row = row_of("silo");
    OzTrialNumbers numbers[OZ_TRIAL_VARIANTS] = {{0}};
    Bed bed;
    bed_create(&bed, 1, 1e-3, 0);
    bed.walls[1].contact.friction = 0.4;
    bed.snapshot.position[2] = 20e-3; /* 40 mm high, over a floor that has gone down by 1 mm */
    bed.snapshot.wall_offset[0] = 1e-3;
    double weight = 9.81 * bed.grains.mass[0], depth = 8e-3 / (4 * 0.4 * 0.5);
    OzContactEntry floor = {.b = -1, .push = weight * depth / 42e-3, .normal = {0, 0, -1}};
    hand_contact(&bed.snapshot, floor);
    for (int look = 0; look <= row->trial.looks; look++) {
        row->trial.look(numbers[0], &bed.snapshot, look);
        row->trial.look(numbers[1], &bed.snapshot, look);
    }
    assert_near(row->known[0].value((const OzTrialNumbers *)numbers), 1, 0);
    assert_near(row->known[1].value((const OzTrialNumbers *)numbers), 0.5, 1e-12);
    bed_free(&bed);
}

/* A row of spheres above the hole of which one falls at a time, so often that Beverloo's factor is
 * 0.58. */
static void a_hopper_shows_its_factor(void **state)
{
    (void)state;
    enum { COUNT = 200 };
    const OzValidation *row = row_of("hopper");
    const double d = 1e-3, free_hole = 8e-3 - 1.4 * d;
    OzTrialNumbers numbers[OZ_TRIAL_VARIANTS] = {{0}};
    Bed bed;
    bed_create(&bed, COUNT, d, 0);
    bed.walls[0] = (OzWall){.kind = OZ_WALL_CONE, .diameters = {8e-3, 18e-3}};
    bed.walls[1].diameter = 18e-3;
    for (int64_t i = 0; i < COUNT; i++) { /* 10 in a millimetre: the inner five hold 50 */
        bed.snapshot.position[3 * i + 2] = 0.1e-3 * ((double)i + 0.5);
    }
    double density = 50 * bed.grains.mass[0] / (PI / 4 * 18e-3 * 18e-3 * 5 * d);
    double rate = 0.58 * density * sqrt(9.81) * pow(free_hole, 2.5) / bed.grains.mass[0];
    for (int look = 0; look < COUNT; look++) {
        bed.snapshot.time = look / rate;
        row->trial.look(numbers[0], &bed.snapshot, look);
        bed.snapshot.position[3 * look + 2] = -1;
    }
    assert_near(row->known[0].value((const OzTrialNumbers *)numbers), 0.58, 1e-9);
    bed_free(&bed);
}

/* The same start with less friction slides where 7/2 mu is passed. */
static void the_incline_agrees_and_another_friction_does_not(void **state)
{
    (void)state;
    expect(0, "agrees", "report --validate incline -o out");
    assert_true(contains("said", "3 quantities: 3 agree, 0 are undecided, 0 differ"));
    assert_true(contains("out/validation.csv", "rigid body: 7/2"));
    expect(1, "DIFFERS", "report --validate incline -o out --set contact.friction=0.25");
    expect(2, "expected one of incline, chung_ooi_1", "report --validate inclined -o out");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(verdicts_come_from_intervals),
        cmocka_unit_test(a_crystal_has_its_density_and_twelve_contacts),
        cmocka_unit_test(a_heap_has_the_slope_of_its_cone),
        cmocka_unit_test(a_hit_ends_between_looks),
        cmocka_unit_test(a_gas_by_theory_cools_at_its_rate),
        cmocka_unit_test(a_drum_shows_its_slope),
        cmocka_unit_test(a_silo_shows_its_k),
        cmocka_unit_test(a_hopper_shows_its_factor),
        cmocka_unit_test(the_incline_agrees_and_another_friction_does_not),
    };
    return cmocka_run_group_tests(tests, enter_work, leave_work);
}
