/* Elements' forces and the reference that steps them: lists against all pairs, momentum, walls that
 * move and go, the ledger, substeps, and what each guard says. */
#include "element_rig.h"

#include "base/random.h"
#include "model/insert.h"
#include "sim/element_forces.h"

static const double rest[2] = {0, 0};
static const double pi = 3.14159265358979323846;

/* Dice at random places, overlapping and not. */
static void scatter(ElementRig *rig, int count, double width)
{
    OzRandom random = oz_random_stream(3, 1);
    rig_grains(rig, count, 4, 4);
    for (int g = 0; g < count; g++) {
        double centre[2], velocity[2];
        for (int k = 0; k < 2; k++) {
            centre[k] = oz_random_uniform(&random, 0, width);
            velocity[k] = oz_random_uniform(&random, -0.1, 0.1);
        }
        double edge = oz_random_uniform(&random, 1e-3, 2e-3);
        rig_square(rig, g, edge, centre, oz_random_uniform(&random, 0, 6), velocity, 4);
    }
}

static int64_t index_of(const OzElementPairs *pairs, int a, int b)
{
    for (int64_t p = 0; p < pairs->count; p++) {
        if (pairs->pair[p].a == a && pairs->pair[p].b == b) {
            return p;
        }
    }
    return -1;
}

/* Every pair whose circles meet is listed, also after moves of less than half the skin. */
static void test_pairs(void **state)
{
    (void)state;
    ElementRig rig;
    OzElementPairs pairs = {0};
    rig_read(&rig, "time: {step: 1e-6, duration: 1}");
    scatter(&rig, 30, 8e-3);
    OzElements *p = rig.grains.elements;
    must(oz_element_pairs_renew(&pairs, p, p->position));
    int64_t listed = pairs.count;
    for (int64_t i = 0; i < p->count; i++) {
        p->position[2 * i] += 0.49 * pairs.skin * (i % 2 ? 1 : -1);
    }
    must(oz_element_pairs_renew(&pairs, p, p->position));
    assert_int_equal(pairs.count, listed);
    for (int a = 0; a < p->count; a++) {
        for (int b = a + 1; b < p->count; b++) {
            double apart = hypot(p->position[2 * a] - p->position[2 * b],
                                 p->position[2 * a + 1] - p->position[2 * b + 1]);
            bool meets = apart < p->reach[a] + p->reach[b] && p->body[a] != p->body[b];
            assert_true(!meets || index_of(&pairs, a, b) >= 0);
        }
    }
    assert_true(listed < p->count * p->count / 8);
    p->position[0] += pairs.skin;
    must(oz_element_pairs_renew(&pairs, p, p->position));
    assert_true(pairs.position[0] == p->position[0]);
    oz_element_pairs_free(&pairs);
    rig_close(&rig);
}

/* No wall, no gravity: all forces sum to nothing, and with balanced damping all torques too. */
static void test_sums(void **state)
{
    (void)state;
    ElementRig rig;
    OzElementForces forces;
    OzContactList list = {0};
    rig_read(&rig, "gravity: [0, 0]\ntime: {step: 1e-6, duration: 1}\n"
                   "beams: {damping_shear: balanced}");
    scatter(&rig, 30, 8e-3);
    OzElements *p = rig.grains.elements;
    for (int64_t i = 0; i < p->count; i++) {
        p->position[2 * i] += 1e-5 * cos(7.0 * (double)i);
    }
    OzElementState now = {p->position, p->angle, p->velocity, p->angular_velocity, 0, false};
    must(oz_element_forces_create(&forces, &rig.scene, &rig.grains));
    forces.list = &list;
    must(oz_element_forces_evaluate(&forces, &now));
    oz_contact_list_sort(&list);
    double sum[3] = {0}, size = 0;
    for (int64_t i = 0; i < p->count; i++) {
        const double *f = &forces.force[2 * i], *x = &p->position[2 * i];
        sum[0] += f[0];
        sum[1] += f[1];
        sum[2] += x[0] * f[1] - x[1] * f[0] + forces.torque[i];
        size += hypot(f[0], f[1]);
    }
    OzContactSums sums = oz_contact_list_sum(&list);
    assert_true(sums.pairs > 10 && sums.kinds[OZ_CONTACT_I] > 10);
    /* a hundred forces, each exact to 1e-16 of itself, of random signs, at some millimetres */
    assert_true(hypot(sum[0], sum[1]) < 1e-15 * size);
    assert_true(fabs(sum[2]) < 1e-18 * size);
    oz_element_forces_free(&forces);
    oz_contact_list_free(&list);
    rig_close(&rig);
}

/* What a list says acts on every element, about its centre: 3 x free_count, N and N m. */
static void add_up(const OzContactList *list, const OzElements *p, const double *position,
                   double *load)
{
    memset(load, 0, 3 * (size_t)p->free_count * sizeof *load);
    for (int64_t i = 0; i < list->count; i++) {
        const OzContactEntry *e = &list->entry[i];
        for (int side = 0; side < (e->b < 0 ? 1 : 2); side++) {
            int64_t part = side ? e->part_b : e->part_a;
            double on[2], arm[2];
            for (int k = 0; k < 2; k++) {
                on[k] = (side ? 1 : -1) * (e->push * e->normal[k] + e->tangential[k]);
                arm[k] = e->point[k] - position[2 * part + k];
                load[3 * part + k] += on[k];
            }
            load[3 * part + 2] += arm[0] * on[1] - arm[1] * on[0];
        }
    }
}

/* Contacts as data are what the elements feel, with either point of attack. */
static void test_lists_hold_all_forces(void **state)
{
    (void)state;
    for (int midpoint = 0; midpoint < 2; midpoint++) {
        ElementRig rig;
        OzElementForces forces;
        OzContactList list = {0};
        double load[3 * 4 * 30];
        rig_read(&rig, "time: {step: 1e-6, duration: 1}\ntriangles: {force_point: %s}",
                 midpoint ? "midpoint" : "centroid");
        scatter(&rig, 30, 8e-3);
        const OzElements *p = rig.grains.elements;
        OzElementState now = {p->position, p->angle, p->velocity, p->angular_velocity, 0, false};
        must(oz_element_forces_create(&forces, &rig.scene, &rig.grains));
        forces.list = &list;
        must(oz_element_forces_touch(&forces, &now));
        add_up(&list, p, p->position, load);
        double size = 0, worst = 0, worst_torque = 0;
        for (int64_t i = 0; i < p->free_count; i++) {
            size = fmax(size, hypot(forces.force[2 * i], forces.force[2 * i + 1]));
            worst = fmax(worst, hypot(load[3 * i] - forces.force[2 * i],
                                      load[3 * i + 1] - forces.force[2 * i + 1]));
            worst_torque = fmax(worst_torque, fabs(load[3 * i + 2] - forces.torque[i]));
        }
        assert_true(list.count > 30 && size > 0);
        /* rounding: of forces, and of places of 8 mm from which arms are differences */
        assert_true(worst < 1e-14 * size);
        assert_true(worst_torque < 1e-16 * size);
        oz_element_forces_free(&forces);
        oz_contact_list_free(&list);
        rig_close(&rig);
    }
}

static const char mixed_heap[] =
    "model: trigrains\nseed: 4\nintegrator: velocity-verlet\ntime: {step: 2e-6, duration: 1}\n"
    "contact: {law: hertz, hertz_stiffness: 1e6, normal_damping_rate: 0,"
    " tangential_damping_rate: 0}\n"
    "grains:\n  - {kind: random, count: 8, shape: polygon, corners: [4, 7], radius: 1e-3}\n"
    "  - {kind: random, count: 4, shape: disc, radius: 1e-3}\n"
    "walls: [{kind: vessel, width: 10e-3, height: 20e-3, thickness: 4e-3}]\n";

/* Contact forces on every grain, 2 x count. */
static void push_grains(const OzSnapshot *s, double *force)
{
    const OzElements *p = s->grains->elements;
    double load[3 * 128];
    assert_true(p->free_count <= 128);
    add_up(&s->contacts, p, s->element_position, load);
    memset(force, 0, 2 * (size_t)s->count * sizeof *force);
    for (int64_t i = 0; i < p->free_count; i++) {
        force[2 * p->body[i]] += load[3 * i];
        force[2 * p->body[i] + 1] += load[3 * i + 1];
    }
}

/* Newton's second law over a heap of polygons and discs without damping, by velocity-verlet, whose
 * step takes half the forces at its start and half of those at its end. */
static void test_contacts_move_grains(void **state)
{
    (void)state;
    enum { COUNT = 12, FIRST = 20000, STEPS = 200 };
    ElementRig rig = {0};
    double before[2 * COUNT], now[2 * COUNT], velocity[3 * COUNT], worst = 0, size = 0;
    must(oz_scene_parse(&rig.scene, "rig.yaml", mixed_heap, NULL, 0));
    must(oz_insert_grains(&rig.grains, &rig.scene));
    rig_start(&rig);
    rig_advance(&rig, FIRST);
    push_grains(&rig.now, before);
    for (int64_t step = FIRST + 1; step <= FIRST + STEPS; step++) {
        memcpy(velocity, rig.now.velocity, sizeof velocity);
        rig_advance(&rig, step);
        push_grains(&rig.now, now);
        for (int64_t i = 0; i < 2 * COUNT; i++) {
            int64_t at = 3 * (i / 2) + i % 2;
            double gained = (rig.now.velocity[at] - velocity[at]) / rig.scene.step;
            double felt = rig.grains.mass[i / 2] * (gained - rig.scene.gravity[i % 2]);
            worst = fmax(worst, fabs(felt - 0.5 * (before[i] + now[i])));
            size = fmax(size, fabs(now[i]));
        }
        memcpy(before, now, sizeof before);
    }
    OzContactSums sums = oz_contact_list_sum(&rig.now.contacts);
    assert_true(sums.kinds[OZ_CONTACT_I] > 3 && sums.kinds[OZ_CONTACT_DISC] > 0);
    /* rounding of a velocity of 0.1 m/s, over a step and times 1e-5 kg: 1e-16 N of 0.02 */
    assert_true(worst < 1e-12 * size);
    rig_close(&rig);
}

/* A corner, which two triangles share, in an edge of another die: two contacts, one pair of grains.
 */
static void test_counts(void **state)
{
    (void)state;
    ElementRig rig;
    rig_read(&rig, "gravity: [0, 0]\ntime: {step: 1e-6, duration: 1}");
    rig_grains(&rig, 3, 4, 4);
    rig_square(&rig, 0, 2e-3, rest, 0, rest, 4);
    rig_square(&rig, 1, 2e-3, (double[2]){2.4e-3, 0.1e-3}, pi / 4, rest, 4);
    rig_square(&rig, 2, 2e-3, (double[2]){-2.4e-3, 0.1e-3}, pi / 4, rest, 4);
    rig_start(&rig);
    OzContactSums sums = oz_contact_list_sum(&rig.now.contacts);
    assert_int_equal(sums.kinds[OZ_CONTACT_I], 4);
    assert_int_equal(sums.pairs, 2);
    assert_int_equal(sums.walls, 0);
    /* sqrt 2 mm from centre to corner: a right-angled corner of height h has the area h^2 */
    /* its 14 digits leave 3e-12 of h */
    double h = 2.4142135623731e-3 - 2.4e-3;
    assert_true(fabs(sums.overlap_sum / (2 * h * h) - 1) < 2e-11);
    assert_true(fabs(sums.overlap_max / (h * h / 2) - 1) < 2e-11);
    rig_close(&rig);
}

/* A corner of a square pressed into a floor, beams as stiff as need be: counted from a quarter of a
 * triangle, stopped where it is told to. */
static void test_a_limit_of_ones_own_ends_a_run(void **state)
{
    (void)state;
    static const char square[] =
        "model: trigrains\ngravity: [0, 0]\ntime: {step: 1e-7, duration: 1}\n%s"
        "grains:\n  - {kind: single, shape: square, edge: 2e-3, angle: 45, position: [0, %.17g]}\n"
        "walls: [{kind: vessel, width: 32e-3, height: 20e-3, thickness: 4e-3}]\n";
    static const struct {
        const char *keys;
        double share; /* of each of the two triangles that share the corner */
        int deep, stops;
    } cases[] = {{"", 0.2, 0, 0},
                 {"", 0.3, 2, 0},
                 {"guards: {overlap: {stop: 0.28}}\n", 0.3, 2, 1},
                 {"guards: {overlap: {warn: 0.31}}\n", 0.3, 0, 0}};
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
        ElementRig rig = {0};
        char text[1024];
        double depth =
            sqrt(2e-6 * cases[k].share); /* each holds half of depth^2, of an area of 1 mm^2 */
        snprintf(text, sizeof text, square, cases[k].keys, sqrt(2) * 1e-3 - depth);
        must(oz_scene_parse(&rig.scene, "rig.yaml", text, NULL, 0));
        must(oz_insert_grains(&rig.grains, &rig.scene));
        rig_start(&rig);
        OzStatus status = oz_element_reference_advance(rig.reference, 1);
        assert_int_equal(status, cases[k].stops ? OZ_ERR_BLOWUP : OZ_OK);
        must(oz_element_reference_snapshot(rig.reference, &rig.now));
        assert_int_equal(rig.now.deep_count, cases[k].deep);
        rig_close(&rig);
    }
}

/* A die on a floor that goes up and down at 40 Hz: energy comes from the floor's work alone. */
static void test_moving_floor(void **state)
{
    (void)state;
    ElementRig rig;
    rig_read(&rig, "integrator: gear4\ntime: {step: 1e-6, duration: 1}\nobserve: {ledger: true}\n"
                   "walls:\n  - {kind: segment, from: [1, 0], to: [-1, 0],\n"
                   "     motion: {frequency: 40, amplitude: 1e-3}}");
    OzElements *p = rig_grains(&rig, 1, 4, 4);
    rig_square(&rig, 0, 2e-3, (double[2]){0, 1.45e-3}, 0.7, rest, 4);
    must(oz_elements_set_triangle(p, 4, (double[6]){-0.05, 0, 0, -0.05, 0.05, 0}, 0));
    rig_start(&rig);
    double start = rig_energy(&rig.now), height = rig.now.position[1], mass = 4 * 4e-6;
    rig_advance(&rig, 20000);
    /* coordinates of 0.02 m have a last digit of 3e-18 */
    assert_true(fabs(rig.now.element_position[9] - p->position[9] -
                     1e-3 * sin(2 * pi * 40 * 0.02)) < 1e-17);
    OzElementLedger l = rig.now.element_ledger;
    double gained = rig_energy(&rig.now) - start + mass * 9.80665 * (rig.now.position[1] - height);
    double residual = gained + l.beam_axial + l.beam_bending - l.work_walls;
    print_message("floor's work %.3g J, beams took %.3g J, residual %.1e of the work\n",
                  l.work_walls, l.beam_axial + l.beam_bending, residual / l.work_walls);
    assert_true(l.work_walls > 10 * start && l.beam_axial > 0);
    /* gear4's second order where contacts begin, and contacts of kind ii, which have no potential
     */
    assert_true(fabs(residual) < 0.01 * l.work_walls);
    rig_close(&rig);
}

/* A wall that goes at 0.1 ms holds a disc until then; one that turns takes its elements round. */
static void test_walls_go_and_turn(void **state)
{
    (void)state;
    ElementRig rig;
    rig_read(&rig,
             "gravity: [0, 0]\nintegrator: rk4\ntime: {step: 1e-6, duration: 1}\n"
             "contact: {contact_time: 2e-4, restitution: 0.5}\n"
             "walls:\n  - {kind: segment, from: [1, 0], to: [-1, 0], until: 1e-4}\n"
             "  - {kind: drum, diameter: 0.1, point: [0.2, 0.1], motion: {angular_velocity: 3}}");
    OzElements *p = rig_grains(&rig, 1, 1, 0);
    oz_elements_set_disc(p, 0, (double[2]){0, 0.9e-3}, 1e-3, 4);
    must(oz_elements_set_triangle(p, 1, (double[6]){-0.05, 0, 0, -0.05, 0.05, 0}, 0));
    must(oz_elements_set_triangle(p, 2, (double[6]){0.3, 0.1, 0.31, 0.1, 0.3, 0.13}, 0));
    rig_start(&rig);
    assert_int_equal(oz_contact_list_sum(&rig.now.contacts).walls, 1);
    rig_advance(&rig, 99);
    assert_int_equal(oz_contact_list_sum(&rig.now.contacts).walls, 1);
    rig_advance(&rig, 101);
    assert_int_equal(oz_contact_list_sum(&rig.now.contacts).walls, 0);
    double speed = rig.now.velocity[1], x = p->position[4] - 0.2, y = p->position[5] - 0.1;
    rig_advance(&rig, 1000);
    assert_true(rig.now.velocity[1] == speed);
    double turn = 3 * 1e-3, *at = &rig.now.element_position[4], *v = &rig.now.element_velocity[4];
    /* last digits of 0.3 m and, threefold, of 0.3 m/s */
    assert_true(fabs(at[0] - 0.2 - (cos(turn) * x - sin(turn) * y)) < 2e-16);
    assert_true(fabs(at[1] - 0.1 - (sin(turn) * x + cos(turn) * y)) < 2e-16);
    assert_true(fabs(v[0] + 3 * (at[1] - 0.1)) < 2e-16);
    assert_true(fabs(v[1] - 3 * (at[0] - 0.2)) < 2e-16);
    assert_true(rig.now.element_angular_velocity[2] == 3);
    rig_close(&rig);
}

/* Where a die is after a hit, with contacts every step and beams as often or oftener. */
static double flight(int substeps, double step)
{
    ElementRig rig;
    rig_read(&rig,
             "gravity: [0, 0]\nintegrator: velocity-verlet\nobserve: {ledger: true}\n"
             "time: {step: %g, duration: 1}\nbeams: {substeps: %d}",
             step, substeps);
    rig_grains(&rig, 2, 4, 4);
    rig_square(&rig, 0, 2e-3, rest, 0.5, (double[2]){0.3, 0}, 4);
    rig_square(&rig, 1, 2e-3, (double[2]){2.8e-3, 0.3e-3}, 0, rest, 4);
    rig_start(&rig);
    double start = rig_energy(&rig.now);
    rig_advance(&rig, (int64_t)(4e-3 / step + 0.5));
    OzElementLedger ledger = rig.now.element_ledger;
    double lost = ledger.beam_axial + ledger.beam_bending;
    /* second order at steps up to 4e-6 s, and the beginnings of contacts: 6e-4 */
    assert_true(fabs(rig_energy(&rig.now) + lost - start) < 2e-3 * start);
    double x = rig.now.position[0];
    rig_close(&rig);
    return x;
}

/* Beams in substeps come nearer to the exact answer than without, at the same step of contacts. */
static void test_substeps(void **state)
{
    (void)state;
    double exact = flight(1, 2.5e-7);
    double plain = fabs(flight(1, 4e-6) - exact), parted = fabs(flight(4, 4e-6) - exact);
    double fine = fabs(flight(4, 2e-6) - exact);
    print_message("error without substeps %.2e m, with four %.2e m, at half the step %.2e m\n",
                  plain, parted, fine);
    /* second order is a quarter, within a twentieth for what is of higher order */
    assert_true(parted < plain && fine < 0.3 * parted);
}

static void check_says(ElementRig *rig, int64_t step, const char *words)
{
    assert_int_equal(oz_element_reference_advance(rig->reference, step), OZ_ERR_BLOWUP);
    if (!strstr(oz_status_text(), words)) {
        fail_msg("'%s' does not say '%s'", oz_status_text(), words);
    }
}

/* Two dice whose second is made by the caller. */
static OzElements *open_two(ElementRig *rig, const double second[2], double edge)
{
    rig_read(rig, "gravity: [0, 0]\nintegrator: gear4\ntime: {step: 1e-6, duration: 1}");
    OzElements *elements = rig_grains(rig, 2, 4, 4);
    rig_square(rig, 0, 2e-3, rest, 0, rest, 4);
    rig_square(rig, 1, edge, second, 0.1, rest, 4);
    return elements;
}

static void test_guards(void **state)
{
    (void)state;
    ElementRig rig;
    open_two(&rig, (double[2]){0, 0.6e-3}, 1e-4);
    rig_start(&rig);
    check_says(&rig, 1, "grain 0 has a triangle wholly inside");
    rig_close(&rig);
    open_two(&rig, (double[2]){1.2e-3, 0}, 2e-3);
    rig_start(&rig);
    check_says(&rig, 1, "grain 0 overlaps by more than half an element with grain 1 in step 1");
    rig_close(&rig);
    OzElements *elements = open_two(&rig, (double[2]){5e-3, 0}, 2e-3);
    elements->position[9] += 2e-3;
    rig_start(&rig);
    check_says(&rig, 1, "grain 1 has a beam shorter than half or longer than 1.5");
    rig_close(&rig);
    elements = open_two(&rig, (double[2]){5e-3, 0}, 2e-3);
    elements->angle[1] += 1.5;
    rig_start(&rig);
    check_says(&rig, 1, "grain 0 has a beam bent by more than 1 rad");
    rig_close(&rig);
    elements = open_two(&rig, (double[2]){5e-3, 0}, 2e-3);
    for (int i = 0; i < 4; i++) {
        elements->velocity[2 * i] = 1e3;
    }
    rig_start(&rig);
    check_says(&rig, 1, "moves an element farther than half its reach");
    rig_close(&rig);
    elements = open_two(&rig, (double[2]){5e-3, 0}, 2e-3);
    elements->angular_velocity[6] = NAN;
    rig_start(&rig);
    check_says(&rig, 1, "grain 1");
    rig_close(&rig);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_pairs),
        cmocka_unit_test(test_sums),
        cmocka_unit_test(test_lists_hold_all_forces),
        cmocka_unit_test(test_contacts_move_grains),
        cmocka_unit_test(test_counts),
        cmocka_unit_test(test_a_limit_of_ones_own_ends_a_run),
        cmocka_unit_test(test_moving_floor),
        cmocka_unit_test(test_walls_go_and_turn),
        cmocka_unit_test(test_substeps),
        cmocka_unit_test(test_guards),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
