/* Coarse-grained fields against closed forms: what a point, a body and a contact give to cells, the
 * balance of momentum, a gas and a bed at rest. */
#include "rig.h"

#include "hand_contacts.h"

#include "base/memory.h"
#include "base/random.h"
#include "observe/coarse_columns.h"

/* Cells along z alone, `edge` high from z = 0 on. */
static OzCoarseGrid column(int64_t cells, double edge, double width)
{
    return (OzCoarseGrid){.cells = {1, 1, cells},
                          .high = {1, 1, (double)cells * edge},
                          .width = width,
                          .is_whole = {true, true, false}};
}

/* Whatever the cells' size, a point's shares add up to 1, are about it, and spread as far as Lucy's
 * polynomial and a cell together do: variance 2/21 w^2 + h^2/12, of h in the mean over places. */
static void test_shares_of_a_point(void **state)
{
    (void)state;
    OzCoarseShares shares = {0};
    static const double edges[] = {0.05, 0.5, 3};
    for (int e = 0; e < 3; e++) {
        double edge = edges[e], spread = 0;
        OzCoarseGrid grid = column(200, edge, 1);
        enum { PLACES = 64 };
        for (int p = 0; p < PLACES; p++) {
            double at = edge * (100 + (p + 0.5) / PLACES), sum = 0, first = 0;
            must(oz_coarse_grid_share(&grid, 2, at, &shares));
            for (int64_t i = 0; i < shares.count; i++) {
                double off = oz_coarse_grid_middle(&grid, 2, shares.of[i].cell) - at;
                assert_true(shares.of[i].share >= 0);
                sum += shares.of[i].share;
                first += shares.of[i].share * off;
                spread += shares.of[i].share * off * off / PLACES;
            }
            assert_near(sum, 1, 1e-14); /* a few roundings */
            assert_true(fabs(first) < 0.5 * edge);
        }
        /* twice h^2/12: of the cells, and of the places in a cell; 64 places are 1e-4 off */
        assert_near(spread, 2.0 / 21 + edge * edge / 12, 2e-3 * spread);
    }
    oz_coarse_grid_free_shares(&shares);
}

/* Where space repeats itself a path that goes on is at home, and both borders get their parts. */
static void test_shares_across_a_border(void **state)
{
    (void)state;
    OzCoarseShares shares = {0};
    OzCoarseGrid grid = {
        .cells = {8, 1, 1}, .low = {-4, 0, 0}, .high = {4, 1, 1}, .width = 3, .period = {8, 0, 0}};
    for (int turns = -2; turns <= 2; turns++) {
        double sum[8] = {0};
        must(oz_coarse_grid_share(&grid, 0, 4 + 8.0 * turns, &shares));
        for (int64_t i = 0; i < shares.count; i++) {
            sum[shares.of[i].cell] += shares.of[i].share;
        }
        /* the integral of 5/4 (1 - 6 u^2 + 8 u^3 - 3 u^4) from 0 to 1/3, 2/3 and 1 */
        static const double to[] = {0, 19.0 / 54, 79.0 / 162, 0.5};
        for (int i = 0; i < 3; i++) {
            assert_near(sum[i], to[i + 1] - to[i], 1e-14);
            assert_near(sum[7 - i], to[i + 1] - to[i], 1e-14);
        }
    }
    oz_coarse_grid_free_shares(&shares);
}

/* 1/2 and the integral of Lucy's polynomial from 0 to u. */
static double lucy_to(double u)
{
    double sum = 0, sign = u < 0 ? -1 : 1, end = fmin(fabs(u), 1);
    enum { STEPS = 200 };
    for (int i = 0; i < STEPS; i++) { /* by midpoints */
        double t = (i + 0.5) / STEPS * end;
        sum += 1.25 * (1 + 3 * t) * pow(1 - t, 3) * end / STEPS;
    }
    return 0.5 + sign * sum;
}

/* What a cell of a column gets of a sphere of diameter 1 at z, by slices. */
static double sphere_share(const OzCoarseGrid *grid, int64_t cell, double z)
{
    double edge = grid->high[2] / (double)grid->cells[2], sum = 0;
    enum { SLICES = 200 };
    for (int i = 0; i < SLICES; i++) {
        double off = (i + 0.5) / SLICES - 0.5, at = z + off;
        double area = 6 * (0.25 - off * off) / SLICES; /* over pi / 6 */
        sum += area * (lucy_to(((double)(cell + 1) * edge - at) / grid->width) -
                       lucy_to(((double)cell * edge - at) / grid->width));
    }
    return sum;
}

/* The largest error of what cells a quarter of a width high get of a sphere cut across any axis,
 * over the largest share. */
static double body_error(double width, OzRandom *random)
{
    OzCoarsePoints points = {0};
    OzCoarseShares shares = {0};
    int64_t cells = (int64_t)(4 * (1 + 2 * width) / width) + 2;
    OzCoarseGrid grid = column(cells, width / 4, width);
    double z = grid.high[2] / 2, worst = 0, most = 0, *got = NULL;
    for (int tries = 0; tries < 5; tries++) {
        double axis[3];
        must(oz_memory_new((void **)&got, (size_t)cells, sizeof *got, "shares"));
        oz_random_direction(random, axis);
        must(oz_coarse_body_fill(&points, 1, 0, axis, width));
        for (int64_t p = 0; p < points.count; p++) {
            must(oz_coarse_grid_share(&grid, 2, z + points.of[p].at[2], &shares));
            for (int64_t i = 0; i < shares.count; i++) {
                got[shares.of[i].cell] += points.of[p].share * shares.of[i].share;
            }
        }
        for (int64_t i = 0; i < cells; i++) {
            double expected = sphere_share(&grid, i, z);
            worst = fmax(worst, fabs(got[i] - expected));
            most = fmax(most, expected);
        }
        free(got);
    }
    free(points.of);
    oz_coarse_grid_free_shares(&shares);
    return worst / most;
}

static void test_volume_of_a_sphere(void **state)
{
    (void)state;
    OzRandom random = oz_random_stream(3, 0);
    static const double widths[] = {0.1, 0.15, 0.2, 0.3, 0.5, 0.7, 1, 1.5, 2};
    for (int k = 0; k < 9; k++) {
        double error = body_error(widths[k], &random); /* as coarse_body.h says */
        assert_true(error < (widths[k] < 0.5 ? 0.03 : 0.01));
    }
}

/* Sums of one moment. */
typedef struct Fields {
    OzCoarseGrid grid;
    OzCoarseSums sums;
} Fields;

static Fields fields_of(const OzSnapshot *snapshot)
{
    Fields fields = {.grid = oz_coarse_grid_make(snapshot->scene)};
    oz_coarse_grid_place(&fields.grid, snapshot);
    must(oz_coarse_sums_create(&fields.sums, &fields.grid, snapshot->count));
    must(oz_coarse_sums_fill(&fields.sums, &fields.grid, snapshot));
    return fields;
}

/* The integral of a word over all cells. */
static double whole(const Fields *fields, int word)
{
    double sum = 0;
    for (int64_t i = 0; i < fields->sums.cells; i++) {
        sum += fields->sums.cell[i * OZ_COARSE_COUNT + word];
    }
    return sum * oz_coarse_grid_volume(&fields->grid);
}

/* All that a bed of rods and spheres has is in the cells, whatever they are, also beyond walls. */
static void test_nothing_is_lost(void **state)
{
    (void)state;
    static const char *const cells[] = {"cells: [7, 9, 11], width: 1e-3",
                                        "cells: [1, 1, 40], width: 3e-4",
                                        "cells: [3, 1, 2], width: 2e-4"};
    for (int k = 0; k < 3; k++) {
        Rig rig;
        double mass = 0, volume = 0, momentum = 0, along = 0;
        rig_open(&rig,
                 "model: rods\ntime: {step: 1e-5, duration: 1}\n"
                 "contact: {contact_time: 6e-4, restitution: 0.5}\n"
                 "grains:\n  - {kind: random, count: 60, diameter: 1e-3, aspect: [1, 3], "
                 "velocity_spread: 0.3}\n"
                 "  - {kind: random, count: 30, diameter: [0.8e-3, 1.5e-3], aspect: 0}\n"
                 "walls: [{kind: cylinder, diameter: 8e-3}, {kind: plane}]\nfields: {%s}\n",
                 cells[k]);
        rig_start(&rig);
        Fields fields = fields_of(&rig.now);
        for (int64_t i = 0; i < rig.now.count; i++) {
            double shaft = rig.grains.length[i] > 0 ? rig.grains.mass[i] : 0;
            mass += rig.grains.mass[i];
            volume += rig.grains.mass[i] / 2500; /* the default density */
            momentum += rig.grains.mass[i] * rig.now.velocity[3 * i];
            along += shaft * rig.now.axis[3 * i + 1] * rig.now.axis[3 * i + 2];
        }
        /* sums of some hundred numbers */
        assert_near(whole(&fields, OZ_COARSE_MASS), mass, 1e-12 * mass);
        assert_near(whole(&fields, OZ_COARSE_VOLUME), volume, 1e-12 * volume);
        assert_near(whole(&fields, OZ_COARSE_MOMENTUM), momentum, 1e-12 * 0.3 * mass);
        assert_near(whole(&fields, OZ_COARSE_DIRECTION + 4), along, 1e-12 * mass);
        oz_coarse_sums_free(&fields.sums);
        rig_close(&rig);
    }
}

/* Kinetic stress of a gas is density times temperature, which is the square of the spread that its
 * velocities have along each direction: of 2000 grains known to sqrt(2 / 6000) = 1.8 %. */
static void test_a_gas(void **state)
{
    (void)state;
    Rig rig;
    double numbers[OZ_COARSE_NUMBERS], spread = 0.3;
    rig_open(&rig,
             "model: rods\ntime: {step: 1e-5, duration: 1}\ngravity: [0, 0, 0]\n"
             "contact: {contact_time: 6e-4, restitution: 0.5}\n"
             "boundary: {x: periodic, y: periodic, z: periodic, size: [3e-2, 3e-2, 3e-2]}\n"
             "grains: [{kind: random, count: 2000, diameter: 1e-3, velocity_spread: %g}]\n"
             "fields: {cells: [1, 1, 1], width: 1e-2}\n",
             spread);
    rig_start(&rig);
    for (int64_t i = 0; i < 3 * rig.now.count; i++) {
        rig.now.velocity[i] += 0.2; /* all of it flows */
    }
    Fields fields = fields_of(&rig.now);
    oz_coarse_columns_find(fields.sums.cell, 1, numbers);
    const double *kinetic = &numbers[OZ_COARSE_COLUMN_stress_kinetic];
    double density = 2000 * rig.grains.mass[0] / 27e-6;
    assert_near(numbers[OZ_COARSE_COLUMN_mass_density], density, 1e-12 * density);
    assert_near(numbers[OZ_COARSE_COLUMN_temperature], spread * spread,
                4 * 0.018 * spread * spread);
    for (int k = 0; k < 3; k++) { /* each of sqrt(2 / 2000); across, of 1 / sqrt(2000) */
        assert_near(kinetic[k] / density, spread * spread, 4 * 0.032 * spread * spread);
        assert_near(kinetic[3 + k] / density, 0, 4 * 0.023 * spread * spread);
    }
    assert_near(numbers[OZ_COARSE_COLUMN_pressure], density * numbers[OZ_COARSE_COLUMN_temperature],
                1e-12 * numbers[OZ_COARSE_COLUMN_pressure]);
    oz_coarse_sums_free(&fields.sums);
    rig_close(&rig);
}

/* Grains of no size, so to say, one above the other in a column: scene keys of fields. */
static void open_column(Rig *rig, int count, double spacing, const char *fields)
{
    rig_open(rig,
             "model: rods\ntime: {step: 1e-5, duration: 1}\n"
             "contact: {contact_time: 6e-4, restitution: 0.5}\n"
             "grains: [{kind: lattice, cells: [1, 1, %d], spacing: [1, 1, %g], diameter: 1e-3, "
             "position: [0, 0, %g]}]\n"
             "boundary: {x: periodic, y: periodic, size: [1e-2, 1e-2, 0]}\n"
             "walls: [{kind: plane}]\nfields: {%s}\n",
             count, spacing, spacing / 2, fields);
    rig_start(rig);
}

/* Of a shear flow velocity is what it is, and what it varies by within the smoothing function looks
 * like temperature: kinetic stress is density times the rate's square times its variance. */
static void test_a_shear_flow(void **state)
{
    (void)state;
    const double rate = 3, width = 20e-3, edge = 4e-3;
    Rig rig;
    open_column(&rig, 100, 1e-3, "cells: [1, 1, 10], width: 20e-3, z: [30e-3, 70e-3]");
    for (int64_t i = 0; i < rig.now.count; i++) {
        rig.now.velocity[3 * i] = rate * rig.now.position[3 * i + 2];
    }
    Fields fields = fields_of(&rig.now);
    double variance = 2 * width * width / 21 + edge * edge / 12;
    for (int64_t i = 0; i < 10; i++) {
        double numbers[OZ_COARSE_NUMBERS], density = rig.grains.mass[0] / 1e-7;
        oz_coarse_columns_find(&fields.sums.cell[i * OZ_COARSE_COUNT], 1, numbers);
        double flow = rate * oz_coarse_grid_middle(&fields.grid, 2, i);
        /* grains are a twentieth of the width apart, whose discreteness is below 1e-5 */
        assert_near(numbers[OZ_COARSE_COLUMN_velocity], flow, 1e-5 * flow);
        assert_near(numbers[OZ_COARSE_COLUMN_mass_density], density, 1e-5 * density);
        assert_near(numbers[OZ_COARSE_COLUMN_stress_kinetic], density * rate * rate * variance,
                    1e-3 * density * rate * rate * variance);
        assert_true(numbers[OZ_COARSE_COLUMN_stress_kinetic + 2] == 0);
    }
    oz_coarse_sums_free(&fields.sums);
    rig_close(&rig);
}

/* A contact's stress is spread along its branch: what each cell gets beside what a thousand places
 * along it give, whatever the branch is over the width; and all of it is force times branch. */
static void test_the_line_of_a_contact(void **state)
{
    (void)state;
    OzRandom random = oz_random_stream(5, 0);
    static const double widths[] = {0.15e-3, 0.3e-3, 0.5e-3, 0.6e-3, 0.8e-3, 1.2e-3};
    for (int k = 0; k < 6; k++) {
        Rig rig;
        char keys[200];
        double axis[3], worst = 0, most = 0;
        snprintf(keys, sizeof keys,
                 "cells: [20, 20, 20], width: %g, x: [-3e-3, 3e-3], y: [-3e-3, 3e-3], "
                 "z: [-3e-3, 3e-3]",
                 widths[k]);
        open_column(&rig, 1, 1e-3, keys);
        rig.now.position[2] = 0;
        oz_random_direction(&random, axis);
        OzContactEntry entry = {.a = 0, .b = -1, .push = 2, .normal = {axis[0], axis[1], axis[2]}};
        for (int c = 0; c < 3; c++) {
            entry.point[c] = 0.5e-3 * axis[c];
        }
        hand_contact(&rig.now, entry);
        Fields fields = fields_of(&rig.now), places = fields_of(&rig.now);
        memset(places.sums.cell, 0, sizeof(double) * 8000 * OZ_COARSE_COUNT);
        enum { PLACES = 1000 };
        for (int p = 0; p < PLACES; p++) {
            for (int64_t n = 0; n < 3; n++) {
                double at = (p + 0.5) / PLACES * entry.point[n];
                must(oz_coarse_grid_share(&places.grid, (int)n, at, &places.sums.shares[n]));
            }
            const OzCoarseShares *x = places.sums.shares, *y = x + 1, *z = x + 2;
            for (int64_t n = 0; n < x->count * y->count * z->count; n++) {
                OzCoarseShare a = x->of[n % x->count], b = y->of[n / x->count % y->count],
                              c = z->of[n / x->count / y->count];
                places.sums.cell[((c.cell * 20 + b.cell) * 20 + a.cell) * OZ_COARSE_COUNT] +=
                    a.share * b.share * c.share / PLACES;
            }
        }
        double volume = oz_coarse_grid_volume(&fields.grid), all = 2 * 0.5e-3 * axis[2] * axis[0];
        for (int64_t i = 0; i < fields.sums.cells; i++) {
            double expected = places.sums.cell[i * OZ_COARSE_COUNT];
            double got = fields.sums.cell[i * OZ_COARSE_COUNT + OZ_COARSE_CONTACT + 6];
            worst = fmax(worst, fabs(got * volume / all - expected));
            most = fmax(most, expected);
        }
        assert_true(worst < 1e-4 * most); /* as coarse_sums.h says */
        assert_near(whole(&fields, OZ_COARSE_CONTACT + 6), all, 1e-14 * 1e-3);
        assert_near(whole(&fields, OZ_COARSE_WALL + 1), -2 * axis[1], 1e-14);
        oz_coarse_sums_free(&fields.sums);
        oz_coarse_sums_free(&places.sums);
        rig_close(&rig);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_shares_of_a_point),
        cmocka_unit_test(test_shares_across_a_border),
        cmocka_unit_test(test_volume_of_a_sphere),
        cmocka_unit_test(test_nothing_is_lost),
        cmocka_unit_test(test_a_gas),
        cmocka_unit_test(test_a_shear_flow),
        cmocka_unit_test(test_the_line_of_a_contact),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
