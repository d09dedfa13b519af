/* Columns that stand for each of several things: the force on each wall, along each axis. */
#include "hand_bed.h"
#include "hand_contacts.h"
#include "hand_series.h"

#include "observe/series.h"

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

static void test_walls_feel_their_contacts(void **state)
{
    (void)state;
    Bed bed;
    char *text = NULL;
    static const char end[] = ",deep_count,wall0_fx,wall0_fy,wall0_fz,wall1_fx,wall1_fy,wall1_fz,"
                              "wall0_tx,wall0_ty,wall0_tz,wall1_tx,wall1_ty,wall1_tz\n";
    bed_create(&bed, 2, 1e-3, 3e-3);
    bed.scene.observe.walls = OZ_OBSERVE_WALLS_INSTANT;
    assert_near(value_of(&bed, "wall1_fz"), -1e99, 0); /* without contacts nothing is known */
    hand_contact(&bed.snapshot, (OzContactEntry){.b = 1, .push = 64, .normal = {1, 0, 0}});
    hand_contact(
        &bed.snapshot,
        (OzContactEntry){.b = -1, .push = 3, .normal = {0, 0, -1}, .tangential = {0.5, 0, 0}});
    hand_contact(&bed.snapshot, (OzContactEntry){.a = 1, .b = -1, .push = 4, .normal = {0, 0, -1}});
    hand_contact(&bed.snapshot, (OzContactEntry){.a = 1, .b = -2, .push = 2, .normal = {0, 1, 0}});
    assert_near(value_of(&bed, "wall0_fx"), 0.5, 0);
    assert_near(value_of(&bed, "wall0_fy"), 0, 0);
    assert_near(value_of(&bed, "wall0_fz"), -7, 0);
    assert_near(value_of(&bed, "wall1_fy"), 2, 0);
    assert_near(value_of(&bed, "wall1_fz"), 0, 0);
    memcpy(bed.scene.walls[0].point, (const double[3]){2, 0, 0}, sizeof(double[3]));
    bed.snapshot.wall_offset[0] = 1;
    assert_near(value_of(&bed, "wall0_tx"), 0, 0);
    assert_near(value_of(&bed, "wall0_ty"), -14 - 0.5, 0);
    assert_near(value_of(&bed, "wall1_tz"), 0, 0);
    assert_int_equal(oz_file_read(&text, NULL, in_folder("one.csv")), OZ_OK);
    char *line = strchr(text, '\n');
    line[1] = '\0';
    assert_string_equal(line + 1 - strlen(end), end);
    free(text);
    const OzColumn *last = oz_series_columns();
    char name[OZ_COLUMN_NAME];
    while (strcmp(last->name, "wall<i>_f<x>") != 0) {
        last++;
    }
    bed.scene.model = OZ_MODEL_TRIGRAINS; /* in a plane */
    assert_int_equal(oz_observables_cells(last, &bed.scene), 4);
    oz_observables_name(last, &bed.scene, 3, name);
    assert_string_equal(name, "wall1_fy");
    assert_int_equal(oz_observables_cells(last + 1, &bed.scene), 2);
    oz_observables_name(last + 1, &bed.scene, 1, name);
    assert_string_equal(name, "wall1_tz");
    bed_free(&bed);
}

static void must(OzStatus status)
{
    if (status != OZ_OK) {
        fail_msg("%s", oz_status_text());
    }
}

static void assert_cell(int row, const char *name, const char *expected)
{
    char cell[64];
    read_cell(in_folder("two.csv"), row, name, cell);
    assert_string_equal(cell, expected);
}

static void set_walls(Bed *bed, OzSeries *series, bool wanted)
{
    bed->scene.observe.walls = wanted ? OZ_OBSERVE_WALLS_INSTANT : OZ_OBSERVE_WALLS_NONE;
    must(oz_series_take(series));
}

/* Columns that a change brings are empty in the rows before it, and in those after they are no
 * longer asked for. A run that goes on from a state before the change has its rows as they were. */
static void test_columns_come_with_a_change(void **state)
{
    (void)state;
    Bed bed;
    OzSeries *series = NULL;
    OzState kept = {0};
    OzStateVisit visit = oz_state_save(&kept);
    char *before = NULL, *after = NULL;
    bed_create(&bed, 2, 1e-3, 3e-3);
    hand_contact(&bed.snapshot, (OzContactEntry){.a = 1, .b = -1, .push = 4, .normal = {0, 0, -1}});
    must(oz_series_create(&series, in_folder("two.csv"), &bed.scene, &bed.grains));
    must(oz_series_write(series, &bed.snapshot));
    must(oz_series_write(series, &bed.snapshot));
    must(oz_series_state(series, &visit));
    must(oz_state_finish(&visit));
    must(oz_file_read(&before, NULL, in_folder("two.csv")));
    set_walls(&bed, series, true);
    must(oz_series_write(series, &bed.snapshot));
    set_walls(&bed, series, false);
    must(oz_series_write(series, &bed.snapshot));
    must(oz_series_free(series));
    assert_cell(1, "wall0_fz", "");
    assert_cell(2, "wall0_fz", "");
    assert_cell(3, "wall0_fz", "-4");
    assert_cell(4, "wall0_fz", "");
    assert_cell(2, "deep_count", "0");
    assert_cell(4, "deep_count", "0");
    must(oz_series_go_on(&series, in_folder("two.csv"), &bed.scene, &bed.grains));
    visit = oz_state_load(&kept);
    must(oz_series_state(series, &visit));
    must(oz_state_finish(&visit));
    must(oz_series_free(series));
    must(oz_file_read(&after, NULL, in_folder("two.csv")));
    assert_string_equal(after, before);
    assert_false(oz_file_exists(in_folder("two.csv.part")));
    free(before);
    free(after);
    oz_state_free(&kept);
    bed_free(&bed);
}

static int clean_up(void **state)
{
    (void)state;
    return remove_folder((const char *const[]){"one.csv", "two.csv", NULL});
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_walls_feel_their_contacts),
        cmocka_unit_test(test_columns_come_with_a_change),
    };
    return cmocka_run_group_tests(tests, make_folder, clean_up);
}
