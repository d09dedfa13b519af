/* Observables of flat grains against states written by hand whose answers are known. */
#include "hand_contacts.h"
#include "hand_heap.h"
#include "hand_series.h"

#include "observe/final.h"
#include "observe/inclination.h"
#include "observe/schedule.h"
#include "observe/series.h"
#include "observe/spectrum.h"

static const double PI = 3.14159265358979323846;
static const double DEGREES = 180 / 3.14159265358979323846;
static const char *file_name = "series.csv";

static double value_in(int row, const char *name)
{
    char cell[64];
    read_cell(in_folder(file_name), row, name, cell);
    return number_in(cell);
}

static OzSeries *open_series(const Heap *heap)
{
    OzSeries *series = NULL;
    assert_int_equal(oz_series_create(&series, in_folder(file_name), &heap->scene, &heap->grains),
                     OZ_OK);
    return series;
}

static void close_series(OzSeries *series)
{
    assert_int_equal(oz_series_free(series), OZ_OK);
}

static void write_once(const Heap *heap)
{
    OzSeries *series = open_series(heap);
    assert_int_equal(oz_series_write(series, &heap->snapshot), OZ_OK);
    close_series(series);
}

/* A rigid square of edge a and mass M has M a^2 / 6 about its centre; the elements' shares of
 * motion and spin must come to the same. Nine digits are written. */
static void energies_are_those_of_a_rigid_square(void **state)
{
    (void)state;
    Heap heap;
    double edge = 2e-3, mass = HEAP_DENSITY * edge * edge, inertia = mass * edge * edge / 6;
    double moving = mass / 2 * (0.3 * 0.3 + 0.4 * 0.4), turning = inertia / 2 * 70 * 70;
    heap_create(&heap, 1, 0, 0);
    heap.scene.gravity[1] = -9.81;
    heap.scene.observe.ledger = true;
    heap_put_square(&heap, 0, 1e-3, 5e-3, edge, 0.7);
    heap_start(&heap);
    heap_push(&heap, 0, 0.3, -0.4, -70);
    write_once(&heap);
    assert_near(value_in(1, "kinetic") + value_in(1, "rotational"), moving + turning,
                1e-8 * (moving + turning));
    assert_true(value_in(1, "kinetic") > moving * (1 + 1e-6)); /* turning moves the triangles */
    /* nine digits, as above; of spins of 70, 1e-7 */
    assert_near(value_in(1, "energy_potential"), mass * 9.81 * 5e-3, 1e-8 * mass * 9.81 * 5e-3);
    assert_near(value_in(1, "speed_max"), 0.5, 1e-8);
    assert_near(value_in(1, "spin_mean"), 70, 1e-7);
    assert_near(value_in(1, "spin_0"), -70, 1e-7);
    assert_near(value_in(1, "spin_1"), -1e99, 0);
    heap_free(&heap);
}

static void residual_counts_every_account(void **state)
{
    (void)state;
    Heap heap;
    heap_create(&heap, 1, 0, 0);
    heap.scene.observe.ledger = true;
    heap.snapshot.has_ledger = true;
    hand_contact(&heap.snapshot, (OzContactEntry){.b = -1, .energy = 8e-6});
    heap_put_square(&heap, 0, 0, 0, 2e-3, 0);
    heap_start(&heap);
    OzSeries *series = open_series(&heap);
    assert_int_equal(oz_series_write(series, &heap.snapshot), OZ_OK);
    heap.snapshot.time = 0.1;
    heap.snapshot.contacts.entry[0].energy = 1e-6;
    heap.snapshot.beams.energy = 2e-6;
    heap.snapshot.element_ledger = (OzElementLedger){1e-7, 2e-7, 4e-7, 8e-7, 16e-7, 0, 0};
    assert_int_equal(oz_series_write(series, &heap.snapshot), OZ_OK);
    close_series(series);
    assert_near(value_in(1, "energy_residual"), 0, 0);
    /* nine digits of 5e-6; the others have one */
    assert_near(value_in(2, "energy_residual"), 1e-6 + 2e-6 + 15e-7 - 16e-7 - 8e-6, 1e-14);
    assert_near(value_in(2, "energy_beam_axial"), 1e-7, 0);
    assert_near(value_in(2, "energy_beam_bending"), 2e-7, 0);
    assert_near(value_in(2, "energy_disc_damping"), 4e-7, 0);
    assert_near(value_in(2, "energy_disc_friction"), 8e-7, 0);
    assert_near(value_in(2, "work_walls"), 16e-7, 0);
    assert_near(value_in(2, "energy_contact"), 1e-6, 0);
    assert_near(value_in(2, "energy_beam"), 2e-6, 0);
    heap_free(&heap);
}

static void each_model_has_its_columns(void **state)
{
    (void)state;
    Heap heap;
    char *text = NULL;
    heap_create(&heap, 1, 0, 0);
    heap_put_square(&heap, 0, 0, 0, 2e-3, 0);
    heap_start(&heap);
    write_once(&heap);
    assert_int_equal(oz_file_read(&text, NULL, in_folder(file_name)), OZ_OK);
    assert_null(strstr(text, "nan"));
    assert_null(strstr(text, "density"));
    assert_null(strstr(text, "nematic"));
    assert_null(strstr(text, "overlap_max"));
    assert_null(strstr(text, "energy_potential")); /* no ledger is asked for */
    free(text);
    assert_near(value_in(1, "touches_i"), -1e99, 0); /* no contacts are known */
    assert_near(value_in(1, "outflow_count"), -1e99, 0);
    assert_near(value_in(1, "inclination"), -1e99, 0);
    heap_free(&heap);
}

/* 25 contacts: 7 at the wall, the others of three pairs of grains. Of their overlaps those of
 * triangles have the sum 4e-8; discs' are lengths and do not count. */
static void put_contacts(OzSnapshot *snapshot)
{
    const int counts[OZ_CONTACT_KINDS] = {0, 12, 1, 2, 3, 0, 2, 5};
    for (int kind = 0, i = 0; kind < OZ_CONTACT_KINDS; kind++) {
        for (int k = 0; k < counts[kind]; k++, i++) {
            OzContactEntry entry = {.a = i % 3, .b = i < 7 ? -1 : i % 3 + 1, .part_a = i};
            entry.kind = (OzContactKind)kind;
            entry.overlap = kind == OZ_CONTACT_DISC ? 1 : i == 3 ? 9e-9 : 31e-9 / 19;
            hand_contact(snapshot, entry);
        }
    }
}

static void contacts_are_counted_by_kind(void **state)
{
    (void)state;
    Heap heap;
    heap_create(&heap, 2, 2, 0);
    heap_put_square(&heap, 0, 0, 0, 2e-3, 0);
    heap_put_square(&heap, 1, 2e-3, 0, 2e-3, 0);
    heap_put_disc(&heap, 2, 4e-3, 0, 1e-3);
    heap_put_disc(&heap, 3, 6e-3, 0, 1e-3);
    heap_start(&heap);
    heap.snapshot.beams =
        (OzBeamSums){.stretch_min = 0.98, .stretch_max = 1.01, .bend_max = PI / 90};
    put_contacts(&heap.snapshot);
    write_once(&heap);
    assert_near(value_in(1, "touches_i"), 12, 0);
    assert_near(value_in(1, "touches_vi"), 2, 0);
    assert_near(value_in(1, "touches_disc"), 5, 0);
    /* nine digits are written */
    assert_near(value_in(1, "share_i"), 0.6, 1e-9); /* of 20 contacts of triangles */
    assert_near(value_in(1, "share_iv"), 0.15, 1e-9);
    assert_near(value_in(1, "contact_count"), 3, 0);
    assert_near(value_in(1, "contact_number"), 1.5, 0);
    assert_near(value_in(1, "wall_touches"), 7, 0);
    assert_near(value_in(1, "overlap_area_max"), 9e-9, 0);
    /* nine digits; 2 of a bend of pi / 90 in degrees */
    assert_near(value_in(1, "overlap_area_mean"), 2e-9, 1e-17);
    assert_near(value_in(1, "stretch_min"), 0.98, 0);
    assert_near(value_in(1, "stretch_max"), 1.01, 0);
    assert_near(value_in(1, "bend_max"), 2, 1e-8);
    heap_free(&heap);
}

static void outflow_is_what_is_below_the_outlet(void **state)
{
    (void)state;
    Heap heap;
    double mass = HEAP_DENSITY * PI * 1e-6;
    heap_create(&heap, 0, 4, 0);
    heap.scene.observe = (OzObserve){.outlet = -1e-3, .has_outlet = true};
    for (int64_t g = 0; g < 4; g++) {
        heap_put_disc(&heap, g, 3e-3 * (double)g, g == 0 ? -2e-3 : 1e-3, 1e-3);
    }
    heap_start(&heap);
    OzSeries *series = open_series(&heap);
    assert_int_equal(oz_series_write(series, &heap.snapshot), OZ_OK);
    heap_move(&heap, 1, 0, -5e-3, 0);
    heap_move(&heap, 3, 0, -5e-3, 0);
    heap.snapshot.time = 0.25;
    assert_int_equal(oz_series_write(series, &heap.snapshot), OZ_OK);
    close_series(series);
    assert_near(value_in(1, "outflow_count"), 1, 0);
    assert_near(value_in(1, "outflow_rate"), -1e99, 0);
    assert_near(value_in(2, "outflow_count"), 3, 0);
    /* nine digits */
    assert_near(value_in(2, "outflow_mass"), 3 * mass, 1e-8 * mass);
    assert_near(value_in(2, "outflow_rate"), 2 * mass / 0.25, 1e-7 * mass);
    heap_free(&heap);
}

/* A drum of 4 cm about (1, 2) cm and gravity turned by lean to the right of straight down. */
static void make_drum(Heap *heap, double lean)
{
    heap->wall = (OzWall){.kind = OZ_WALL_DRUM, .point = {0.01, 0.02}, .diameter = 0.04};
    heap->wall.motion = (OzMotion){.present = true, .angular_velocity = 0.1};
    heap->scene.walls = &heap->wall;
    heap->scene.wall_count = 1;
    heap->scene.gravity[0] = 9.81 * sin(lean);
    heap->scene.gravity[1] = -9.81 * cos(lean);
    heap->scene.observe.interval = 0.1;
}

/* Equal circles side by side on a slanting line: their envelope ripples evenly about a line of the
 * same slope. */
static void surface_is_the_line_on_which_grains_lie(void **state)
{
    (void)state;
    enum { GRAINS = 400 };
    double slope = 25 / DEGREES, lean = 0.2;
    Heap heap;
    heap_create(&heap, 0, GRAINS, 1);
    for (int64_t g = 0; g < GRAINS; g++) {
        double along = 0.036 * ((double)g / GRAINS - 0.5), deep = g % 2 ? 2e-3 : 0;
        double angle = slope + lean; /* level is across gravity */
        heap_put_disc(&heap, g, 0.01 + along * cos(angle) + deep * sin(angle),
                      0.02 + along * sin(angle) - deep * cos(angle), 1e-3);
    }
    heap_put_wall(&heap, 0, (const double[6]){0, 0, 1, 0, 0, 1});
    heap_start(&heap);
    make_drum(&heap, lean);
    double angle = 0;
    assert_true(oz_inclination_surface(&heap.snapshot, &angle));
    /* The ripple of circles 0.18 mm apart is 4 um high: over 20 mm, less than 0.02 degrees. */
    assert_near(angle * DEGREES, 25, 0.02);
    heap.wall.motion.angular_velocity = -0.1;
    assert_true(oz_inclination_surface(&heap.snapshot, &angle));
    assert_near(angle * DEGREES, -25, 0.02);
    heap.wall.kind = OZ_WALL_VESSEL;
    assert_false(oz_inclination_surface(&heap.snapshot, &angle));
    heap_free(&heap);
}

static void centre_is_seen_from_the_axis(void **state)
{
    (void)state;
    double slope = 30 / DEGREES, lean = -0.1, away = 0.012;
    Heap heap;
    heap_create(&heap, 0, 2, 1);
    for (int64_t g = 0; g < 2; g++) { /* the one as far off to the side as the other */
        double aside = g ? 4e-3 : -4e-3;
        heap_put_disc(&heap, g, 0.01 + away * sin(slope + lean) + aside,
                      0.02 - away * cos(slope + lean), 1e-3);
    }
    heap_put_wall(&heap, 0, (const double[6]){0, 0, 1, 0, 0, 1});
    heap_start(&heap);
    make_drum(&heap, lean);
    double angle = 0;
    assert_true(oz_inclination_centre(&heap.snapshot, &angle));
    /* rounding of 30 */
    assert_near(angle * DEGREES, 30, 1e-13);
    heap_move(&heap, 0, -away * sin(slope + lean), away * cos(slope + lean), 0);
    heap_move(&heap, 1, -away * sin(slope + lean), away * cos(slope + lean), 0);
    assert_false(oz_inclination_centre(&heap.snapshot, &angle)); /* about the axis itself */
    heap_free(&heap);
}

/* Places the one big grain where the bed's centre is to be. */
static void tilt(Heap *heap, double degrees)
{
    double x = 0.01 + 0.01 * sin(degrees / DEGREES), y = 0.02 - 0.01 * cos(degrees / DEGREES);
    heap_move(heap, 0, x - heap->snapshot.position[0], y - heap->snapshot.position[1], 0);
}

/* A saw of 10 rows: up by 0.6 degrees seven times, down by 1.4 three times. */
static double saw(int row)
{
    int phase = row % 10;
    return phase <= 7 ? 10 + 0.6 * phase : 14.2 - 1.4 * (phase - 7);
}

static void avalanches_are_the_falls_of_a_saw(void **state)
{
    (void)state;
    Heap heap;
    heap_create(&heap, 0, 1, 1);
    heap_put_disc(&heap, 0, 0, 0, 9e-3);
    heap_put_wall(&heap, 0, (const double[6]){0, 0, 1, 0, 0, 1});
    heap_start(&heap);
    make_drum(&heap, 0);
    OzSeries *series = open_series(&heap);
    for (int row = 0; row < 80; row++) {
        heap.snapshot.time = 0.1 * row;
        tilt(&heap, saw(row));
        assert_int_equal(oz_series_write(series, &heap.snapshot), OZ_OK);
    }
    heap.snapshot.time += 0.03; /* a last row out of the even series is no sample */
    tilt(&heap, 50);
    assert_int_equal(oz_series_write(series, &heap.snapshot), OZ_OK);
    assert_int_equal(oz_series_write_spectrum(series, in_folder("spectrum.csv")), OZ_OK);
    close_series(series);
    /* nine digits are written, here and below */
    assert_near(value_in(11, "inclination_centre"), 10, 1e-7);
    assert_near(value_in(9, "avalanche_count"), 0, 0);
    assert_near(value_in(11, "avalanche_count"), 0, 0);
    assert_near(value_in(12, "avalanche_count"), 1, 0); /* it has turned up again */
    /* nine digits of angles */
    assert_near(value_in(12, "avalanche_size"), 4.2, 1e-7);
    assert_near(value_in(80, "avalanche_count"), 7, 0);
    /* nine digits; a saw of 4.2 degrees deviates by 4.2 / sqrt(12) = 1.2 */
    assert_near(value_in(80, "inclination"), value_in(10, "inclination"), 1e-7);
    assert_true(value_in(80, "inclination_deviation") > 1);
    /* 40 samples of 0.1 s hold four teeth: all of the spectrum is in multiples of 1 Hz. */
    file_name = "spectrum.csv";
    for (int k = 1; k <= 20; k++) {
        double amplitude = value_in(k, "inclination_centre");
        /* nine digits; those of rows are noise in the amplitudes */
        assert_near(value_in(k, "frequency"), 0.25 * k, 1e-9);
        assert_true(k % 4 == 0 ? amplitude > 0.01 : amplitude < 1e-8);
        assert_true(k <= 4 || amplitude < value_in(4, "inclination_centre"));
    }
    file_name = "series.csv";
    heap_free(&heap);
}

static void spectrum_gives_amplitudes(void **state)
{
    (void)state;
    enum { COUNT = 600 };
    double values[COUNT];
    for (int i = 0; i < COUNT; i++) {
        double turn = 2 * PI * i / COUNT;
        values[i] = 30 + 1.5 * sin(7 * turn + 0.4) - 0.25 * cos(41 * turn) + (i % 2 ? -0.1 : 0.1);
    }
    /* means of 600 products: rounding of 30 */
    assert_near(oz_spectrum_amplitude(values, COUNT, 7), 1.5, 1e-13);
    assert_near(oz_spectrum_amplitude(values, COUNT, 41), 0.25, 1e-13);
    assert_near(oz_spectrum_amplitude(values, COUNT, 300), 0.1, 1e-13);
    assert_near(oz_spectrum_amplitude(values, COUNT, 8), 0, 1e-13);
}

/* Steps of 1 ms: a state every 4 ms, a row every 10 ms. */
static void strobe_is_due_at_its_steps(void **state)
{
    (void)state;
    OzScene scene = {.step = 1e-3, .duration = 0.02};
    scene.observe.interval = 0.01;
    scene.snapshots.strobe = 4e-3;
    OzSchedule schedule = oz_schedule_create(&scene, -1);
    static const int64_t steps[] = {0, 4, 8, 10, 12, 16, 20};
    int64_t step = 0;
    int due = 0;
    for (size_t i = 0; i < sizeof steps / sizeof steps[0]; i++) {
        assert_true(oz_schedule_next(&schedule, &step, &due));
        assert_int_equal(step, steps[i]);
        assert_int_equal(due & OZ_DUE_STROBE, steps[i] % 4 == 0 ? OZ_DUE_STROBE : 0);
        assert_int_equal(due & OZ_DUE_ROW, steps[i] % 10 == 0 ? OZ_DUE_ROW : 0);
    }
    assert_false(oz_schedule_next(&schedule, &step, &due));
    OzScene other = scene;
    other.snapshots.strobe = 0;
    OzSchedule plain = oz_schedule_create(&other, -1);
    schedule = oz_schedule_create(&scene, -1);
    assert_false(oz_schedule_agrees(&schedule, &plain));
}

static void final_has_a_row_for_each_grain(void **state)
{
    (void)state;
    Heap heap;
    char *text = NULL;
    heap_create(&heap, 1, 1, 0);
    heap_put_square(&heap, 0, 1e-3, 2e-3, 2e-3, 0.3);
    heap_put_disc(&heap, 1, 5e-3, 2e-3, 1e-3);
    heap_start(&heap);
    heap_move(&heap, 0, 1e-3, 0, 7);
    heap_push(&heap, 0, 0.25, -0.5, 8);
    assert_int_equal(oz_final_write(&heap.snapshot, in_folder("final.csv")), OZ_OK);
    assert_int_equal(oz_file_read(&text, NULL, in_folder("final.csv")), OZ_OK);
    double row[2][10];
    char *line = strchr(text, '\n') + 1;
    assert_memory_equal(text, OZ_FINAL_FLAT_HEADER "\n", strlen(OZ_FINAL_FLAT_HEADER "\n"));
    for (int i = 0; i < 20; i++) {
        row[i / 10][i % 10] = strtod(line, &line);
        line++;
    }
    /* The order of values as the header has it; sums over four elements round a few times. */
    const double square[] = {0, 2e-3, 2e-3, 7, 0.25, -0.5, 8, 4, 4e-6, 1.6e-5};
    const double disc[] = {1, 5e-3, 2e-3, 0, 0, 0, 0, 1, PI * 1e-6, HEAP_DENSITY * PI * 1e-6};
    for (int k = 0; k < 10; k++) {
        /* seventeen digits: some roundings of the four elements' sums, one of the disc's */
        assert_near(row[0][k], square[k], 1e-14 * fmax(fabs(square[k]), 1));
        assert_near(row[1][k], disc[k], 1e-15);
    }
    free(text);
    heap_free(&heap);
}

/* Two rows: at rest with something stored, then with that much more (and more still). */
static OzStatus heat_up(double gain, double lost, bool moving_wall)
{
    Heap heap;
    heap_create(&heap, 1, 0, 1);
    heap_put_square(&heap, 0, 0, 0, 2e-3, 0);
    heap_put_wall(&heap, 0, (const double[6]){0, 0, 1, 0, 0, 1});
    heap_start(&heap);
    heap.wall.motion.present = moving_wall;
    heap.snapshot.has_contacts = true;
    heap.snapshot.beams.energy = 1e-6;
    OzSeries *series = open_series(&heap);
    assert_int_equal(oz_series_write(series, &heap.snapshot), OZ_OK);
    heap.snapshot.beams.energy += gain;
    heap.snapshot.has_ledger = lost > 0;
    heap.snapshot.element_ledger.beam_axial = lost;
    OzStatus status = oz_series_write(series, &heap.snapshot);
    close_series(series);
    heap_free(&heap);
    return status;
}

static void energy_from_nowhere_is_noticed(void **state)
{
    (void)state;
    assert_int_equal(heat_up(0.9e-6, 0, false), OZ_OK);
    assert_int_equal(heat_up(1.1e-6, 0, false), OZ_ERR_BLOWUP);
    assert_int_equal(heat_up(1.1e-6, 3e-6, false),
                     OZ_ERR_BLOWUP); /* what is lost excuses nothing */
    assert_int_equal(heat_up(1.1e-6, 0, true), OZ_OK);
}

static int end(void **state)
{
    (void)state;
    return remove_folder((const char *const[]){"series.csv", "spectrum.csv", "final.csv", NULL});
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(energies_are_those_of_a_rigid_square),
        cmocka_unit_test(residual_counts_every_account),
        cmocka_unit_test(each_model_has_its_columns),
        cmocka_unit_test(contacts_are_counted_by_kind),
        cmocka_unit_test(outflow_is_what_is_below_the_outlet),
        cmocka_unit_test(surface_is_the_line_on_which_grains_lie),
        cmocka_unit_test(centre_is_seen_from_the_axis),
        cmocka_unit_test(avalanches_are_the_falls_of_a_saw),
        cmocka_unit_test(spectrum_gives_amplitudes),
        cmocka_unit_test(strobe_is_due_at_its_steps),
        cmocka_unit_test(final_has_a_row_for_each_grain),
        cmocka_unit_test(energy_from_nowhere_is_noticed),
    };
    return cmocka_run_group_tests(tests, make_folder, end);
}
