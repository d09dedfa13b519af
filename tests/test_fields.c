/* fields.csv: balance in a bed at rest, contacts across a border, and what runs leave.
 * ORZO_NEEDS_DEVICE. */
#include "rig.h"

#include "hand_contacts.h"
#include "program.h"
#include "run_bed.h"

#include "observe/coarse_columns.h"

static Rig rig;
static OzCoarseGrid grid;
static OzCoarseSums sums;

static void find_fields(void)
{
    grid = oz_coarse_grid_make(&rig.scene);
    oz_coarse_grid_place(&grid, &rig.now);
    must(oz_coarse_sums_create(&sums, &grid, rig.now.count));
    must(oz_coarse_sums_fill(&sums, &grid, &rig.now));
}

static void leave_fields(void)
{
    oz_coarse_sums_free(&sums);
    rig_close(&rig);
}

static const double SIDE = 3.2e-3; /* m, of the bed's cell along x and y */

/* The stress at each height of a bed at rest bears what is above, but for what the floor bears
 * itself; across it none is borne, without walls aside. All the floor bears is the bed's weight,
 * and the sum of stresses that of weights times heights. A fabric's trace is each grain's volume
 * times its contacts. */
static void test_a_bed_at_rest(void **state)
{
    (void)state;
    enum { SLABS = 400 };
    double weight = 0, moment = 0, above = 0, floor = 0, borne = 0, fabric = 0, volume = 0;
    rig_open(&rig,
             "model: rods\nseed: 4\ntime: {step: 2e-5, duration: 9}\nintegrator: velocity-verlet\n"
             "contact: {contact_time: 6e-4, restitution: 0.1, friction: 0.4}\n"
             "grains:\n  - {kind: random, count: 20, diameter: 1e-3, aspect: 0.5, fill: 0.3}\n"
             "  - {kind: random, count: 20, diameter: [0.8e-3, 1.2e-3], fill: 0.3}\n"
             "boundary: {x: periodic, y: periodic, size: [%g, %g, 0]}\n"
             "walls: [{kind: plane}]\nfields: {cells: [1, 1, %d], width: 1e-3}\n",
             SIDE, SIDE, SLABS);
    rig_start(&rig);
    rig_advance(&rig, 20000);
    find_fields();
    double area = SIDE * SIDE, slab = oz_coarse_grid_volume(&grid);
    for (int64_t i = 0; i < rig.now.count; i++) {
        weight += 9.81 * rig.grains.mass[i];
        moment += 9.81 * rig.grains.mass[i] * rig.now.position[3 * i + 2];
    }
    for (int64_t c = 0; c < rig.now.contacts.count;
         c++) { /* the floor's, as deep as overlaps are */
        const OzContactEntry *e = &rig.now.contacts.entry[c];
        moment += e->b < 0 ? e->push * e->normal[2] * e->point[2] : 0;
        volume += rig.grains.mass[e->a] / 2500 + (e->b < 0 ? 0 : rig.grains.mass[e->b] / 2500);
    }
    for (int64_t i = SLABS - 1; i >= 0; i--) {
        double numbers[OZ_COARSE_NUMBERS];
        oz_coarse_columns_find(&sums.cell[i * OZ_COARSE_COUNT], 1, numbers);
        const double *stress = &numbers[OZ_COARSE_COLUMN_stress_contact];
        double lift = slab * numbers[OZ_COARSE_COLUMN_wall_force + 2];
        double load = slab * 9.81 * numbers[OZ_COARSE_COLUMN_mass_density] - lift;
        /* line integrals 2e-4, slabs as thick as they are 1e-4, unrest 1e-5 */
        assert_near(stress[8] * area, above + load / 2, 5e-4 * weight);
        assert_near(stress[2] * area, 0, 5e-4 * weight);
        assert_near(stress[5] * area, 0, 5e-4 * weight);
        above += load;
        floor += lift;
        borne += stress[8] * slab;
        for (int k = 0; k < 3; k++) {
            fabric += numbers[OZ_COARSE_COLUMN_fabric + k] * slab;
        }
    }
    assert_near(floor, weight, 1e-4 * weight);
    assert_near(borne, moment, 5e-5 * moment); /* unrest */
    assert_true(moment > 1.2e-3 * weight);     /* some layers */
    assert_near(fabric, volume, 1e-12 * volume);
    leave_fields();
}

/* Two that touch across a border press each other along half a diameter each, wherever their paths
 * have led; and a fabric's trace is volume times contacts. */
static void test_across_a_border(void **state)
{
    (void)state;
    for (int turns = -1; turns <= 1; turns++) {
        double stress = 0, trace = 0, border = 0, volume;
        rig_open(&rig, "model: rods\ntime: {step: 2e-5, duration: 9}\n"
                       "contact: {contact_time: 6e-4, restitution: 0.1}\n"
                       "grains: [{kind: lattice, cells: [2, 1, 1], spacing: [-7e-3, 1, 1], "
                       "diameter: 1e-3, position: [3.5e-3, 0, 0]}]\n"
                       "boundary: {x: periodic, size: [8e-3, 0, 0]}\n"
                       "fields: {cells: [16, 4, 4], width: 1e-3}\n");
        rig.grains.position[3] += 8e-3 * turns;
        rig_start(&rig);
        rig.now.contacts.count = 0;
        hand_contact(&rig.now, (OzContactEntry){.a = 0,
                                                .b = 1,
                                                .push = 3,
                                                .normal = {1, 0, 0},
                                                .tangential = {0, 2, 0},
                                                .point = {4e-3, 0, 0}});
        find_fields();
        volume = oz_coarse_grid_volume(&grid);
        for (int64_t i = 0; i < sums.cells; i++) {
            const double *cell = &sums.cell[i * OZ_COARSE_COUNT];
            stress += volume * cell[OZ_COARSE_CONTACT];
            border += i % 16 < 2 || i % 16 > 13 ? volume * cell[OZ_COARSE_CONTACT + 3] : 0;
            trace += volume * (cell[OZ_COARSE_FABRIC] + cell[OZ_COARSE_FABRIC + 1]);
        }
        assert_near(stress, 3 * 1e-3, 1e-15);
        assert_true(border > 0.5 * 2 * 1e-3 && border <= 2 * 1e-3);
        assert_near(trace, 2 * 0.523598775598e-9, 1e-18);
        leave_fields();
    }
}

/* Numbers of a table by column and row, from 0; NAN of an empty cell. */
typedef struct Table {
    char *text;
    double *cell;
    int columns, rows;
} Table;

static Table read_table(const char *name)
{
    Table table = {.text = read_file(name, NULL), .columns = 1};
    const char *c = table.text;
    for (; *c != '\n'; c++) {
        table.columns += *c == ',';
    }
    table.rows = count_lines(name) - 1;
    table.cell = calloc((unsigned)(table.rows * table.columns) + 1U, sizeof(double));
    for (int n = 0; n < table.rows * table.columns; n++) {
        char *end;
        c++;
        table.cell[n] = strtod(c, &end);
        table.cell[n] = end == c ? NAN : table.cell[n];
        c += strcspn(c, ",\n");
    }
    return table;
}

static double at(const Table *table, int row, const char *column)
{
    char names[4096];
    int k = 0;
    snprintf(names, sizeof names, "%s", line_of(table->text, 0));
    for (char *name = strtok(names, ","); name; name = strtok(NULL, ","), k++) {
        if (strcmp(name, column) == 0) {
            return table->cell[row * table->columns + k];
        }
    }
    fail_msg("no column %s", column);
    return 0;
}

static void free_table(Table *table)
{
    free(table->text);
    free(table->cell);
}

enum { CELLS = 4 * 4 * 6, MOMENTS = 5 };

static const char asked[] = "--set 'fields={cells: [4, 4, 6], width: 1e-3, vtk: true}'";

/* All cells of all moments, with the mass of all grains, and the force of all walls as in the
 * series. */
static void check_moments(const Table *fields, const Table *series, double mass)
{
    assert_int_equal(fields->rows, MOMENTS * CELLS);
    double dx = at(fields, 1, "x") - at(fields, 0, "x"),
           dy = at(fields, 4, "y") - at(fields, 0, "y"),
           dz = at(fields, 16, "z") - at(fields, 0, "z");
    for (int moment = 0; moment < MOMENTS; moment++) {
        double sum = 0, lift = 0, from = 0;
        from = at(series, moment, "wall0_fz") + at(series, moment, "wall1_fz");
        for (int i = moment * CELLS; i < (moment + 1) * CELLS; i++) {
            assert_true(at(fields, i, "time") == at(series, moment, "time"));
            sum += dx * dy * dz * at(fields, i, "mass_density");
            lift += dx * dy * dz * at(fields, i, "wall_force_z");
        }
        assert_near(sum, mass, 1e-7 * mass); /* nine digits */
        assert_near(lift, -from, 1e-7 * fabs(from) + 1e-15);
    }
}

/* Densities are means, velocities are means by mass. */
static void check_mean(const Table *fields, const Table *mean)
{
    assert_int_equal(mean->rows, CELLS);
    for (int i = 0; i < CELLS; i++) {
        double density = 0, momentum = 0, pressed = 0;
        for (int row = i; row < MOMENTS * CELLS; row += CELLS) {
            double own = at(fields, row, "mass_density") / MOMENTS;
            density += own;
            momentum += own > 0 ? own * at(fields, row, "velocity_z") : 0;
            pressed += at(fields, row, "stress_contact_zz") / MOMENTS;
        }
        assert_near(at(mean, i, "mass_density"), density, 1e-7 * density);
        assert_near(at(mean, i, "stress_contact_zz"), pressed, 1e-7 * fabs(pressed) + 1e-9);
        if (density > 0) {
            assert_near(at(mean, i, "velocity_z"), momentum / density, 1e-7);
        } else {
            assert_true(isnan(at(mean, i, "velocity_z")));
        }
    }
}

static void test_what_a_run_leaves(void **state)
{
    (void)state;
    double mass = 0;
    char arguments[300];
    snprintf(arguments, sizeof arguments, "run bed.yaml -o whole %s --set observe.walls=instant",
             asked);
    expect(0, "30 grains", arguments);
    Table fields = read_table("whole/fields.csv"), mean = read_table("whole/fields_mean.csv"),
          series = read_table("whole/series.csv"), grains = read_table("whole/final.csv");
    for (int i = 0; i < grains.rows; i++) {
        mass += at(&grains, i, "mass");
    }
    check_moments(&fields, &series, mass);
    check_mean(&fields, &mean);
    assert_true(contains("whole/fields/fields_00004.vti", "WholeExtent=\"0 4 0 4 0 6\""));
    assert_true(contains("whole/fields/fields.pvd", "file=\"fields_00004.vti\"/>\n</Collection>"));
    assert_true(is_there("whole/fields/fields_mean.vti"));
    assert_false(is_there("whole/fields/fields_00005.vti"));
    free_table(&fields);
    free_table(&mean);
    free_table(&series);
    free_table(&grains);
    expect(0, "30 grains", "run bed.yaml -o whole --overwrite --until 0");
    assert_false(is_there("whole/fields.csv") || is_there("whole/fields_mean.csv") ||
                 is_there("whole/fields"));
}

/* The same bytes from two threads, and after a stop. */
static void test_the_same_bytes(void **state)
{
    (void)state;
    static const char *const names[] = {"fields.csv",
                                        "fields_mean.csv",
                                        "fields/fields.pvd",
                                        "fields/fields_00001.vti",
                                        "fields/fields_00003.vti",
                                        "fields/fields_mean.vti"};
    char arguments[300], one[64], other[64];
    snprintf(arguments, sizeof arguments, "run bed.yaml -o one --device cpu --threads 1 %s", asked);
    expect(0, "30 grains", arguments);
    snprintf(arguments, sizeof arguments,
             "run bed.yaml -o left --device cpu --threads 2 %s --until 0.0213", asked);
    expect(0, "30 grains", arguments);
    assert_int_equal(count_lines("left/fields.csv"), 1 + 4 * CELLS);
    expect(0, "left goes on", "resume left --until 0.04");
    for (int k = 0; k < 6; k++) {
        snprintf(one, sizeof one, "one/%s", names[k]);
        snprintf(other, sizeof other, "left/%s", names[k]);
        if (!same_files(one, other)) {
            fail_msg("%s is another", other);
        }
    }
}

/* Moments of their own, a mean that begins later, and members with files of their own. */
static void test_moments(void **state)
{
    (void)state;
    expect(0, "",
           "run bed.yaml -o own --seeds 1..2 --no-video "
           "--set 'fields={cells: [1, 1, 3], width: 1e-3, interval: 0.015, mean_from: 0.03}'");
    Table fields = read_table("own/seed_00002/fields.csv"),
          mean = read_table("own/seed_00002/fields_mean.csv");
    assert_int_equal(fields.rows, 3 * 3);
    assert_int_equal(mean.rows, 3);
    for (int i = 0; i < 9; i++) {
        assert_true(at(&fields, i, "step") == 750 * (i / 3));
        assert_near(at(&fields, i, "x"), 0, 1e-9);
    }
    for (int i = 0; i < 3; i++) {
        assert_true(at(&mean, i, "mass_density") == at(&fields, 6 + i, "mass_density"));
    }
    assert_false(is_there("own/seed_00001/fields"));
    free_table(&fields);
    free_table(&mean);
}

static int make_bed(void **state)
{
    if (enter_work(state) != 0) {
        return -1;
    }
    write_file("bed.yaml", "%s", bed);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_bed_at_rest),     cmocka_unit_test(test_across_a_border),
        cmocka_unit_test(test_what_a_run_leaves), cmocka_unit_test(test_the_same_bytes),
        cmocka_unit_test(test_moments),
    };
    return cmocka_run_group_tests(tests, make_bed, leave_work);
}
