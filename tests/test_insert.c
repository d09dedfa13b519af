/* Grains at the start: placed at random, in a lattice, alone and from a file. */
#include "brute.h"

#include "model/insert.h"
#include "model/restart_csv.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static const double pi = 3.14159265358979323846;

/* The container of Pournin et al. 2005: a floor and a tube 8 mm wide. */
static OzWall paper_walls[2] = {
    {.kind = OZ_WALL_PLANE, .normal = {0, 0, 1}},
    {.kind = OZ_WALL_CYLINDER, .diameter = 8e-3},
};

static OzPopulation random_rods(int64_t count)
{
    return (OzPopulation){.kind = OZ_GRAINS_RANDOM,
                          .count = count,
                          .diameter = {0.523e-3, 0.523e-3},
                          .aspect = {4, 4},
                          .density = 2500,
                          .fill = 0.15,
                          .line = 12};
}

static OzScene make_scene(OzPopulation *populations, int population_count, OzWall *walls,
                          int wall_count)
{
    return (OzScene){.path = "made.yaml",
                     .seed = 7,
                     .populations = populations,
                     .population_count = population_count,
                     .walls = walls,
                     .wall_count = wall_count};
}

static OzCapsule capsule_of(const OzGrains *grains, int64_t i)
{
    OzCapsule capsule = {.radius = 0.5 * grains->diameter[i]};
    double axis[3];
    oz_grains_axis(&grains->quaternion[4 * i], axis);
    for (int k = 0; k < 3; k++) {
        capsule.centre[k] = grains->position[3 * i + k];
        capsule.half_shaft[k] = 0.5 * grains->length[i] * axis[k];
    }
    return capsule;
}

static bool far_apart(const OzCapsule *a, const OzCapsule *b)
{
    double between2 = 0, a2 = 0, b2 = 0;
    for (int k = 0; k < 3; k++) {
        between2 += pow(a->centre[k] - b->centre[k], 2);
        a2 += pow(a->half_shaft[k], 2);
        b2 += pow(b->half_shaft[k], 2);
    }
    return sqrt(between2) > sqrt(a2) + sqrt(b2) + a->radius + b->radius;
}

static void assert_no_overlaps(const OzGrains *grains)
{
    for (int64_t i = 0; i < grains->count; i++) {
        OzCapsule a = capsule_of(grains, i);
        for (int64_t j = i + 1; j < grains->count; j++) {
            OzCapsule b = capsule_of(grains, j);
            /* The axis went through a quaternion: rounding, 1e-12 of a radius, is no overlap. */
            double contact = (a.radius + b.radius) * (1 - 1e-12);
            if (!far_apart(&a, &b) && brute_distance(&a, &b) < contact) {
                fail_msg("grains %lld and %lld overlap", (long long)i, (long long)j);
            }
        }
    }
}

static void assert_inside_paper_walls(const OzGrains *grains)
{
    for (int64_t i = 0; i < grains->count; i++) {
        OzCapsule c = capsule_of(grains, i);
        for (int sign = -1; sign <= 1; sign += 2) {
            double x = c.centre[0] + sign * c.half_shaft[0];
            double y = c.centre[1] + sign * c.half_shaft[1];
            double z = c.centre[2] + sign * c.half_shaft[2];
            /* inside, but for rounding */
            assert_true(hypot(x, y) + c.radius <= 4e-3 * (1 + 1e-12));
            assert_true(z - c.radius >= -1e-15);
        }
    }
}

static void assert_directions_uniform(const OzGrains *grains)
{
    double angle_sum = 0, squares[3] = {0};
    double count = (double)grains->count;
    for (int64_t i = 0; i < grains->count; i++) {
        double axis[3];
        oz_grains_axis(&grains->quaternion[4 * i], axis);
        angle_sum += asin(fabs(axis[2]));
        for (int k = 0; k < 3; k++) {
            squares[k] += axis[k] * axis[k];
        }
    }
    /* Uniform on the sphere: |sin(angle)| is uniform, so the angle has mean pi/2 - 1 (32.7 degrees)
     * and variance pi - 3; a squared component has mean 1/3 and variance 4/45. Three errors. */
    assert_true(fabs(angle_sum / count - (pi / 2 - 1)) < 3 * sqrt((pi - 3) / count));
    for (int k = 0; k < 3; k++) {
        assert_true(fabs(squares[k] / count - 1.0 / 3) < 3 * sqrt(4.0 / 45 / count));
    }
}

static void test_random_bed(void **state)
{
    (void)state;
    OzPopulation rods = random_rods(1000);
    OzScene scene = make_scene(&rods, 1, paper_walls, 2);
    OzGrains grains;
    assert_int_equal(oz_insert_grains(&grains, &scene), OZ_OK);
    assert_int_equal(grains.count, 1000);
    assert_no_overlaps(&grains);
    assert_inside_paper_walls(&grains);
    assert_directions_uniform(&grains);
    double column = 1000 * oz_grains_volume(0.523e-3, 4 * 0.523e-3) / 0.15 / (pi * 16e-6);
    double highest = 0;
    for (int64_t i = 0; i < grains.count; i++) {
        highest = fmax(highest, grains.position[3 * i + 2]);
    }
    /* of 1000 even heights the highest is some thousandths below the top, and half a rod below
     * that */
    assert_true(highest < column && highest > 0.95 * column);
    oz_grains_free(&grains);
}

/* Many rods, so that three standard errors are half a degree. */
static void test_directions_of_many(void **state)
{
    (void)state;
    OzWall walls[2] = {paper_walls[0], {.kind = OZ_WALL_CYLINDER, .diameter = 40e-3}};
    OzPopulation rods = random_rods(20000);
    rods.fill = 0.1;
    OzScene scene = make_scene(&rods, 1, walls, 2);
    OzGrains grains;
    assert_int_equal(oz_insert_grains(&grains, &scene), OZ_OK);
    assert_directions_uniform(&grains);
    oz_grains_free(&grains);
}

/* A wedge of two slanted planes. */
static void test_slanted_walls(void **state)
{
    (void)state;
    OzWall wedge[2] = {{.kind = OZ_WALL_PLANE, .normal = {sqrt(0.5), 0, sqrt(0.5)}},
                       {.kind = OZ_WALL_PLANE, .normal = {-sqrt(0.5), 0, sqrt(0.5)}}};
    OzPopulation rods = random_rods(200);
    OzScene scene = make_scene(&rods, 1, wedge, 2);
    OzGrains grains;
    assert_int_equal(oz_insert_grains(&grains, &scene), OZ_OK);
    assert_no_overlaps(&grains);
    for (int64_t i = 0; i < 200; i++) {
        OzCapsule c = capsule_of(&grains, i);
        for (int sign = -1; sign <= 1; sign += 2) {
            double x = c.centre[0] + sign * c.half_shaft[0];
            double z = c.centre[2] + sign * c.half_shaft[2];
            /* outside, but for rounding */
            assert_true((z - fabs(x)) * sqrt(0.5) >= c.radius * (1 - 1e-12));
        }
    }
    oz_grains_free(&grains);
}

static void test_same_seed_same_grains(void **state)
{
    (void)state;
    OzPopulation both[2] = {random_rods(200), random_rods(50)};
    both[0].diameter.high = 0.6e-3;
    OzScene scene = make_scene(both, 1, paper_walls, 2);
    OzGrains first, again, mixed, other;
    assert_int_equal(oz_insert_grains(&first, &scene), OZ_OK);
    assert_int_equal(oz_insert_grains(&again, &scene), OZ_OK);
    scene.population_count = 2;
    assert_int_equal(oz_insert_grains(&mixed, &scene), OZ_OK);
    scene.seed++;
    assert_int_equal(oz_insert_grains(&other, &scene), OZ_OK);
    assert_memory_equal(first.position, again.position, 600 * sizeof(double));
    assert_memory_equal(first.quaternion, again.quaternion, 800 * sizeof(double));
    assert_memory_equal(first.diameter, mixed.diameter, 200 * sizeof(double));
    assert_memory_equal(first.quaternion, mixed.quaternion, 800 * sizeof(double));
    assert_memory_not_equal(first.position, other.position, 600 * sizeof(double));
    oz_grains_free(&first);
    oz_grains_free(&again);
    oz_grains_free(&mixed);
    oz_grains_free(&other);
}

/* Mean within three standard errors of the middle; ends within the range and nearly reached. */
static void assert_spread(const double *values, int64_t count, double low, double high)
{
    double sum = 0, least = INFINITY, most = -INFINITY;
    for (int64_t i = 0; i < count; i++) {
        sum += values[i];
        least = fmin(least, values[i]);
        most = fmax(most, values[i]);
    }
    /* three standard errors of a mean; none of 1000 in the outer 2 %: odds of 2e-9 */
    double error = (high - low) / sqrt(12.0 * (double)count);
    assert_true(fabs(sum / (double)count - 0.5 * (low + high)) < 3 * error);
    assert_true(least >= low && least < low + 0.02 * (high - low));
    assert_true(most < high && most > high - 0.02 * (high - low));
}

static void test_spread(void **state)
{
    (void)state;
    OzPopulation rods = random_rods(1000);
    double aspects[1000], correlation = 0;
    rods.diameter = (OzRange){0.2e-3, 0.8e-3};
    rods.aspect = (OzRange){0, 6};
    OzScene scene = make_scene(&rods, 1, paper_walls, 2);
    OzGrains grains;
    assert_int_equal(oz_insert_grains(&grains, &scene), OZ_OK);
    for (int i = 0; i < 1000; i++) {
        aspects[i] = grains.length[i] / grains.diameter[i];
        double mass = 2500 * oz_grains_volume(grains.diameter[i], grains.length[i]);
        /* the same product */
        assert_true(fabs(grains.mass[i] / mass - 1) < 1e-15);
        double axis[3];
        oz_grains_axis(&grains.quaternion[4 * i], axis);
        correlation += (grains.diameter[i] - 0.5e-3) / 0.3e-3 * axis[2] * 3 / 1000;
    }
    /* Size and direction have nothing to do with each other: three standard errors. */
    assert_true(fabs(correlation) < 3 / sqrt(1000));
    assert_spread(grains.diameter, 1000, 0.2e-3, 0.8e-3);
    assert_spread(aspects, 1000, 0, 6);
    assert_no_overlaps(&grains);
    assert_inside_paper_walls(&grains);
    oz_grains_free(&grains);
}

/* Spheres, needles and a grain that was told its place, in open space. */
static void test_mixture_in_open_space(void **state)
{
    (void)state;
    OzPopulation mixture[3] = {random_rods(300), random_rods(20), {.kind = OZ_GRAINS_SINGLE}};
    mixture[0].aspect = (OzRange){0, 0};
    mixture[1].diameter = (OzRange){0.1e-3, 0.1e-3};
    mixture[1].aspect = (OzRange){50, 50};
    mixture[2] = (OzPopulation){.kind = OZ_GRAINS_SINGLE,
                                .count = 1,
                                .diameter = {4e-3, 4e-3},
                                .density = 1000,
                                .axis = {0, 0, 1},
                                .angular_velocity = {1, 2, 3}};
    OzScene scene = make_scene(mixture, 3, NULL, 0);
    OzGrains grains;
    assert_int_equal(oz_insert_grains(&grains, &scene), OZ_OK);
    assert_int_equal(grains.count, 321);
    assert_int_equal(grains.population[320], 2);
    assert_true(grains.angular_velocity[3 * 320 + 2] == 3 && grains.position[3 * 320] == 0);
    assert_no_overlaps(&grains);
    oz_grains_free(&grains);
}

/* Denser than random grains can be: the column grows instead. */
static void test_open_column_grows(void **state)
{
    (void)state;
    OzPopulation rods = random_rods(300);
    rods.fill = 0.7;
    OzScene scene = make_scene(&rods, 1, paper_walls, 2);
    OzGrains grains;
    assert_int_equal(oz_insert_grains(&grains, &scene), OZ_OK);
    assert_no_overlaps(&grains);
    assert_inside_paper_walls(&grains);
    oz_grains_free(&grains);
}

static void assert_refused(OzScene *scene, const char *reason)
{
    OzGrains grains;
    assert_int_equal(oz_insert_grains(&grains, scene), OZ_ERR_INPUT);
    assert_non_null(strstr(oz_status_text(), "made.yaml:12: "));
    assert_non_null(strstr(oz_status_text(), reason));
    assert_null(grains.position);
}

static void test_what_cannot_fit_is_refused(void **state)
{
    (void)state;
    OzWall closed[3] = {paper_walls[0],
                        paper_walls[1],
                        {.kind = OZ_WALL_PLANE, .point = {0, 0, 5e-3}, .normal = {0, 0, -1}}};
    OzPopulation rods = random_rods(400);
    OzScene scene = make_scene(&rods, 1, closed, 3);
    assert_refused(&scene, "found a place");
    rods.diameter = (OzRange){8.1e-3, 8.1e-3};
    assert_refused(&scene, "fits nowhere");
    rods = random_rods(INT32_MAX);
    rods.count++;
    assert_refused(&scene, "too many grains");
    rods = (OzPopulation){.kind = OZ_GRAINS_FILE, .count = -1, .path = "no/such.csv", .line = 12};
    assert_refused(&scene, "no/such.csv");
}

/* Rods half as long again as the tube is wide stand in it, never across. */
static void test_long_rods_in_a_tube(void **state)
{
    (void)state;
    OzPopulation rods = random_rods(20);
    rods.aspect = (OzRange){23, 23};
    OzScene scene = make_scene(&rods, 1, paper_walls, 2);
    OzGrains grains;
    assert_int_equal(oz_insert_grains(&grains, &scene), OZ_OK);
    assert_no_overlaps(&grains);
    assert_inside_paper_walls(&grains);
    oz_grains_free(&grains);
}

static void test_lattice(void **state)
{
    (void)state;
    OzPopulation lattice = {.kind = OZ_GRAINS_LATTICE,
                            .count = 24,
                            .cells = {2, 3, 4},
                            .spacing = {1, 2, 3},
                            .position = {10, 20, 30},
                            .axis = {1, 0, 0},
                            .velocity = {0, 0, -1},
                            .diameter = {0.5, 0.5},
                            .aspect = {2, 2},
                            .density = 1};
    OzScene scene = make_scene(&lattice, 1, NULL, 0);
    OzGrains grains;
    double axis[3];
    assert_int_equal(oz_insert_grains(&grains, &scene), OZ_OK);
    const double *last = &grains.position[3 * 23];
    assert_true(last[0] == 11 && last[1] == 24 && last[2] == 39);
    assert_true(grains.position[3] == 11 && grains.position[4] == 20);
    assert_true(grains.length[23] == 1 && grains.velocity[3 * 23 + 2] == -1);
    oz_grains_axis(&grains.quaternion[4 * 23], axis);
    /* rounding of a unit vector */
    assert_true(fabs(axis[0] - 1) < 1e-15);
    oz_grains_free(&grains);
}

static void write_values(FILE *file, const double *values, int count)
{
    for (int k = 0; k < count; k++) {
        fprintf(file, ",%.17g", values[k]);
    }
}

static void write_bed(const OzGrains *grains, const char *path)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "%s\n", OZ_RESTART_CSV_HEADER);
    for (int64_t i = 0; i < grains->count; i++) {
        double axis[3];
        oz_grains_axis(&grains->quaternion[4 * i], axis);
        fprintf(file, "%lld", (long long)i);
        write_values(file, &grains->position[3 * i], 3);
        write_values(file, &grains->quaternion[4 * i], 4);
        write_values(file, axis, 3);
        write_values(file, &grains->velocity[3 * i], 3);
        write_values(file, &grains->angular_velocity[3 * i], 3);
        write_values(file, &grains->diameter[i], 1);
        write_values(file, &grains->length[i], 1);
        write_values(file, &grains->mass[i], 1);
        fprintf(file, "\n");
    }
    assert_int_equal(fclose(file), 0);
}

/* A bed from a file keeps its bits; random grains listed before it are placed around it. */
static void test_bed_from_a_file(void **state)
{
    (void)state;
    char path[] = "/tmp/orzo_test_bed_XXXXXX";
    close(mkstemp(path));
    OzPopulation rods = random_rods(50);
    OzScene scene = make_scene(&rods, 1, paper_walls, 2);
    OzGrains bed, both;
    assert_int_equal(oz_insert_grains(&bed, &scene), OZ_OK);
    write_bed(&bed, path);
    OzPopulation populations[2] = {random_rods(100),
                                   {.kind = OZ_GRAINS_FILE, .count = -1, .path = path}};
    scene = make_scene(populations, 2, paper_walls, 2);
    scene.seed = 8;
    assert_int_equal(oz_insert_grains(&both, &scene), OZ_OK);
    assert_int_equal(both.count, 150);
    assert_int_equal(both.population[100], 1);
    assert_memory_equal(&both.position[300], bed.position, 150 * sizeof(double));
    assert_memory_equal(&both.quaternion[400], bed.quaternion, 200 * sizeof(double));
    assert_memory_equal(&both.mass[100], bed.mass, 50 * sizeof(double));
    assert_no_overlaps(&both);
    assert_inside_paper_walls(&both);
    oz_grains_free(&bed);
    oz_grains_free(&both);
    unlink(path);
}

static void test_no_grains(void **state)
{
    (void)state;
    OzScene scene = make_scene(NULL, 0, paper_walls, 2);
    OzGrains grains;
    assert_int_equal(oz_insert_grains(&grains, &scene), OZ_OK);
    assert_int_equal(grains.count, 0);
    oz_grains_free(&grains);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_random_bed),
        cmocka_unit_test(test_directions_of_many),
        cmocka_unit_test(test_slanted_walls),
        cmocka_unit_test(test_same_seed_same_grains),
        cmocka_unit_test(test_spread),
        cmocka_unit_test(test_mixture_in_open_space),
        cmocka_unit_test(test_open_column_grows),
        cmocka_unit_test(test_what_cannot_fit_is_refused),
        cmocka_unit_test(test_long_rods_in_a_tube),
        cmocka_unit_test(test_lattice),
        cmocka_unit_test(test_bed_from_a_file),
        cmocka_unit_test(test_no_grains),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
