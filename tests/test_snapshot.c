/* What a state tells of bodies made of elements, of walls that move, and what rows of a drum add up
 * to. */
#include "hand_bed.h"
#include "hand_heap.h"

#include "observe/flow.h"
#include "observe/inclination.h"

static const double PI = 3.14159265358979323846;

/* A square turned as a rigid body: half the angle about z, and the centre's motion. */
static void test_grains_of_their_elements(void **state)
{
    (void)state;
    Heap heap;
    heap_create(&heap, 1, 0, 0);
    heap_put_square(&heap, 0, 1e-3, 2e-3, 2e-3, 0.3);
    heap_start(&heap);
    heap_move(&heap, 0, 3e-3, 0, 0.8);
    heap_push(&heap, 0, 0.25, -0.5, 8);
    const OzSnapshot *s = &heap.snapshot;
    /* last digits; the spin is a momentum of parts over an inertia */
    assert_near(s->quaternion[0], cos(0.4), 1e-15);
    assert_near(s->quaternion[3], sin(0.4), 1e-15);
    assert_near(s->position[0], 4e-3, 1e-16);
    assert_near(s->velocity[1], -0.5, 1e-15);
    assert_near(s->angular_velocity[2], 8, 1e-13);
    heap_free(&heap);
}

/* z = A sin(w t), v = A w cos(w t). */
static void test_walls_swing(void **state)
{
    (void)state;
    Bed bed;
    bed_create(&bed, 1, 1e-3, 0);
    bed.walls[0].motion = (OzMotion){.present = true, .frequency = 30, .amplitude = 2e-3};
    for (int k = 0; k < 9; k++) {
        bed.snapshot.time = k / 120.0; /* quarters of a period */
        oz_snapshot_move_walls(&bed.snapshot);
        double rise[] = {0, 1, 0, -1}, speed[] = {1, 0, -1, 0}, fastest = 2e-3 * 2 * PI * 30;
        /* phases up to 12.6 have a last digit of 2e-15, times amplitude and speed */
        assert_near(bed.snapshot.wall_offset[0], 2e-3 * rise[k % 4], 2e-3 * 4e-15);
        assert_near(bed.snapshot.wall_velocity[0], fastest * speed[k % 4], fastest * 4e-15);
        assert_true(bed.snapshot.wall_offset[1] == 0 && bed.snapshot.wall_velocity[1] == 0);
        /* while grains settle walls stand still, whatever the time since that began */
        bed.snapshot.settling = true;
        oz_snapshot_move_walls(&bed.snapshot);
        assert_true(bed.snapshot.wall_offset[0] == 0 && bed.snapshot.wall_velocity[0] == 0);
        bed.snapshot.settling = false;
    }
    bed_free(&bed);
}

static void make_drum(Heap *heap)
{
    heap->wall = (OzWall){.kind = OZ_WALL_DRUM, .diameter = 0.04};
    heap->wall.motion = (OzMotion){.present = true, .angular_velocity = 0.1};
    heap->scene.gravity[1] = -9.81;
    heap->scene.observe.interval = 0.1;
}

/* Grains on a line over the right part of the columns alone: the fit's slope is the line's. The
 * leftmost column may see a grain's side, 0.1 mm lower: 0.07 degrees. */
static void test_slope_of_a_bed_on_one_side(void **state)
{
    (void)state;
    enum { GRAINS = 400 };
    Heap heap;
    heap_create(&heap, 0, GRAINS, 1);
    for (int64_t g = 0; g < GRAINS; g++) {
        double x = -0.002 + 0.02 * (double)g / GRAINS;
        heap_put_disc(&heap, g, x, tan(25 * PI / 180) * x, 1e-4);
    }
    heap_put_wall(&heap, 0, (const double[6]){0, 0, 1, 0, 0, 1});
    heap_start(&heap);
    make_drum(&heap);
    double angle = 0;
    assert_true(oz_inclination_surface(&heap.snapshot, &angle));
    /* see above: 0.07 at most */
    assert_near(angle * 180 / PI, 25, 0.07);
    heap_free(&heap);
}

/* Mean and standard deviation (of a sample: over n - 1) of the later half of the rows. */
static void test_rows_of_a_drum(void **state)
{
    (void)state;
    enum { ROWS = 11 };
    Heap heap;
    OzFlow flow = {0};
    double seen[ROWS], sum = 0, square = 0;
    heap_create(&heap, 0, 1, 1);
    heap_put_disc(&heap, 0, 0, -0.01, 9e-3);
    heap_put_wall(&heap, 0, (const double[6]){0, 0, 1, 0, 0, 1});
    heap_start(&heap);
    make_drum(&heap);
    for (int row = 0; row < ROWS; row++) {
        heap_move(&heap, 0, 1e-4 * (row % 5 - 2) * (row + 1), 0, 0);
        heap.snapshot.time = 0.1 * row;
        assert_int_equal(oz_flow_see(&flow, &heap.snapshot), OZ_OK);
        seen[row] = flow.surface;
    }
    for (int row = ROWS / 2; row < ROWS; row++) {
        sum += seen[row];
    }
    for (int row = ROWS / 2; row < ROWS; row++) {
        square += pow(seen[row] - sum / 6, 2);
    }
    assert_true(square > 1);
    /* the same sums in another order */
    assert_near(flow.mean, sum / 6, 1e-14);
    assert_near(flow.deviation, sqrt(square / 5), 1e-14);
    oz_flow_free(&flow);
    heap_free(&heap);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_grains_of_their_elements),
        cmocka_unit_test(test_walls_swing),
        cmocka_unit_test(test_slope_of_a_bed_on_one_side),
        cmocka_unit_test(test_rows_of_a_drum),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
