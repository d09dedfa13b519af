/* Verdicts, what is measured in a packing (a crystal of known density), and one short experiment of
 * `orzo report --validate`. ORZO_NEEDS_DEVICE. */
#include "hand_bed.h"
#include "hand_contacts.h"
#include "program.h"

#include "report/report_validate.h"
#include "report/report_validate_looks.h"
#include "report/report_validate_packing.h"

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
        cmocka_unit_test(a_hit_ends_between_looks),
        cmocka_unit_test(the_incline_agrees_and_another_friction_does_not),
    };
    return cmocka_run_group_tests(tests, enter_work, leave_work);
}
