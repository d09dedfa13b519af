/* Order of beds written by hand: along the container's axis, hexagonal across it, contacts of a
 * grain; against closed forms, and cells against a walk over all pairs. */
#include "hand_bed.h"
#include "hand_contacts.h"
#include "hand_series.h"

#include "observe/series.h"
#include "scene/boundary.h"

static const double PI = 3.14159265358979323846;

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

static void stand(Bed *bed, int64_t i, double x, double y, double z)
{
    put(bed, i, z, 0, 0, 1);
    bed->snapshot.position[3 * i] = x;
    bed->snapshot.position[3 * i + 1] = y;
}

/* Everything is turned so that z becomes x. */
static void lay_down(Bed *bed)
{
    for (int64_t i = 0; i < bed->grains.count; i++) {
        double *x = &bed->snapshot.position[3 * i], *u = &bed->snapshot.axis[3 * i];
        memcpy(x, (const double[3]){x[2], x[0], x[1]}, 3 * sizeof *x);
        memcpy(u, (const double[3]){u[2], u[0], u[1]}, 3 * sizeof *u);
    }
    memcpy(bed->walls[1].axis, (const double[3]){1, 0, 0}, sizeof bed->walls[1].axis);
    bed->walls[1].kind = OZ_WALL_CYLINDER;
}

/* Two layers, each a hexagon of three rings about a rod: corners have three neighbours. */
static void a_hexagonal_packing_of_upright_rods_is_perfect(void **state)
{
    (void)state;
    enum { RINGS = 3, LAYER = 1 + 3 * RINGS * (RINGS + 1) };
    Bed bed;
    int64_t i = 0;
    bed_create(&bed, 2 * LAYER, 0.5e-3, 2e-3);
    bed.scene.observe.order = true;
    for (int layer = 0; layer < 2; layer++) {
        for (int a = -RINGS; a <= RINGS; a++) {
            for (int b = -RINGS; b <= RINGS; b++) {
                if (abs(a + b) <= RINGS) { /* the second layer turned by ten degrees */
                    double x = 0.52e-3 * (a + 0.5 * b), y = 0.52e-3 * sqrt(0.75) * b;
                    double c = cos(layer * PI / 18), s = sin(layer * PI / 18);
                    stand(&bed, i++, c * x - s * y, s * x + c * y, 2e-3 + layer * 2.6e-3);
                }
            }
        }
    }
    assert_int_equal(i, 2 * LAYER);
    /* nine digits are written */
    assert_near(value_of(&bed, "psi6"), 1, 1e-8);
    assert_near(value_of(&bed, "nematic_axis"), 1, 1e-8);
    lay_down(&bed); /* the same in a cylinder about x */
    assert_near(value_of(&bed, "psi6"), 1, 1e-8);
    assert_near(value_of(&bed, "nematic_axis"), 1, 1e-8);
    memset(bed.walls[1].axis, 0, sizeof bed.walls[1].axis); /* across an upright one */
    assert_near(value_of(&bed, "nematic_axis"), -0.5, 1e-8);
    bed_free(&bed);
}

static void other_packings_are_not(void **state)
{
    (void)state;
    Bed bed;
    OzLocalOrder order = {0};
    bed_create(&bed, 9, 0.5e-3, 2e-3);
    for (int64_t i = 0; i < 9; i++) {
        stand(&bed, i, 0.51e-3 * (double)(i % 3), 0.51e-3 * (double)(i / 3), 2e-3);
    }
    assert_int_equal(oz_local_order_find(&order, &bed.snapshot), OZ_OK);
    assert_near(order.psi6[4], 0, 1e-12); /* four at right angles: 1 - 1 + 1 - 1 */
    for (int64_t i = 0; i < 9; i++) {     /* in a row: two neighbours say nothing */
        stand(&bed, i, 0.51e-3 * (double)i, 0, 2e-3);
    }
    assert_int_equal(oz_local_order_find(&order, &bed.snapshot), OZ_OK);
    assert_near(order.psi6[4], 0, 0);
    for (int64_t i = 1; i < 7; i++) { /* six about one that leans by 30 degrees: (3 cos^2 - 1)/2 */
        double theta = PI / 3 * (double)i;
        stand(&bed, i, 0.51e-3 * cos(theta), 0.51e-3 * sin(theta), 2e-3);
    }
    put(&bed, 0, 2e-3, 0.5, 0, sqrt(0.75));
    bed.snapshot.position[0] = bed.snapshot.position[1] = 0;
    stand(&bed, 7, 0, 0, 3.3e-3); /* above half a rod's height: not beside it */
    bed.grains.length[8] = 0;     /* a sphere is nobody's neighbour */
    stand(&bed, 8, 0.1e-3, 0, 2e-3);
    assert_int_equal(oz_local_order_find(&order, &bed.snapshot), OZ_OK);
    assert_near(order.psi6[0], 1, 1e-12);
    assert_near(order.crystal[0], 0.625, 1e-12);
    assert_near(order.psi6[8], 0, 0);
    oz_local_order_free(&order);
    bed_free(&bed);
}

/* As the header says it, without cells; of a periodic cell to the nearest image. */
static double walk_over_all(const Bed *bed, int64_t i)
{
    const OzSnapshot *s = &bed->snapshot;
    double cosine = 0, sine = 0, n = 0;
    for (int64_t k = 0; k < s->count; k++) {
        double way[3];
        for (int c = 0; c < 3; c++) {
            way[c] = s->position[3 * k + c] - s->position[3 * i + c];
            double period = oz_boundary_period(&bed->scene.boundary, c);
            way[c] = period > 0 ? remainder(way[c], period) : way[c];
        }
        double height = 0.5e-3 + 2e-3 * (fabs(s->axis[3 * i + 2]) + fabs(s->axis[3 * k + 2])) / 2;
        double theta = atan2(way[1], way[0]);
        bool beside = fabs(way[2]) <= height / 2 && hypot(way[0], way[1]) <= 1.4 * 0.5e-3;
        if (k != i && beside) {
            cosine += cos(6 * theta);
            sine += sin(6 * theta);
            n++;
        }
    }
    return n < 3 ? 0 : hypot(cosine, sine) / n;
}

static void random_axes_have_no_order(void **state)
{
    (void)state;
    enum { COUNT = 20000, FEW = 400 };
    Bed bed;
    OzLocalOrder order = {0};
    bed_create(&bed, COUNT, 0.5e-3, 2e-3);
    bed.scene.observe.order = true;
    fill_randomly(&bed);
    /* the deviation of one is 1/sqrt(5): four of the mean's */
    assert_near(value_of(&bed, "nematic_axis"), 0, 4 / sqrt(5.0 * COUNT));
    bed_free(&bed);
    bed_create(&bed, FEW, 0.5e-3, 2e-3);
    fill_randomly(&bed);
    double mean = 0, expected = 0;
    for (int64_t i = 0; i < FEW; i++) { /* closer, so that there are neighbours */
        for (int k = 0; k < 3; k++) {
            bed.snapshot.position[3 * i + k] *= 0.2;
        }
    }
    assert_int_equal(oz_local_order_find(&order, &bed.snapshot), OZ_OK);
    for (int64_t i = 0; i < FEW; i++) {
        double own = walk_over_all(&bed, i);
        assert_near(order.psi6[i], own, 1e-12);
        mean += own / FEW;
    }
    /* of n directions at random |mean of exp(6 i theta)| is sqrt(pi / 4 n): here n is some 12 */
    bed.scene.observe.order = true;
    expected = sqrt(PI / 4 / 12);
    assert_near(value_of(&bed, "psi6"), mean, 1e-8);
    assert_near(mean, expected, 0.3 * expected); /* n spreads */
    oz_local_order_free(&order);
    bed_free(&bed);
}

/* Cells of five, two and one cells of the search, and an open direction beside them; rods that have
 * gone on through many. */
static void neighbours_across_a_periodic_border_count(void **state)
{
    (void)state;
    enum { COUNT = 300, BOUNDARIES = 4 };
    const OzBoundaryKind P = OZ_BOUNDARY_PERIODIC, O = OZ_BOUNDARY_OPEN;
    const OzBoundary boundaries[BOUNDARIES] = {
        {.present = true, .along = {P, P, P}, .size = {4e-3, 4e-3, 6e-3}},
        {.present = true, .along = {P, P, O}, .size = {1.5e-3, 4e-3, 0}},
        {.present = true, .along = {P, P, O}, .size = {1.2e-3, 5e-3, 0}},
        {.present = true, .along = {O, O, P}, .size = {0, 0, 6e-3}}};
    Bed bed;
    OzLocalOrder order = {0};
    bed_create(&bed, COUNT, 0.5e-3, 2e-3);
    fill_randomly(&bed);
    bed.scene.wall_count = 0;
    for (int64_t i = 0; i < 3 * COUNT; i++) { /* within 4 mm, of height 6 mm */
        bed.snapshot.position[i] *= i % 3 == 2 ? 0.3 : 0.2;
    }
    for (int b = 0; b < BOUNDARIES; b++) {
        int across = 0;
        bed.scene.boundary = (OzBoundary){0};
        assert_int_equal(oz_local_order_find(&order, &bed.snapshot), OZ_OK);
        double open[COUNT];
        memcpy(open, order.psi6, sizeof open);
        bed.scene.boundary = boundaries[b];
        for (int64_t i = 0; i < COUNT; i += 3) {
            int c = boundaries[b].along[0] == P ? 0 : 2;
            bed.snapshot.position[3 * i + c] += 7 * boundaries[b].size[c];
        }
        assert_int_equal(oz_local_order_find(&order, &bed.snapshot), OZ_OK);
        for (int64_t i = 0; i < COUNT; i++) { /* 7 cells on, a place keeps 12 digits */
            assert_near(order.psi6[i], walk_over_all(&bed, i), 1e-9);
            across += fabs(order.psi6[i] - open[i]) > 1e-6;
        }
        assert_true(across > COUNT / 20);
        for (int64_t i = 0; i < COUNT; i += 3) {
            int c = boundaries[b].along[0] == P ? 0 : 2;
            bed.snapshot.position[3 * i + c] -= 7 * boundaries[b].size[c];
        }
    }
    oz_local_order_free(&order);
    bed_free(&bed);
}

static void contacts_are_counted_by_grain(void **state)
{
    (void)state;
    Bed bed;
    bed_create(&bed, 2, 1e-3, 3e-3);
    bed.scene.observe.order = true;
    hand_contact(&bed.snapshot, (OzContactEntry){.a = 0, .b = 1});
    assert_near(value_of(&bed, "contact_number"), 1, 0); /* two that touch: one each */
    assert_near(value_of(&bed, "rattler_count"), 2, 0);
    hand_contact(&bed.snapshot, (OzContactEntry){.a = 0, .b = 1, .part_b = 1});
    assert_near(value_of(&bed, "contact_number"), 1, 0); /* in two points */
    assert_near(value_of(&bed, "rattler_count"), 2, 0);
    hand_contact(&bed.snapshot, (OzContactEntry){.a = 0, .b = -1});
    assert_near(value_of(&bed, "contact_number"), 1, 0); /* walls are no grains */
    assert_near(value_of(&bed, "rattler_count"), 1, 0);  /* but they hold one */
    bed_free(&bed);
}

static int clean_up(void **state)
{
    (void)state;
    return remove_folder((const char *const[]){"one.csv", NULL});
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_hexagonal_packing_of_upright_rods_is_perfect),
        cmocka_unit_test(other_packings_are_not),
        cmocka_unit_test(random_axes_have_no_order),
        cmocka_unit_test(neighbours_across_a_periodic_border_count),
        cmocka_unit_test(contacts_are_counted_by_grain),
    };
    return cmocka_run_group_tests(tests, make_folder, clean_up);
}
