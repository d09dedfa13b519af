/* Observables against beds written by hand whose answers are known, and series.csv, which holds
 * them. */
#include "hand_bed.h"
#include "hand_contacts.h"
#include "hand_series.h"

#include "base/clock.h"
#include "base/file.h"
#include "observe/clip.h"
#include "observe/schedule.h"
#include "observe/series.h"

static const double PI = 3.14159265358979323846;

/* The named value of a one-row series of the snapshot, printed with 9 digits. */
static double value_of(const Bed *bed, const char *name)
{
    char cell[64];
    OzSeries *series = NULL;
    assert_int_equal(oz_series_create(&series, in_folder("one.csv"), &bed->scene, &bed->grains),
                     OZ_OK);
    assert_int_equal(oz_series_write(series, &bed->snapshot), OZ_OK);
    assert_int_equal(oz_series_free(series), OZ_OK);
    read_cell(in_folder("one.csv"), 1, name, cell);
    return number_in(cell);
}

static void assert_empty(const Bed *bed, const char *name)
{
    assert_near(value_of(bed, name), -1e99, 0);
}

/* Area of a disc of radius r below the line y = height. */
static double disc_below(double r, double height)
{
    double t = fmax(-1, fmin(1, height / r));
    return r * r * (PI - acos(t) + t * sqrt(1 - t * t));
}

/* The clipped volume as a sum of thin discs across the axis, each cut by the plane. The caps are
 * cut at equal angles, where the sum converges fast. */
static double clip_by_discs(double d, double length, double c, double height)
{
    enum { DISCS = 4000 };
    double r = d / 2, s = sqrt(1 - c * c), sum = 0;
    for (int k = 0; k < DISCS; k++) {
        double along = length * ((k + 0.5) / DISCS - 0.5), angle = PI / 2 * (k + 0.5) / DISCS;
        double rise = (length / 2 + r * sin(angle)) * c, ring = r * cos(angle);
        sum += disc_below(r, (height - along * c) / s) * length / DISCS;
        sum += (disc_below(ring, (height - rise) / s) + disc_below(ring, (height + rise) / s)) *
               ring * PI / 2 / DISCS;
    }
    return sum;
}

static void test_clip_closed_forms(void **state)
{
    (void)state;
    double r = 0.5, h = 0.2; /* spheres: the cap of height r + h */
    double cap = PI * (r + h) * (r + h) * (3 * r - (r + h)) / 3;
    /* rounding of volumes of order one */
    assert_near(oz_clip_below(1, 0, 1, h), cap, 1e-14);
    assert_near(oz_clip_below(1, 3, 1, 1.5 + h), 3 * PI * r * r + cap, 1e-14); /* upright */
    assert_near(oz_clip_below(1, 3, -1, 0.3), PI * r * r * 1.8 + 2 * PI * r * r * r / 3, 1e-14);
    double segment = r * r * (PI - acos(h / r)) + h * sqrt(r * r - h * h); /* flat */
    /* a tilt of 1e-7 counts with its square */
    assert_near(oz_clip_below(1, 3, 0, h), 3 * segment + cap, 1e-14);
    assert_near(oz_clip_below(1, 3, 1e-7, h), 3 * segment + cap, 1e-12);
    for (double c = 0; c <= 1;
         c += 0.0625) { /* any tilt: half below the middle, all below the top */
        double all = oz_grains_volume(1, 3);
        /* rounding; a cap 1e-9 high has a volume of 1e-18 */
        assert_near(oz_clip_below(1, 3, c, 0), all / 2, 1e-14);
        assert_near(oz_clip_below(1, 3, c, 1.5 * c + r), all, 1e-14);
        assert_near(oz_clip_below(1, 3, c, 1.5 * c + r - 1e-9), all, 1e-12);
        assert_near(oz_clip_below(1, 3, c, -1.5 * c - r), 0, 1e-12);
    }
}

static void test_clip_tilted(void **state)
{
    (void)state;
    OzRandom random = oz_random_stream(7, 0);
    for (int k = 0; k < 200; k++) {
        double length = oz_random_uniform(&random, 0, 4), c = oz_random_uniform(&random, 0, 1);
        double height = oz_random_uniform(&random, -1, 1) * (length / 2 * c + 0.5);
        /* The sum's own error, from 4000 discs with square-root edges, is about 1e-7. */
        assert_near(oz_clip_below(1, length, c, height), clip_by_discs(1, length, c, height), 1e-6);
    }
}

/* The volume is the integral of its own slope: the slope is the area of the cut, which must be that
 * of an ellipse while the plane cuts the shaft alone. */
static void test_clip_slope(void **state)
{
    (void)state;
    for (double c = 0.5; c < 1; c += 0.1) {
        double step = 1e-4;
        double area = (oz_clip_below(1, 4, c, 0.1 + step) - oz_clip_below(1, 4, c, 0.1 - step)) / 2;
        assert_near(area / step, PI / 4 / c, 1e-8); /* rounding 1e-15 over the step 1e-4 */
    }
}

/* Forty upright rods standing on the floor; then some are lifted off. */
static void test_density(void **state)
{
    (void)state;
    Bed bed;
    double d = 0.5e-3, length = 2e-3, area = PI * 16e-6;
    bed_create(&bed, 40, d, length);
    for (int64_t i = 0; i < 40; i++) {
        put(&bed, i, 1e-3 + (length + d) / 2, 0, 0, i % 2 ? 1 : -1);
    }
    double v = 40 * oz_grains_volume(d, length), h = length + d;
    /* nine digits are written, here and below */
    assert_near(value_of(&bed, "density"), 0.95 * v / (area * h), 1e-9);
    bed.snapshot.position[2] = bed.snapshot.position[3 * 39 + 2] = 20e-3; /* 2 of 40 are 5 % */
    assert_near(value_of(&bed, "density_all"), v / (area * h), 1e-9);
    bed.snapshot.position[3 * 7 + 2] += 1e-3; /* the third highest counts */
    /* to nine digits, as above */
    assert_near(value_of(&bed, "density_all"), v / (area * (h + 1e-3)), 1e-9);
    bed.snapshot.wall_offset[0] = -0.5e-3; /* H is above the floor where it is now */
    assert_near(value_of(&bed, "density"), 0.95 * v / (area * (h + 1.5e-3)), 1e-9);
    bed_free(&bed);
}

/* Forty upright rods on what is a floor 1 mm high, and over what is none. */
static void test_floors(void **state)
{
    (void)state;
    const double d = 0.5e-3, length = 2e-3, disc = PI * 16e-6;
    const OzWall box = {.kind = OZ_WALL_BOX, .point = {0, 0, 1e-3}, .size = {0.01, 0.008, 0.1}};
    const OzWall tube = {.kind = OZ_WALL_CYLINDER, .diameter = 8e-3, .length = 0.1};
    OzWall pot = tube, hung = tube, drum = tube, tumbler = box, turned = box;
    pot.axis[2] = 1, pot.point[2] = 1e-3, pot.ends = OZ_ENDS_CLOSED;
    hung.axis[2] = -1, hung.point[2] = 0.101, hung.ends = OZ_ENDS_CLOSED;
    drum.axis[1] = 1, drum.ends = OZ_ENDS_CLOSED;
    tumbler.motion = (OzMotion){.present = true, .angular_velocity = 1, .axis = {1, 0, 0}};
    turned.motion = (OzMotion){.present = true, .angular_velocity = 1, .axis = {0, 0, -1}};
    const OzWall walls[] = {box, pot, hung, turned, drum, tumbler};
    const double areas[] = {80e-6, disc, disc, 80e-6, 0, 0};
    for (int w = 0; w < 6; w++) {
        Bed bed;
        bed_create(&bed, 40, d, length);
        bed.walls[0] = walls[w];
        bed.scene.wall_count = 1;
        for (int64_t i = 0; i < 40; i++) {
            put(&bed, i, 1e-3 + (length + d) / 2, 0, 0, 1);
        }
        double all = 40 * oz_grains_volume(d, length) / (areas[w] * (length + d));
        assert_near(value_of(&bed, "density_all"), areas[w] ? all : -1e99, 1e-9); /* nine digits */
        assert_near(value_of(&bed, "count_layer1"), areas[w] ? 40 : -1e99, 0);
        bed_free(&bed);
    }
}

static void test_density_com_and_slab(void **state)
{
    (void)state;
    Bed bed;
    double d = 1e-3, area = PI * 16e-6, v = oz_grains_volume(1e-3, 0);
    bed_create(&bed, 4, d, 0);
    put(&bed, 0, 3e-3, 0, 0, 1);  /* cut in half by the slab's lower face, 2 mm above the floor */
    put(&bed, 1, 6e-3, 0, 0, 1);  /* inside */
    put(&bed, 2, 11e-3, 0, 0, 1); /* cut in half by the upper face */
    put(&bed, 3, 16e-3, 0, 0, 1); /* above */
    /* nine digits of some thousandths */
    assert_near(value_of(&bed, "density_slab"), 2 * v / (area * 8e-3), 1e-11);
    assert_near(value_of(&bed, "density_com"), 4 * v / (area * 2 * 8e-3), 1e-11);
    bed.snapshot.wall_offset[0] = 1e-3;
    assert_near(value_of(&bed, "density_com"), 4 * v / (area * 2 * 7e-3), 1e-11);
    bed.scene.wall_count = 1; /* no cylinder */
    assert_empty(&bed, "density");
    assert_empty(&bed, "density_all");
    assert_empty(&bed, "density_com");
    assert_empty(&bed, "density_slab");
    bed_free(&bed);
}

static void test_angle(void **state)
{
    (void)state;
    Bed bed;
    enum { COUNT = 20000 };
    bed_create(&bed, COUNT, 1e-3, 3e-3);
    for (int64_t i = 0; i < COUNT; i++) {
        put(&bed, i, 2e-3, i % 2 ? 0.6 : 0, 0, i % 2 ? -0.8 : 1);
    }
    /* nine digits of degrees */
    assert_near(value_of(&bed, "angle"), (90 + asin(0.8) * 180 / PI) / 2, 1e-7);
    OzRandom random = oz_random_stream(3, 0);
    for (int64_t i = 0; i < COUNT; i++) {
        oz_random_direction(&random, &bed.snapshot.axis[3 * i]);
    }
    /* Uniform: the mean is (pi/2 - 1) rad, the deviation of one 21.6 degrees: four of 21.6/sqrt(n).
     */
    assert_near(value_of(&bed, "angle"), (PI / 2 - 1) * 180 / PI, 0.61);
    assert_near(value_of(&bed, "nematic_s"), 0, 0.03); /* largest of three, each about 1/sqrt(n) */
    bed_free(&bed);
}

static void test_layers(void **state)
{
    (void)state;
    Bed bed;
    bed_create(&bed, 6, 1e-3, 3e-3);
    put(&bed, 0, 1e-3 + 0.1e-3, 0, 0, 1);
    put(&bed, 1, 1e-3 + 3.9e-3, 1, 0, 0);
    put(&bed, 2, 1e-3 + 4.1e-3, 0, 0.6, 0.8);
    put(&bed, 3, 1e-3 + 15.9e-3, 0, 1, 0);
    put(&bed, 4, 1e-3 + 16.1e-3, 0, 0, 1); /* above the fourth */
    bed.snapshot.wall_offset[0] = 0.3e-3;  /* layers stay in the laboratory */
    put(&bed, 5, 1e-3 + 2e-3, 0, 0, 1);
    bed.grains.length[3] = bed.grains.length[5] = 0; /* spheres count, but have no angle */
    /* nine digits of degrees */
    assert_near(value_of(&bed, "angle_layer1"), 45, 1e-7);
    assert_near(value_of(&bed, "angle_layer2"), asin(0.8) * 180 / PI, 1e-7);
    assert_empty(&bed, "angle_layer3");
    assert_empty(&bed, "angle_layer4");
    assert_near(value_of(&bed, "count_layer1"), 3, 0);
    assert_near(value_of(&bed, "count_layer3"), 0, 0);
    assert_near(value_of(&bed, "count_layer4"), 1, 0);
    bed_free(&bed);
}

static void test_nematic(void **state)
{
    (void)state;
    Bed bed;
    bed_create(&bed, 6, 1e-3, 3e-3);
    for (int64_t i = 0; i < 6; i++) {
        put(&bed, i, 2e-3, 0.36, 0.48, 0.8);
    }
    /* the cubic's root by an arc cosine: near a double root half of a double's digits */
    assert_near(value_of(&bed, "nematic_s"), 1, 1e-9);
    for (int64_t i = 0; i < 6; i++) { /* along x, y, z, both ways: isotropic */
        put(&bed, i, 2e-3, i % 3 == 0, i % 3 == 1, i % 3 == 2 ? (i < 3 ? 1 : -1) : 0);
    }
    assert_near(value_of(&bed, "nematic_s"), 0, 3e-8);
    for (int64_t i = 0; i < 6; i++) { /* in a plane, half each: eigenvalues 1/4 1/4 -1/2 */
        put(&bed, i, 2e-3, i % 2 ? 1 : 0, i % 2 ? 0 : 1, 0);
    }
    assert_near(value_of(&bed, "nematic_s"), 0.25, 3e-8);
    bed_free(&bed);
}

static void test_energies(void **state)
{
    (void)state;
    Bed bed;
    OzSeries *series = NULL;
    char cell[64];
    bed_create(&bed, 1, 1e-3, 3e-3);
    bed.scene.observe.ledger = true;
    put(&bed, 0, 2e-3, 0.6, 0, 0.8);
    memcpy(bed.snapshot.velocity, (double[]){3, 0, 4}, 3 * sizeof(double));
    memcpy(bed.snapshot.angular_velocity, (double[]){0.6 * 20, 5, 0.8 * 20}, 3 * sizeof(double));
    bed.snapshot.has_ledger = true;
    hand_contact(&bed.snapshot, (OzContactEntry){.a = 0, .b = 1, .overlap = 5e-6});
    hand_contact(&bed.snapshot, (OzContactEntry){.a = 0, .b = -1, .overlap = 2e-5});
    hand_contact(&bed.snapshot, (OzContactEntry){.a = 1, .b = 2, .overlap = 5e-6});
    hand_contact(&bed.snapshot, (OzContactEntry){.a = 0, .b = 2, .overlap = 1e-5});
    double m = *bed.grains.mass, i_axis = *bed.grains.inertia_axis, i_across = *bed.grains.inertia;
    /* nine digits are written */
    assert_near(value_of(&bed, "speed_max"), 5, 1e-8);
    assert_near(value_of(&bed, "kinetic") / (m * 12.5), 1, 1e-8);
    assert_near(value_of(&bed, "rotational") / (i_axis * 200 + i_across * 12.5), 1, 1e-8);
    assert_near(value_of(&bed, "energy_potential") / (m * 9.81 * 2e-3), 1, 1e-8);
    /* counts exactly; overlaps to nine digits */
    assert_near(value_of(&bed, "contact_count"), 3, 0);
    assert_near(value_of(&bed, "overlap_max"), 2e-5, 1e-14);
    assert_near(value_of(&bed, "overlap_mean"), 1e-5, 1e-14);
    assert_int_equal(oz_series_create(&series, in_folder("e.csv"), &bed.scene, &bed.grains), OZ_OK);
    assert_int_equal(oz_series_write(series, &bed.snapshot), OZ_OK);
    bed.snapshot.position[2] += 1e-3; /* raised, half of it by the walls; the rest is residual */
    bed.snapshot.ledger = (OzLedger){1e-8, 2e-8, 4e-8, 7e-8 + m * 9.81 * 0.5e-3};
    assert_int_equal(oz_series_write(series, &bed.snapshot), OZ_OK);
    assert_int_equal(oz_series_free(series), OZ_OK);
    read_cell(in_folder("e.csv"), 1, "energy_residual", cell);
    assert_string_equal(cell, "0");
    read_cell(in_folder("e.csv"), 2, "energy_residual", cell);
    assert_near(strtod(cell, NULL) / (m * 9.81 * 0.5e-3), 1,
                1e-6); /* kinetic is 1000 times larger */
    bed_free(&bed);
}

static void test_tap_means(void **state)
{
    (void)state;
    Bed bed;
    OzSeries *series = NULL;
    char cell[64];
    bed_create(&bed, 1, 1e-3, 3e-3);
    bed.scene.period = 0.5;
    bed.snapshot.step = 1234567890123;
    bed.snapshot.time = 0.75;
    assert_int_equal(oz_series_create(&series, in_folder("t.csv"), &bed.scene, &bed.grains), OZ_OK);
    assert_int_equal(oz_series_write(series, &bed.snapshot), OZ_OK);
    double angles[] = {10, 20, 30, 40, 50, 60}; /* two taps of two samples: the last four stay */
    for (int k = 0; k < 6; k++) {
        put(&bed, 0, 5e-3, cos(angles[k] * PI / 180), 0, sin(angles[k] * PI / 180));
        oz_series_sample(series, &bed.snapshot);
        assert_int_equal(oz_series_write(series, &bed.snapshot), OZ_OK);
    }
    assert_int_equal(oz_series_free(series), OZ_OK);
    const char *expected[] = {"", "10", "15", "20", "25", "35", "45"};
    for (int row = 1; row <= 7; row++) {
        read_cell(in_folder("t.csv"), row, "angle_tap_mean", cell);
        assert_string_equal(cell, expected[row - 1]);
    }
    read_cell(in_folder("t.csv"), 1, "density_tap_mean", cell);
    assert_string_equal(cell, "");
    double mean = 0;
    for (int row = 4; row <= 7; row++) {
        read_cell(in_folder("t.csv"), row, "density", cell);
        mean += number_in(cell) / 4;
    }
    read_cell(in_folder("t.csv"), 7, "density_tap_mean", cell);
    assert_near(number_in(cell), mean, 1e-8 * mean); /* nine digits are written */
    read_cell(in_folder("t.csv"), 7, "tap", cell);
    assert_string_equal(cell, "1.5");
    read_cell(in_folder("t.csv"), 7, "step", cell);
    assert_string_equal(cell, "1234567890123");
    bed_free(&bed);
}

/* The header is a contract with other programs. */
static void test_header(void **state)
{
    (void)state;
    Bed bed;
    char *text = NULL;
    const char *common =
        "step,time,tap,density,density_all,density_tap_mean,density_all_tap_mean,density_com,"
        "density_com_tap_mean,density_slab,density_slab_tap_mean,angle,"
        "angle_tap_mean,angle_layer1,angle_layer2,angle_layer3,angle_layer4,count_layer1,"
        "count_layer2,count_layer3,count_layer4,nematic_s,contact_count,overlap_max,overlap_mean,"
        "speed_max,kinetic,rotational,contact_number,deep_count";
    const char *ledger = ",energy_potential,energy_elastic,energy_dissipated,energy_friction,"
                         "work_walls,energy_residual\n";
    bed_create(&bed, 0, 1, 1); /* no grains: every cell is a number or empty */
    for (int with = 0; with < 2; with++) {
        bed.scene.observe.ledger = bed.snapshot.has_ledger = with;
        value_of(&bed, "step");
        assert_int_equal(oz_file_read(&text, NULL, in_folder("one.csv")), OZ_OK);
        assert_memory_equal(text, common, strlen(common));
        assert_true(strncmp(text + strlen(common), with ? ledger : "\n",
                            strlen(with ? ledger : "\n")) == 0);
        assert_null(strstr(text, "nan"));
        assert_null(strstr(text, "inf"));
        free(text);
    }
    for (const OzColumn *column = oz_series_columns(); column->name; column++) {
        assert_true(*column->unit && *column->meaning && column->value);
    }
    bed_free(&bed);
}

static void test_spheres_have_no_angle(void **state)
{
    (void)state;
    Bed bed;
    bed_create(&bed, 2, 1e-3, 0);
    put(&bed, 1, 3e-3, 0, 0, 1);
    assert_empty(&bed, "angle");
    assert_empty(&bed, "angle_layer1");
    assert_empty(&bed, "angle_tap_mean");
    assert_empty(&bed, "nematic_s");
    assert_empty(&bed, "tap");
    assert_empty(&bed, "contact_count");
    bed.snapshot.velocity[0] = NAN; /* a broken state is shown */
    assert_true(isnan(value_of(&bed, "kinetic")));
    assert_true(isnan(value_of(&bed, "speed_max")));
    bed_free(&bed);
}

/* The means may cost 1 % of a run: 16 samples a tap of 1667 steps at 50 us leave 52 us for a
 * sample. */
static void test_sample_is_cheap(void **state)
{
    (void)state;
    Bed bed;
    OzSeries *series = NULL;
    double best = 1;
    bed_create(&bed, 1000, 0.523e-3, 2.092e-3);
    fill_randomly(&bed);
    assert_int_equal(oz_series_create(&series, in_folder("s.csv"), &bed.scene, &bed.grains), OZ_OK);
    for (int k = 0; k < 200; k++) {
        double start = oz_clock_now();
        oz_series_sample(series, &bed.snapshot);
        best = fmin(best, oz_clock_now() - start);
    }
    print_message("one sample of 1000 grains: %.1f us\n", 1e6 * best);
    assert_true(best < 500e-6); /* tenfold for unoptimised builds and busy machines */
    oz_series_free(series);
    bed_free(&bed);
}

static int clean_up(void **state)
{
    (void)state;
    return remove_folder((const char *const[]){"one.csv", "e.csv", "t.csv", "s.csv", NULL});
}

/* A snapshot at the last step is drawn; later ones are named, as they were written. */
static void test_snapshots_beyond_the_end_are_named(void **state)
{
    (void)state;
    double times[] = {0.01, 0.02, 0.03, 0.05}, taps[] = {0.5, 1, 1.5, 2.5};
    OzScene scene = {.step = 1e-3, .duration = 0.05, .period = 0.02};
    scene.snapshots.times = times;
    scene.snapshots.count = 4;
    char text[256];
    OzSchedule schedule = oz_schedule_create(&scene, -1);
    assert_false(oz_schedule_missed(&schedule, text, sizeof text));
    schedule = oz_schedule_create(&scene, 0.02);
    assert_true(oz_schedule_missed(&schedule, text, sizeof text));
    assert_string_equal(
        text, "snapshots.times 0.03, 0.05 s beyond the run's end at 0.02 s are not drawn");
    scene.snapshots.taps = taps;
    scene.snapshots.tap_count = 4;
    assert_true(oz_schedule_missed(&schedule, text, sizeof text));
    assert_string_equal(text,
                        "snapshots.taps 1.5, 2.5 beyond the run's end at tap 1 are not drawn");
    char little[12]; /* cut to size */
    assert_true(oz_schedule_missed(&schedule, little, sizeof little));
    assert_string_equal(little, "snapshots.t");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_snapshots_beyond_the_end_are_named),
        cmocka_unit_test(test_clip_closed_forms),
        cmocka_unit_test(test_clip_tilted),
        cmocka_unit_test(test_clip_slope),
        cmocka_unit_test(test_density),
        cmocka_unit_test(test_floors),
        cmocka_unit_test(test_density_com_and_slab),
        cmocka_unit_test(test_angle),
        cmocka_unit_test(test_layers),
        cmocka_unit_test(test_nematic),
        cmocka_unit_test(test_energies),
        cmocka_unit_test(test_tap_means),
        cmocka_unit_test(test_header),
        cmocka_unit_test(test_spheres_have_no_angle),
        cmocka_unit_test(test_sample_is_cheap),
    };
    return cmocka_run_group_tests(tests, make_folder, clean_up);
}
