/* Mean forces on walls, from the impulses that kernels add up: each step's force against the same
 * contact seen by the host, and the balance of momentum of all grains. ORZO_NEEDS_DEVICE. */
#include "device_rig.h"

#include "observe/wall_push.h"

/* Rods of two sizes thrown about in a box that is shaken aside, and a drum that turns in it. What
 * pads the last block of lanes stays where the first grain began, in the way of a side. */
static const char *const thrown =
    "model: rods\nprecision: double\nintegrator: euler\ngravity: [0, 0, -9.81]\n"
    "time: {step: 1e-6, duration: 1}\n"
    "contact: {contact_time: 2e-4, restitution: 0.5, friction: 0.4}\n"
    "grains:\n"
    "  - {kind: single, diameter: 0.6e-3, position: [6.68e-3, 2e-3, 3e-3]}\n"
    "  - {kind: random, count: 22, diameter: 0.6e-3}\n"
    "  - {kind: random, count: 20, diameter: 0.5e-3, aspect: 3}\n"
    "walls:\n"
    "  - {kind: box, point: [4e-3, 2e-3, 0], size: [6e-3, 6e-3, 6e-3],\n"
    "     motion: {frequency: 100, amplitude: 0.2e-3, direction: [1, 0, 1]%s}}\n"
    "  - {kind: cylinder, point: [4e-3, 2e-3, 3e-3], axis: [0, 1, 0], diameter: 6.4e-3,\n"
    "     motion: {angular_velocity: 40}}\n"
    "observe: {walls: mean}\n";

/* Spheres that fall into a box of that kind at rest, of the same kernels. */
static const char *const bed =
    "model: rods\nprecision: double\nintegrator: velocity-verlet\ngravity: [1, 0, -9.81]\n"
    "time: {step: 4e-6, duration: 1}\n"
    "contact: {contact_time: 2e-4, restitution: %s, friction: %s}\n"
    "grains: [{kind: %s}]\n"
    "walls: [{kind: box, point: [0, 0, 1e-3], size: [6e-3, 6e-3, 3e-2]}]\n"
    "settle: {drag: %s}\nobserve: {walls: mean}\n";

static void assert_within(double a, double b, double most)
{
    if (!(fabs(a - b) <= most)) {
        fail_msg("%.12g is not %.12g within %g", a, b, most);
    }
}

/* Walls' forces and torques at a snapshot's moment, by the host. */
static OzWallPush instant_of(const OzSnapshot *now)
{
    OzWallPush push = {0};
    OzScene scene = *now->scene;
    scene.observe.walls = OZ_OBSERVE_WALLS_INSTANT;
    must(oz_wall_push_take(&push, &scene));
    oz_wall_push_see(&push, now);
    return push;
}

/* Explicit Euler's step begins with the forces of the state before it: the impulse of one step is
 * that force, and that torque about the point, times the step. */
static void expect_a_steps_impulse(const char *turning)
{
    Rig rig;
    rig_open(&rig, thrown, turning);
    throw_grains(&rig.grains, 0.5, 200);
    OzSim *sim = start_sim(&rig, &rig_device);
    double most[2] = {0};
    for (int look = 0; look < 20; look++) {
        OzSnapshot now = state_at(&rig, sim, 400 * (look + 1));
        OzWallPush push = instant_of(&now);
        OzSnapshot next = state_at(&rig, sim, 400 * (look + 1) + 1);
        assert_true(now.has_wall_impulse && next.has_wall_impulse);
        for (int w = 0; w < 2; w++) {
            for (int k = 0; k < 6; k++) {
                double step = next.wall_impulse[w][k] - now.wall_impulse[w][k];
                double force = k < 3 ? push.force[w][k] : push.torque[w][k - 3];
                /* sums of 1e-5 N s, of rounding 1e-16 a part, over a step of 1e-6 s; a hit has
                 * 1e-2 N, at arms of 3 mm */
                assert_within(step / 1e-6, force, k < 3 ? 1e-8 : 1e-10);
                most[k / 3] = fmax(most[k / 3], fabs(force));
            }
        }
        oz_wall_push_free(&push);
        oz_snapshot_free(&now);
        oz_snapshot_free(&next);
    }
    assert_true(most[0] > 1e-3 && most[1] > 1e-6);
    oz_sim_free(sim);
    rig_close(&rig);
}

static void test_a_steps_impulse_is_its_force(void **state)
{
    (void)state;
    expect_a_steps_impulse("");
    expect_a_steps_impulse(", angular_velocity: 60, axis: [1, 2, 0], point: [4e-3, 2e-3, 3e-3]");
}

/* Total momentum of the grains, and its moment about a point, spins included. */
static void momentum_of(const OzSnapshot *now, const double about[3], double momentum[6])
{
    memset(momentum, 0, 6 * sizeof *momentum);
    for (int64_t i = 0; i < now->count; i++) {
        double arm[3], moment[3], m = now->grains->mass[i];
        for (int k = 0; k < 3; k++) {
            arm[k] = now->position[3 * i + k] - about[k];
        }
        cross3(arm, &now->velocity[3 * i], moment);
        for (int k = 0; k < 3; k++) {
            momentum[k] += m * now->velocity[3 * i + k];
            momentum[3 + k] +=
                m * moment[k] + now->grains->inertia[i] * now->angular_velocity[3 * i + k];
        }
    }
}

/* What the walls must have felt between two states: gravity's impulse less what the grains have
 * gained. */
static double expected_push(const OzSnapshot *from, const OzSnapshot *to, int axis)
{
    double before[6], after[6], mass = 0;
    momentum_of(from, from->scene->walls[0].point, before);
    momentum_of(to, to->scene->walls[0].point, after);
    for (int64_t i = 0; i < to->count; i++) {
        mass += to->grains->mass[i];
    }
    double time = to->time - from->time;
    return mass * to->scene->gravity[axis] * time - (after[axis] - before[axis]);
}

/* A sphere that bounces without loss: at the tops of its flights, whatever lies between, the walls
 * have felt exactly its weight for as long. */
static void test_a_bouncing_sphere_weighs_itself(void **state)
{
    (void)state;
    Rig rig;
    rig_open(&rig, bed, "1", "0.4", "single, diameter: 1e-3, position: [0, 0, 3e-3]", "1");
    rig.scene.settle.drag = 0;
    rig.scene.gravity[0] = 0;
    double fall = sqrt(2 * 1.5e-3 / 9.81);
    OzSim *sim = start_sim(&rig, &rig_device);
    /* a bounce takes two falls and a contact: 20 of them, looked at every half one */
    OzSnapshot first = state_at(&rig, sim, 0);
    for (int look = 1; look <= 40; look++) {
        OzSnapshot now = state_at(&rig, sim, (int64_t)(look * (fall + 1e-4) / 4e-6));
        double felt = now.wall_impulse[0][2] - first.wall_impulse[0][2];
        double weight = rig.grains.mass[0] * 9.81;
        if (now.contacts.count == 0) {
            /* rounding of some thousand kicks */
            assert_within(felt, expected_push(&first, &now, 2), 1e-11 * weight * now.time);
        }
        if (look == 40) {
            /* whole periods but for 1 in 40 */
            assert_within(felt / now.time, -weight, weight / 20);
        }
        oz_snapshot_free(&now);
    }
    oz_snapshot_free(&first);
    oz_sim_free(sim);
    rig_close(&rig);
}

/* A settled bed weighs m g on its box, aside too as gravity is tilted, and the torque about the
 * box's point is that of its weight: balances of momentum and of its moment. */
static void test_a_bed_at_rest_weighs_itself(void **state)
{
    (void)state;
    Rig rig;
    rig_open(&rig, bed, "0.3", "0.4", "random, count: 60, diameter: 1e-3", "100");
    OzSim *sim = start_sim(&rig, &rig_device);
    OzSnapshot start = state_at(&rig, sim, 60000), now = state_at(&rig, sim, 85000);
    OzWallPush push = instant_of(&now);
    double mass = 60 * rig.grains.mass[0], time = now.time - start.time;
    for (int k = 0; k < 3; k++) {
        double felt = (now.wall_impulse[0][k] - start.wall_impulse[0][k]) / time;
        /* rounding, and verlet's half kicks at both ends; and at rest, to what still moves */
        assert_within(felt, expected_push(&start, &now, k) / time, 1e-6 * mass * 9.81);
        assert_within(felt, mass * rig.scene.gravity[k], 2e-3 * mass * 9.81);
        assert_within(felt, push.force[0][k], 5e-3 * mass * 9.81);
        double turned = (now.wall_impulse[0][3 + k] - start.wall_impulse[0][3 + k]) / time;
        assert_within(turned, push.torque[0][k], 5e-3 * mass * 9.81 * 3e-3);
    }
    oz_wall_push_free(&push);
    oz_snapshot_free(&start);
    oz_snapshot_free(&now);
    oz_sim_free(sim);
    rig_close(&rig);
}

/* Two squares thrown into a vessel that is shaken: the impulse of 3000 steps is the sum over them
 * of what the host finds at their ends. */
static void check_flat_grains(Shape shape)
{
    Rig rig;
    rig_open(&rig, "model: trigrains\nintegrator: velocity-verlet\ngravity: [1, -20]\n"
                   "time: {step: 2e-6, duration: 1}\ngrains:\n"
                   "  - {kind: single, shape: square, edge: 2e-3, position: [0, 2.6e-3],"
                   " angle: 20, velocity: [-0.4, -0.6], spin: 30}\n"
                   "  - {kind: single, shape: square, edge: 2e-3, position: [3e-3, 2.2e-3],"
                   " velocity: [-0.7, -0.4]}\n"
                   "walls:\n"
                   "  - {kind: segment, from: [-9e-3, 20e-3], to: [9e-3, 20e-3]}\n"
                   "  - {kind: vessel, point: [4e-3, 1e-3], width: 12e-3, height: 2e-2,\n"
                   "     motion: {frequency: 100, amplitude: 0.5e-3}}\n"
                   "observe: {walls: mean}\n");
    OzDevice device = shaped_device(shape);
    OzSim *sim = start_sim(&rig, &device);
    OzSnapshot now = state_at(&rig, sim, 0);
    double sum[6] = {0}, size[6] = {0};
    for (int64_t step = 1; step <= 3000; step++) {
        oz_snapshot_free(&now);
        now = state_at(&rig, sim, step);
        OzWallPush push = instant_of(&now);
        for (int k = 0; k < 6; k++) {
            double force = k < 3 ? push.force[1][k] : push.torque[1][k - 3];
            sum[k] += 2e-6 * force;
            size[k] += 2e-6 * fabs(force);
        }
        oz_wall_push_free(&push);
    }
    for (int k = 0; k < 6; k++) {
        /* velocities at a step's end are not quite those that its force was found with, which are
         * predicted with the acceleration before: of hits of some 100 steps */
        assert_within(now.wall_impulse[1][k], sum[k], 1e-3 * size[k]);
        assert_true(now.wall_impulse[0][k] == 0);
    }
    assert_true(size[0] > 0 && size[1] > 0 && size[5] > 0 && size[2] == 0);
    oz_snapshot_free(&now);
    oz_sim_free(sim);
    rig_close(&rig);
}

static void test_flat_grains(void **state)
{
    (void)state;
    check_flat_grains(NATIVE);
    check_flat_grains(GROUP);
}

/* The first row has no mean, the next ones have the difference over the time between them; where
 * impulses are not known, cells are empty, and the mean goes on over the whole time. */
static void test_rows_have_means_since_the_row_before(void **state)
{
    (void)state;
    OzWall wall = {.kind = OZ_WALL_PLANE};
    OzScene scene = {.walls = &wall, .wall_count = 1, .observe.walls = OZ_OBSERVE_WALLS_MEAN};
    double impulse[1][6] = {{1, 2, 3, 4, 5, 6}};
    OzSnapshot now = {.scene = &scene, .wall_impulse = impulse, .has_wall_impulse = true};
    OzWallPush push = {0};
    must(oz_wall_push_take(&push, &scene));
    oz_wall_push_see(&push, &now);
    assert_false(push.is_known);
    now.time = 0.5;
    now.has_wall_impulse = false;
    oz_wall_push_see(&push, &now);
    assert_false(push.is_known);
    now.time = 2;
    now.has_wall_impulse = true;
    impulse[0][2] = 7;
    impulse[0][3] = 5;
    oz_wall_push_see(&push, &now);
    assert_true(push.is_known && push.force[0][2] == 2 && push.torque[0][0] == 0.5);
    assert_true(push.force[0][0] == 0);
    oz_wall_push_see(&push, &now); /* no time */
    assert_false(push.is_known);
    must(oz_wall_push_take(&push, &scene)); /* asked for as before: it goes on */
    now.time = 3;
    oz_wall_push_see(&push, &now);
    assert_true(push.is_known && push.force[0][2] == 0);
    oz_wall_push_free(&push);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rows_have_means_since_the_row_before),
        cmocka_unit_test(test_a_steps_impulse_is_its_force),
        cmocka_unit_test(test_a_bouncing_sphere_weighs_itself),
        cmocka_unit_test(test_a_bed_at_rest_weighs_itself),
        cmocka_unit_test(test_flat_grains),
    };
    return cmocka_run_group_tests(tests, open_rig_device, close_rig_device);
}
