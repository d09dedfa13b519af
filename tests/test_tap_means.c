/* Tap means and rows at one phase of the floor, against closed forms: a sphere that hangs still in
 * a cylinder above a floor at A sin(2 pi f t) has densities of the form c / (h - A sin), whose mean
 * over a period is c / sqrt(h^2 - A^2). */
#include "hand_bed.h"
#include "hand_series.h"

#include "observe/schedule.h"
#include "observe/series.h"

#include <math.h>

static const double PI = 3.14159265358979323846;
static const double amplitude = 1e-3, frequency = 50, diameter = 2e-3;
static const double centre_z = 7e-3; /* m, of the sphere; the slab holds it always */

enum { TAPS = 3 };

/* The period is no whole number of steps: events lie half a step off at most. */
static void hang(Bed *bed, OzObserveAt at)
{
    bed_create(bed, 1, diameter, 0);
    put(bed, 0, centre_z, 0, 0, 1);
    bed->walls[0].motion =
        (OzMotion){.present = true, .frequency = frequency, .amplitude = amplitude};
    bed->scene.period = 1 / frequency;
    bed->scene.step = 3.7e-6;
    bed->scene.duration = TAPS * bed->scene.period;
    bed->scene.observe.interval = bed->scene.period;
    bed->scene.observe.samples_per_tap = 16;
    bed->scene.observe.at = at;
}

/* Writes m.csv as a run would; returns the number of its rows. */
static int write_series(Bed *bed)
{
    OzSeries *series = NULL;
    OzSchedule schedule = oz_schedule_create(&bed->scene, -1);
    OzSnapshot *now = &bed->snapshot;
    int due = 0, rows = 0;
    assert_int_equal(oz_series_create(&series, in_folder("m.csv"), &bed->scene, &bed->grains),
                     OZ_OK);
    while (oz_schedule_next(&schedule, &now->step, &due)) {
        now->time = (double)now->step * bed->scene.step;
        oz_snapshot_move_walls(now);
        if (due & OZ_DUE_SAMPLE) {
            oz_series_sample(series, now);
        }
        if (due & OZ_DUE_ROW) {
            assert_int_equal(oz_series_write(series, now), OZ_OK);
            rows++;
        }
    }
    assert_int_equal(now->step, llround(bed->scene.duration / bed->scene.step));
    assert_int_equal(oz_series_free(series), OZ_OK);
    return rows;
}

static double cell(int row, const char *column)
{
    char text[64];
    read_cell(in_folder("m.csv"), row, column, text);
    return number_in(text);
}

static void assert_share(double value, double expected, double tolerance)
{
    if (!(fabs(value / expected - 1) <= tolerance)) {
        fail_msg("%.12g, expected %.12g", value, expected);
    }
}

/* V / area. */
static double filling(void)
{
    return PI / 6 * diameter * diameter * diameter / (PI / 4 * 8e-3 * 8e-3);
}

static const double top_height = 7e-3, centre_height = 6e-3; /* m, above the floor at rest */

/* Sixteen samples of a period have a mean with an error of (A / 2h)^16, below nine digits; times
 * are whole steps, which are off by 3e-4 of a radian at most and enter in first order. */
static void test_all_phases(void **state)
{
    (void)state;
    Bed bed;
    hang(&bed, OZ_OBSERVE_MEAN);
    assert_int_equal(write_series(&bed), TAPS + 1);
    double root = sqrt(top_height * top_height - amplitude * amplitude);
    double centre = sqrt(centre_height * centre_height - amplitude * amplitude);
    for (int row = TAPS; row <= TAPS + 1; row++) {
        /* 3e-4 rad times amplitude over height; nine digits where the phase does not matter */
        assert_share(cell(row, "density_all_tap_mean"), filling() / root, 1e-4);
        assert_share(cell(row, "density_tap_mean"), 0.95 * filling() / root, 1e-4);
        assert_share(cell(row, "density_com_tap_mean"), filling() / (2 * centre), 1e-4);
        assert_share(cell(row, "density_slab_tap_mean"), filling() / 8e-3, 1e-8);
        assert_share(cell(row, "density_all"), filling() / top_height, 1e-4);
    }
    bed_free(&bed);
}

/* At the turning points half a step matters in second order only: 4e-8. */
static void check_phase(OzObserveAt at, double share, double offset)
{
    Bed bed;
    hang(&bed, at);
    assert_int_equal(write_series(&bed), TAPS + 1);
    double all = filling() / (top_height - offset), com = filling() / (centre_height - offset) / 2;
    assert_true(cell(1, "tap") == 0);
    assert_share(cell(1, "density_all"), filling() / top_height, 1e-8);
    assert_true(cell(1, "density_all_tap_mean") == number_in(""));
    for (int row = 2; row <= TAPS + 1; row++) {
        /* half a step of 3.7e-6 s; heights at the turning points: 4e-8 */
        assert_true(fabs(cell(row, "tap") - (row - 2 + share)) < 3.7e-6 / 2 * frequency);
        assert_share(cell(row, "density_all"), all, 1e-7);
        assert_share(cell(row, "density_all_tap_mean"), all, 1e-7);
        assert_share(cell(row, "density_tap_mean"), 0.95 * all, 1e-7);
        assert_share(cell(row, "density_com"), com, 1e-7);
        assert_share(cell(row, "density_com_tap_mean"), com, 1e-7);
    }
    bed_free(&bed);
}

static void test_top(void **state)
{
    (void)state;
    check_phase(OZ_OBSERVE_TOP, 0.25, amplitude);
}

static void test_bottom(void **state)
{
    (void)state;
    check_phase(OZ_OBSERVE_BOTTOM, 0.75, -amplitude);
}

/* Rows two periods apart: means are of every period all the same, here of a sphere that is lifted.
 */
static void test_every_period_counts(void **state)
{
    (void)state;
    Bed bed;
    OzSeries *series = NULL;
    hang(&bed, OZ_OBSERVE_TOP);
    assert_int_equal(oz_series_create(&series, in_folder("m.csv"), &bed.scene, &bed.grains), OZ_OK);
    bed.snapshot.time = 0.25 / frequency;
    oz_snapshot_move_walls(&bed.snapshot);
    for (int k = 0; k < 3; k++) { /* the first is forgotten */
        bed.snapshot.position[2] = centre_z + k * 1e-3;
        oz_series_sample(series, &bed.snapshot);
    }
    assert_int_equal(oz_series_write(series, &bed.snapshot), OZ_OK);
    assert_int_equal(oz_series_free(series), OZ_OK);
    assert_share(cell(1, "density_all_tap_mean"), filling() * (1 / 7e-3 + 1 / 8e-3) / 2, 1e-8);
    bed.scene.observe.interval = 2 * bed.scene.period;
    OzSchedule schedule = oz_schedule_create(&bed.scene, -1);
    static const struct {
        double tap;
        int due;
    } events[] = {{0, OZ_DUE_ROW},
                  {0.25, OZ_DUE_ROW | OZ_DUE_SAMPLE},
                  {1.25, OZ_DUE_SAMPLE},
                  {2.25, OZ_DUE_ROW | OZ_DUE_SAMPLE},
                  {3, 0}};
    int64_t step = 0;
    int due = 0;
    for (size_t k = 0; k < sizeof events / sizeof events[0]; k++) {
        assert_true(oz_schedule_next(&schedule, &step, &due));
        assert_int_equal(step, llround(events[k].tap / frequency / bed.scene.step));
        assert_int_equal(due, events[k].due);
    }
    assert_false(oz_schedule_next(&schedule, &step, &due));
    bed_free(&bed);
}

static int clean_up(void **state)
{
    (void)state;
    return remove_folder((const char *const[]){"m.csv", NULL});
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_all_phases),
        cmocka_unit_test(test_top),
        cmocka_unit_test(test_bottom),
        cmocka_unit_test(test_every_period_counts),
    };
    return cmocka_run_group_tests(tests, make_folder, clean_up);
}
