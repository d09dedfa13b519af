/* Contacts as data: what a list says that grains feel is what moves them. */
#include "rig.h"

#include "model/contact.h"

/* Force and, of spheres, torque about its centre of every contact on every grain, 3 x count each.
 */
static void add_up(const OzSnapshot *s, double *force, double *torque)
{
    memset(force, 0, 3 * (size_t)s->count * sizeof *force);
    memset(torque, 0, 3 * (size_t)s->count * sizeof *torque);
    for (int64_t i = 0; i < s->contacts.count; i++) {
        const OzContactEntry *e = &s->contacts.entry[i];
        for (int side = 0; side < (e->b < 0 ? 1 : 2); side++) {
            int64_t grain = side ? e->b : e->a;
            double on[3], arm[3], turn[3];
            for (int k = 0; k < 3; k++) {
                on[k] = (side ? 1 : -1) * (e->push * e->normal[k] + e->tangential[k]);
                arm[k] = e->point[k] - s->position[3 * grain + k];
            }
            cross3(arm, on, turn);
            for (int k = 0; k < 3; k++) {
                force[3 * grain + k] += on[k];
                torque[3 * grain + k] += turn[k];
            }
        }
    }
}

/* Rods and spheres falling on a shaken floor in a cylinder. */
static void open_bed(Rig *rig, const char *integrator, const char *contact)
{
    rig_open(rig,
             "model: rods\nseed: 3\ntime: {step: 2e-5, duration: 1}\nintegrator: %s\n"
             "contact: {contact_time: 6e-4, restitution: 0.5, friction: 0.3%s}\n"
             "grains:\n  - {kind: random, count: 24, diameter: 1e-3, aspect: [2, 4], fill: 0.2}\n"
             "  - {kind: random, count: 12, diameter: [0.8e-3, 1.5e-3], aspect: 0, fill: 0.2}\n"
             "walls:\n  - {kind: cylinder, diameter: 7e-3}\n"
             "  - {kind: plane, point: [0, 0, 0], normal: [0, 0, 1],"
             " motion: {frequency: 30, acceleration_ratio: 3}}\n",
             integrator, contact);
    rig_start(rig);
}

static double larger_gap(double most, const double *a, const double *b)
{
    for (int k = 0; k < 3; k++) {
        most = fmax(most, fabs(a[k] - b[k]));
    }
    return most;
}

/* The largest part of (change of momentum over a step) - (contact forces + weight), and of spheres
 * the same of angular momentum over the radius; *size: the largest force. N. */
static double step_error(Rig *rig, int64_t step, double *size)
{
    enum { MOST = 3 * 36 };
    double force[MOST], torque[MOST], velocity[MOST], spin[MOST], worst = 0, dt = rig->scene.step;
    size_t words = 3 * (size_t)rig->now.count * sizeof(double);
    add_up(&rig->now, force, torque);
    memcpy(velocity, rig->now.velocity, words);
    memcpy(spin, rig->now.angular_velocity, words);
    rig_advance(rig, step + 1);
    for (int64_t i = 0; i < rig->now.count; i++) {
        double push[3], turn[3], twist[3], radius = rig->grains.diameter[i] / 2;
        for (int k = 0; k < 3; k++) {
            int64_t at = 3 * i + k;
            push[k] = rig->grains.mass[i] *
                      ((rig->now.velocity[at] - velocity[at]) / dt - rig->scene.gravity[k]);
            turn[k] =
                rig->grains.inertia[i] * (rig->now.angular_velocity[at] - spin[at]) / dt / radius;
            twist[k] = torque[at] / radius;
            *size = fmax(*size, fabs(force[at]));
        }
        worst = larger_gap(worst, push, &force[3 * i]);
        worst = rig->grains.length[i] > 0 ? worst : larger_gap(worst, turn, twist);
    }
    return worst;
}

/* Newton's second law over a shaken bed, each step's own: the Eulers take forces at the state that
 * a snapshot shows. */
static void test_contacts_move_a_bed(void **state)
{
    (void)state;
    static const char *const contacts[] = {"", ", parallel: line", ", slip: scale",
                                           ", tangential_stiffness: 0, tangential_damping: 1"};
    for (int i = 0; i < 2 * 4; i++) {
        Rig rig;
        double worst = 0, size = 0;
        int64_t seen = 0;
        open_bed(&rig, integrator_names[i % 2], contacts[i / 2]);
        for (int64_t step = 3000; step < 3100; step++) {
            rig_advance(&rig, step);
            seen += rig.now.contacts.count;
            worst = fmax(worst, step_error(&rig, step, &size));
        }
        /* rounding of a velocity, over a step: 1e-17 / 2e-5 s of 9.81 m/s^2 is 1e-13 */
        assert_true(size > 1e-4 && seen > 100);
        if (!(worst < 1e-12 * size)) {
            fail_msg("%s%s: %g of %g N", integrator_names[i % 2], contacts[i / 2], worst, size);
        }
        rig_close(&rig);
    }
}

/* The same of velocity-verlet, whose step takes half the forces at its start and half of those at
 * its end, damped with a predicted velocity: a sphere that hits a floor and sticks to it while its
 * spring is wound up. The largest error over the hit, of the largest force. */
static double verlet_error(double step)
{
    Rig rig;
    double now[3], torque[3], before[3] = {0}, velocity[3], worst = 0, size = 0;
    rig_open(&rig,
             "model: rods\ntime: {step: %.17g, duration: 1}\nintegrator: velocity-verlet\n"
             "contact: {contact_time: 1e-3, restitution: 0.5, friction: 5, damping: smooth}\n"
             "grains: [{kind: single, diameter: 1e-2, position: [0, 0, 5.01e-3],"
             " velocity: [0.2, 0, -1]}]\nwalls: [{kind: plane}]\n",
             step);
    rig_start(&rig);
    for (int64_t k = 1; (double)k * step < 8e-4; k++) {
        memcpy(velocity, rig.now.velocity, sizeof velocity);
        rig_advance(&rig, k);
        add_up(&rig.now, now, torque);
        for (int c = 0; c < 3; c++) {
            double felt = rig.grains.mass[0] *
                          ((rig.now.velocity[c] - velocity[c]) / step - rig.scene.gravity[c]);
            worst = fmax(worst, fabs(felt - 0.5 * (before[c] + now[c])));
            size = fmax(size, fabs(now[c]));
        }
        memcpy(before, now, sizeof before);
    }
    rig_close(&rig);
    return worst / size;
}

static void test_contacts_move_a_hit_to_second_order(void **state)
{
    (void)state;
    double coarse = verlet_error(1e-5), fine = verlet_error(5e-6);
    /* second order: a quarter (4e-4 and 1e-4); a spring taken half a step off: a half */
    assert_true(coarse < 1e-3 && fine < 0.3 * coarse);
}

static void test_a_sphere_at_rest_is_carried(void **state)
{
    (void)state;
    Rig rig;
    rig_open(&rig, "model: rods\ntime: {step: 1e-5, duration: 1}\n"
                   "contact: {contact_time: 1e-3, restitution: 0.1, friction: 0.5}\n"
                   "grains: [{kind: single, diameter: 1e-2, position: [1e-3, 2e-3, 5e-3]}]\n"
                   "walls:\n  - {kind: cylinder, diameter: 1}\n  - {kind: plane}\n");
    rig_start(&rig);
    rig_advance(&rig, 20000);
    assert_int_equal(rig.now.contacts.count, 1);
    const OzContactEntry *e = rig.now.contacts.entry;
    double weight = rig.grains.mass[0] * 9.81;
    double overlap = 9.81 / oz_contact_constants(&rig.scene.contact).stiffness;
    /* 100 times in which the oscillation falls by 10: rounding alone is left */
    assert_true(fabs(e->push / weight - 1) < 1e-9);
    assert_true(fabs(e->overlap / overlap - 1) < 1e-9);
    assert_true(fabs(e->energy / (0.5 * weight * overlap) - 1) < 1e-9);
    assert_true(e->a == 0 && e->b == -2 && e->kind == OZ_CONTACT_ROD && !e->slips);
    assert_true(e->normal[2] == -1 && e->tangential[0] == 0);
    assert_true(e->point[0] == 1e-3 && e->point[1] == 2e-3);
    assert_true(fabs(e->point[2] + overlap / 2) < 1e-9 * overlap + 1e-17);
    double force[2][3];
    oz_contact_list_push_walls(&rig.now.contacts, force, 2);
    assert_true(force[0][2] == 0 && force[1][2] == -e->push);
    static const double about[2][3] = {{0}, {4e-3, 0, 0}};
    double torque[2][3];
    oz_contact_list_turn_walls(&rig.now.contacts, about, torque, 2);
    assert_true(torque[0][0] == 0 && torque[1][2] == 0);
    assert_true(fabs(torque[1][0] / (-2e-3 * e->push) - 1) < 1e-15);
    assert_true(fabs(torque[1][1] / (-3e-3 * e->push) - 1) < 1e-15); /* a rounding or two */
    rig_close(&rig);
}

/* A bed in a frictionless tube: the floor alone carries it. */
static void test_a_floor_carries_its_bed(void **state)
{
    (void)state;
    Rig rig;
    double force[2][3], weight = 0;
    rig_open(&rig, "model: rods\nseed: 2\ntime: {step: 2e-5, duration: 1}\n"
                   "contact: {contact_time: 1e-3, restitution: 0.2, friction: 0.5}\n"
                   "grains: [{kind: random, count: 12, diameter: 1e-3, aspect: [0, 2]}]\n"
                   "walls:\n  - {kind: plane}\n"
                   "  - {kind: cylinder, diameter: 4e-3, contact: {friction: 0}}\n");
    rig_start(&rig);
    rig_advance(&rig, 60000);
    for (int64_t i = 0; i < rig.now.count; i++) {
        weight += 9.81 * rig.grains.mass[i];
    }
    oz_contact_list_push_walls(&rig.now.contacts, force, 2);
    /* what still rolls after 1.2 s: 8e-7; a grain is a twelfth */
    assert_true(fabs(force[0][2] / weight + 1) < 1e-5);
    assert_true(fabs(force[1][2]) < 1e-12 * weight);
    rig_close(&rig);
}

/* A sphere thrown along a floor slips until it rolls (at 5/7 of its speed). */
static void test_what_slips_has_all_of_friction(void **state)
{
    (void)state;
    Rig rig;
    rig_open(&rig, "model: rods\ntime: {step: 1e-5, duration: 1}\n"
                   "contact: {contact_time: 1e-3, restitution: 0.1, friction: 0.5}\n"
                   "grains: [{kind: single, diameter: 1e-2, position: [0, 0, 5e-3],"
                   " velocity: [0.5, 0, 0]}]\nwalls: [{kind: plane}]\n");
    rig_start(&rig);
    rig_advance(&rig, 1000);
    const OzContactEntry *e = rig.now.contacts.entry;
    assert_true(rig.now.contacts.count == 1 && e->slips);
    /* the floor feels friction along the motion; rounding */
    assert_true(fabs(e->tangential[0] / (0.5 * e->push) - 1) < 1e-12);
    double force[1][3];
    oz_contact_list_push_walls(&rig.now.contacts, force, 1);
    assert_true(force[0][0] == e->tangential[0] && force[0][2] == -e->push);
    rig_advance(&rig, 6000); /* 0.5 x 2/7 / (0.5 x 9.81) s are 2900 steps */
    e = rig.now.contacts.entry;
    assert_true(rig.now.contacts.count == 1 && !e->slips);
    assert_true(fabs(e->tangential[0]) < 0.1 * e->push);
    rig_close(&rig);
}

/* Whatever the order in which they were found. */
static void test_sums_are_in_the_order_of_ids(void **state)
{
    (void)state;
    static const OzContactEntry found[] = {
        {.a = 1, .b = -2, .overlap = 4, .energy = 1},
        {.a = 1, .b = 2, .part_a = 5, .overlap = 3, .kind = OZ_CONTACT_I},
        {.a = 0, .b = 2, .overlap = 9, .kind = OZ_CONTACT_DISC, .spring_energy = 2},
        {.a = 1, .b = -1, .overlap = 1},
        {.a = 1, .b = 2, .part_a = 4, .overlap = 2, .kind = OZ_CONTACT_I}};
    static const double order[] = {9, 2, 3, 1, 4};
    OzContactList list = {0};
    for (int i = 0; i < 5; i++) {
        must(oz_contact_list_add(&list, &found[i]));
    }
    oz_contact_list_sort(&list);
    for (int i = 0; i < 5; i++) {
        assert_true(list.entry[i].overlap == order[i]);
    }
    OzContactSums sums = oz_contact_list_sum(&list);
    assert_int_equal(sums.pairs, 2);
    assert_int_equal(sums.walls, 2);
    assert_int_equal(sums.kinds[OZ_CONTACT_I], 2);
    assert_true(sums.overlap_sum == 10 && sums.overlap_max == 4);
    assert_true(sums.energy == 3 && sums.spring_energy == 2);
    oz_contact_list_free(&list);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_contacts_move_a_bed),
        cmocka_unit_test(test_contacts_move_a_hit_to_second_order),
        cmocka_unit_test(test_a_sphere_at_rest_is_carried),
        cmocka_unit_test(test_a_floor_carries_its_bed),
        cmocka_unit_test(test_what_slips_has_all_of_friction),
        cmocka_unit_test(test_sums_are_in_the_order_of_ids),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
