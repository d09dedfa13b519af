/* Walls that change their place when they turn: closed forms and other walls' answers on the host
 * reference, and a crowd in such walls on the device beside it. ORZO_NEEDS_DEVICE. */
#include "device_rig.h"

#include "export/surface.h"
#include "mesh_files.h"
#include "sim/sim_state.h"

static const double R = 0.5e-3;
enum { STEPS_PER_MS = 500 };

/* A sphere of 1 mm. */
#define ONE                                                                                        \
    "model: rods\nprecision: %s\ngravity: [0, 0, %g]\ntime: {step: 2e-6, duration: 10}\n"          \
    "integrator: velocity-verlet\nobserve: {ledger: true}\n"                                       \
    "contact: {contact_time: 2e-4, restitution: 0.3, friction: %g}\n"                              \
    "grains: [{kind: single, diameter: 1e-3, position: [%g, %g, %g], velocity: [%g, %g, 0]}]\n"    \
    "walls:\n%s"

static void assert_within(double a, double b, double most)
{
    if (!(fabs(a - b) <= most)) {
        fail_msg("%.9g is not %.9g within %g", a, b, most);
    }
}

/* A paddle about an upright axis at its edge sweeps a smooth sphere before it outwards: x'' = w^2 x
 * along the paddle, and it begins with x' = w x, so x = x0 exp(w t); it goes at w x across the
 * paddle and at w (x - R) along it, pressed by 2 w x' - w^2 R. The paddle's work is what the sphere
 * gains. Overlaps are (contact_time / pi)^2 of up to 6 m/s^2, 5e-5 R. */
static void assert_swept(const OzSnapshot *now, double w, double x0)
{
    double angle = w * now->time, x = x0 * exp(angle);
    double c = cos(angle), s = sin(angle);
    double place[] = {x * c - R * s, x * s + R * c};
    double velocity[] = {w * (x - R) * c - w * x * s, w * (x - R) * s + w * x * c};
    double start = 0.5 * now->grains->mass[0] * w * w * ((x0 - R) * (x0 - R) + x0 * x0);
    double gain = mechanical_energy(now) - start;
    double given = now->ledger.work_walls - now->ledger.dissipated - now->ledger.elastic;
    for (int k = 0; k < 2; k++) {
        assert_within(now->position[k], place[k], 1e-4 * R);
        assert_within(now->velocity[k], velocity[k], 1e-4 * w * x);
    }
    assert_within(given, gain, 1e-3 * gain);
}

static void a_paddle_sweeps_a_sphere(void **state)
{
    (void)state;
    const double w = 20, x0 = 3e-3;
    const char *plate = mesh_of_text("v -5 0 -2\nv 5 0 -2\nv 5 0 2\nv -5 0 2\nf 4 3 2 1\n", "obj");
    char mesh[256];
    snprintf(mesh, sizeof mesh,
             "  - {kind: mesh, path: '%s', scale: 1e-3, point: [5e-3, 0, 0],"
             " motion: {angular_velocity: 20, point: [0, 0, 7e-3]}}\n",
             plate);
    const char *const walls[] = {
        "  - {kind: rectangle, point: [5e-3, 0, 0], normal: [0, -1, 0], size: [10e-3, 4e-3],"
        " motion: {angular_velocity: -20, axis: [0, 0, -2], point: [0, 0, 7e-3]}}\n",
        "  - {kind: disc, point: [5e-3, 0, 0], normal: [0, -1, 0], diameter: 10e-3,"
        " motion: {angular_velocity: 20, axis: [0, 0, 1], point: [0, 0, 7e-3]}}\n",
        mesh,
        "  - {kind: plane, point: [5e-3, 0, 0], normal: [0, 1, 0],"
        " motion: {angular_velocity: 20, axis: [0, 0, 1], point: [0, 0, 7e-3]}}\n",
        "  - {kind: box, point: [4e-3, 6e-3, -3e-3], size: [20e-3, 12e-3, 8e-3],"
        " motion: {angular_velocity: 20, point: [0, 0, 7e-3]}}\n"};
    for (int k = 0; k < 5; k++) {
        Rig rig;
        rig_open(&rig, ONE, "double", 0.0, 0.0, x0, R, 0.0, w * (x0 - R), w * x0, walls[k]);
        rig_start(&rig);
        rig_advance(&rig, 50 * STEPS_PER_MS);
        assert_swept(&rig.now, w, x0);
        OzSnapshot now = state_after(&rig, NATIVE, 50 * STEPS_PER_MS);
        assert_swept(&now, w, x0);
        oz_snapshot_free(&now);
        rig_close(&rig);
    }
}

/* A paddle that stops leaves the sphere, which flies on straight but for what the dashpot takes in
 * the one step in which they part: 2 ln(1 / 0.3) step / contact_time, 2.4 % of what goes across. */
static void a_paddle_stops(void **state)
{
    (void)state;
    Rig rig;
    const double w = 20, x0 = 3e-3, flight = 20e-3, x = x0 * exp(0.6), c = cos(0.6), s = sin(0.6);
    rig_open(&rig, ONE, "double", 0.0, 0.0, x0, R, 0.0, w * (x0 - R), w * x0,
             "  - {kind: rectangle, point: [5e-3, 0, 0], normal: [0, -1, 0], size: [10e-3, 4e-3],"
             " motion: {angular_velocity: 20, point: [0, 0, 7e-3], until: 0.03}}\n");
    rig_start(&rig);
    OzSnapshot now = state_after(&rig, NATIVE, 50 * STEPS_PER_MS);
    rig_advance(&rig, 50 * STEPS_PER_MS);
    const double *at = rig.now.position;
    assert_within(at[0] * c + at[1] * s, x + w * (x - R) * flight, 1e-3 * R);
    assert_within(at[1] * c - at[0] * s, R + w * x * flight, 3e-2 * w * x * flight);
    assert_true(farthest(now.position, at, 3) < 1e-6 * R);
    oz_snapshot_free(&now);
    rig_close(&rig);
}

/* A sphere at rest in a wide drum that turns for a time T slides: friction x gravity speeds it up,
 * and its surface by 5/2 of that. When the drum stops, it brakes as long. What is left when it
 * sticks is what the spring at the wall holds, below a hundredth. */
static void assert_pushed(const OzSnapshot *now, double from, double T)
{
    const double gain = 0.2 * 9.81, time = now->time;
    double pushed = fmin(fmax(time - from, 0), T), braked = fmin(fmax(time - from - T, 0), T);
    double way = gain * (pushed * pushed + (2 * T - braked) * braked) / 2;
    assert_within(now->velocity[0], gain * (pushed - braked), 1e-2 * gain * T);
    assert_within(now->position[0], way, 1e-2 * gain * T * T);
    assert_within(-R * now->angular_velocity[1], 2.5 * gain * (pushed - braked), 2e-2 * gain * T);
}

static void a_drum_starts_and_stops(void **state)
{
    (void)state;
    Rig rig;
    const double from = 30e-3, T = 20e-3;
    rig_open(&rig, ONE, "double", -9.81, 0.2, 0.0, 0.0, R, 0.0, 0.0,
             "  - {kind: cylinder, diameter: 100, axis: [0, 1, 0], point: [0, 0, 50],"
             " motion: {angular_velocity: -0.02, from: 0.03, until: 0.05}}\n");
    rig_start(&rig);
    for (int ms = 20; ms <= 90; ms += 10) {
        rig_advance(&rig, ms * STEPS_PER_MS);
        assert_pushed(&rig.now, from, T);
    }
    OzSnapshot now = state_after(&rig, NATIVE, 45 * STEPS_PER_MS);
    assert_pushed(&now, from, T);
    oz_snapshot_free(&now);
    rig_close(&rig);
}

/* A sphere on a turntable rolls in circles at 2/7 of the table's rate (Weckesser 1997), and on a
 * turned mesh or rectangle as on a plane that turns about its normal. Joints of triangles that are
 * felt, or springs that do not go over them, show in the first digits. */
static void a_turntable_is_a_turntable(void **state)
{
    (void)state;
    enum { WALLS = 6 };
    const double w = 70;
    char mesh[256];
    Rig rigs[WALLS];
    snprintf(mesh, sizeof mesh,
             "  - {kind: mesh, path: '%s', scale: 1e-3, point: [1e-3, 0, 0],"
             " motion: {angular_velocity: 70, point: [0, 0, 0]}}\n",
             mesh_floor(20, 12));
    const char *const walls[] = {"  - {kind: plane, motion: {angular_velocity: 70}}\n",
                                 mesh,
                                 "  - {kind: rectangle, point: [1e-3, 0, 0], size: [12e-3, 12e-3],"
                                 " motion: {angular_velocity: 70, point: [0, 0, 0]}}\n",
                                 "  - {kind: disc, point: [1e-3, 0, 0], diameter: 12e-3,"
                                 " motion: {angular_velocity: 70, point: [0, 0, 0]}}\n",
                                 "  - {kind: plane, point: [1e-3, 0, 0],"
                                 " motion: {angular_velocity: 70, point: [0, 0, 0]}}\n",
                                 "  - {kind: box, point: [1e-3, 0, 0], size: [12e-3, 12e-3, 9e-3],"
                                 " motion: {angular_velocity: 70, point: [0, 0, 0]}}\n"};
    for (int k = 0; k < WALLS; k++) {
        rig_open(&rigs[k], ONE, "double", -9.81, 1.0, 1e-3, 0.0, R, 0.0, 0.02, walls[k]);
        rig_start(&rigs[k]);
        rig_advance(&rigs[k], 60 * STEPS_PER_MS);
        for (int c = 0; c < 3; c++) { /* of 1 mm and 20 mm/s; seen: 1e-8 */
            assert_within(rigs[k].now.position[c], rigs[0].now.position[c], 1e-9);
            assert_within(rigs[k].now.velocity[c], rigs[0].now.velocity[c], 2e-8);
        }
    }
    double before[3];
    memcpy(before, rigs[1].now.velocity, sizeof before);
    rig_advance(&rigs[1], 120 * STEPS_PER_MS);
    const double *after = rigs[1].now.velocity;
    double turned = atan2(before[0] * after[1] - before[1] * after[0], dot3(before, after));
    assert_within(turned, 2.0 / 7 * w * 0.06, 1e-3);
    for (int k = 0; k < WALLS; k++) {
        rig_close(&rigs[k]);
    }
}

/* A closed drum about the x axis, 20 mm long, of so many faces, fronts inside. */
static const char *mesh_drum(int faces, double radius)
{
    FILE *file = new_mesh("obj");
    for (int i = 0; i < faces; i++) {
        double angle = 2 * 3.14159265358979323846 * i / faces;
        for (int end = -1; end <= 1; end += 2) {
            fprintf(file, "v %d %.17g %.17g\n", 10 * end, radius * cos(angle), radius * sin(angle));
        }
    }
    for (int i = 0; i < faces; i++) {
        int next = (i + 1) % faces;
        fprintf(file, "f %d %d %d %d\n", 2 * i + 1, 2 * i + 2, 2 * next + 2, 2 * next + 1);
    }
    fclose(file);
    return mesh_paths[mesh_count - 1];
}

/* The mean force on a drum and its turning moment about its axis, by samples of each ms. */
static void mean_push(const char *wall, double force[3], double *torque)
{
    Rig rig;
    double sum[3] = {0}, moment = 0, one[1][3], turn[1][3];
    const double point[1][3] = {{0, 0, 0}};
    rig_open(&rig, ONE, "double", -9.81, 0.5, 0.0, 0.0, -5e-3 + R, 0.0, 0.0, wall);
    rig_start(&rig);
    for (int ms = 1; ms <= 150; ms++) {
        rig_advance(&rig, ms * STEPS_PER_MS);
        oz_contact_list_push_walls(&rig.now.contacts, one, 1);
        oz_contact_list_turn_walls(&rig.now.contacts, point, turn, 1);
        for (int k = 0; k < 3 && ms > 50; k++) {
            sum[k] += one[0][k] / (100 * rig.grains.mass[0] * 9.81);
        }
        moment += ms > 50 ? turn[0][0] / (100 * rig.grains.mass[0] * 9.81 * R) : 0;
    }
    memcpy(force, sum, sizeof sum);
    *torque = moment;
    rig_close(&rig);
}

/* What lies in a drum of 400 faces presses and brakes it as in a round one: its weight, and nothing
 * once it rolls. It hops over the edges, 64 a second, which samples see. */
static void a_meshed_drum_is_a_drum(void **state)
{
    (void)state;
    char mesh[256];
    double round[3], faced[3], round_torque, faced_torque;
    snprintf(mesh, sizeof mesh,
             "  - {kind: mesh, path: '%s', scale: 1e-3, motion: {angular_velocity: 1,"
             " axis: [1, 0, 0]}}\n",
             mesh_drum(400, 5));
    mean_push("  - {kind: cylinder, diameter: 10e-3, axis: [1, 0, 0],"
              " motion: {angular_velocity: 1}}\n",
              round, &round_torque);
    mean_push(mesh, faced, &faced_torque);
    assert_within(round[2], -1, 1e-3);
    for (int k = 0; k < 3; k++) {
        assert_within(faced[k], round[k], 1e-2);
    }
    assert_within(faced_torque, round_torque, 1e-2);
}

enum { STEPS = 200, LONG = 1000 };

/* Within the box's corners, and root of 3 times as far away in all. */
static void assert_held(const OzSnapshot *now)
{
    for (int64_t i = 0; i < now->count; i++) {
        const double *x = &now->position[3 * i];
        double from[] = {x[0], x[1], x[2] - 1e-3};
        assert_true(dot3(from, from) < 3 * 2.4e-3 * 2.4e-3);
    }
}

/* As in test_meshes: after 200 steps with hits rounding has grown a thousandfold; a wrong term
 * shows in the first digits. */
static void the_device_does_as_the_reference(void **state)
{
    (void)state;
    const char *box = mesh_of_text(mesh_box, "obj"), *inner = mesh_of_text(mesh_fence, "OBJ");
    const char *const precisions[] = {"double", "float"};
    const double tolerances[] = {1e-9, 1e-3};
    for (int k = 0; k < 2; k++) {
        Rig rig;
        OzDevice device = shaped_device(NATIVE);
        device.small_most = k ? OZ_DEVICE_SMALL_MOST : 0; /* in tiles, too */
        rig_open(&rig, mesh_crowd, precisions[k], box, inner);
        throw_grains(&rig.grains, 0.8, 20);
        OzSim *sim = start_sim(&rig, &device);
        OzSnapshot seen = state_at(&rig, sim, STEPS);
        rig_start(&rig);
        rig_advance(&rig, STEPS);
        assert_true(farthest(seen.velocity, rig.now.velocity, 3 * seen.count) < tolerances[k]);
        assert_true(farthest(seen.position, rig.now.position, 3 * seen.count) < tolerances[k]);
        assert_true(oz_contact_list_sum(&seen.contacts).walls > 5);
        assert_int_equal(oz_contact_list_sum(&seen.contacts).walls,
                         oz_contact_list_sum(&rig.now.contacts).walls);
        double work = rig.now.ledger.work_walls;
        assert_true(fabs(work) > 1e-9 &&
                    fabs(seen.ledger.work_walls - work) < 1e2 * tolerances[k] * fabs(work));
        oz_snapshot_free(&seen);
        seen = state_at(&rig, sim, LONG);
        assert_held(&seen);
        oz_snapshot_free(&seen);
        oz_sim_free(sim);
        rig_close(&rig);
    }
}

/* Rods in a box that tumbles about a slanted axis through its middle, with a plane in it that turns
 * about another one. Its corners are root of 3 times as far from there as its sides. */
static const char tumbler[] =
    "model: rods\nprecision: %s\ntime: {step: 1e-5, duration: 1}\nintegrator: velocity-verlet\n"
    "observe: {ledger: true}\n"
    "contact: {contact_time: 3e-4, restitution: 0.5, friction: 0.4}\ngrains:\n"
    "  - {kind: random, count: 50, diameter: 0.6e-3, aspect: 2, fill: 0.2}\n"
    "  - {kind: random, count: 20, diameter: 0.6e-3, fill: 0.2}\n"
    "walls:\n"
    "  - {kind: box, point: [1e-3, 0, 0], size: [5e-3, 5e-3, 5e-3],"
    " motion: {direction: [1, 0, 1], frequency: 200, amplitude: 1e-4, angular_velocity: 70,"
    " axis: [1, 2, -2], point: [1e-3, 0, 2.5e-3]}}\n"
    "  - {kind: plane, point: [1e-3, 0, -1e-3],"
    " motion: {angular_velocity: 9, axis: [0, 1, 0], point: [1e-3, 0, 2.5e-3], from: 1e-3,"
    " until: 5e-3}}\n";

static void boxes_tumble(void **state)
{
    (void)state;
    const char *const precisions[] = {"double", "float"};
    const double tolerances[] = {1e-9, 1e-3}; /* as above */
    for (int k = 0; k < 2; k++) {
        Rig rig;
        OzDevice device = shaped_device(NATIVE);
        rig_open(&rig, tumbler, precisions[k]);
        throw_grains(&rig.grains, 0.8, 20);
        OzSim *sim = start_sim(&rig, &device);
        OzSnapshot seen = state_at(&rig, sim, STEPS);
        rig_start(&rig);
        rig_advance(&rig, STEPS);
        assert_true(farthest(seen.velocity, rig.now.velocity, 3 * seen.count) < tolerances[k]);
        assert_true(farthest(seen.position, rig.now.position, 3 * seen.count) < tolerances[k]);
        assert_true(oz_contact_list_sum(&seen.contacts).walls > 5);
        assert_int_equal(oz_contact_list_sum(&seen.contacts).walls,
                         oz_contact_list_sum(&rig.now.contacts).walls);
        double work = rig.now.ledger.work_walls;
        assert_true(fabs(work) > 1e-9 &&
                    fabs(seen.ledger.work_walls - work) < 1e2 * tolerances[k] * fabs(work));
        oz_snapshot_free(&seen);
        seen = state_at(&rig, sim, 10 * LONG); /* seven radians */
        for (int64_t i = 0; i < seen.count; i++) {
            const double *x = &seen.position[3 * i];
            double from[] = {x[0] - 1e-3, x[1], x[2] - 2.5e-3};
            assert_true(dot3(from, from) < 3 * 2.6e-3 * 2.6e-3);
        }
        oz_snapshot_free(&seen);
        oz_sim_free(sim);
        rig_close(&rig);
    }
}

/* What stands at the outer side of a box that turns slowly goes round with it, pressed by its
 * centrifugal force; in the frame of the box it is at rest but for what it sinks in at first, of
 * which a restitution of 0.3 leaves nothing after 50 ms. */
static void a_sphere_rests_in_a_turning_box(void **state)
{
    (void)state;
    Rig rig;
    const double w = 20, half = 6e-3, x = half - R;
    double force[1][3];
    rig_open(&rig, ONE, "double", 0.0, 0.5, x, 0.0, 0.0, 0.0, w * x,
             "  - {kind: box, point: [0, 0, -4e-3], size: [12e-3, 12e-3, 8e-3],"
             " motion: {angular_velocity: 20, axis: [0, 0, 3]}}\n");
    rig.grains.angular_velocity[2] = w;
    rig_start(&rig);
    rig_advance(&rig, 50 * STEPS_PER_MS);
    double angle = w * rig.now.time, c = cos(angle), s = sin(angle);
    double push = rig.grains.mass[0] * w * w * x;
    assert_within(rig.now.position[0], x * c, 1e-4 * R); /* overlap: 2 m/s^2 (2e-4 s / pi)^2 */
    assert_within(rig.now.position[1], x * s, 1e-4 * R);
    assert_within(rig.now.angular_velocity[2], w, 1e-4 * w);
    oz_contact_list_push_walls(&rig.now.contacts, force, 1);
    assert_within(force[0][0], push * c, 1e-4 * push);
    assert_within(force[0][1], push * s, 1e-4 * push);
    rig_close(&rig);
}

/* The angle is a function of time: the same bits as without a stop, across a start, too. */
static void expect_same_bits(const char *text)
{
    Rig rig;
    OzState saved = {0};
    OzDevice device = shaped_device(NATIVE);
    const char *box = mesh_of_text(mesh_box, "obj"), *inner = mesh_of_text(mesh_fence, "obj");
    rig_open(&rig, text, "float", box, inner);
    throw_grains(&rig.grains, 0.8, 20);
    OzSim *sim = start_sim(&rig, &device), *next = start_sim(&rig, &device);
    must(oz_sim_advance(sim, STEPS / 4));
    OzStateVisit save = oz_state_save(&saved), load = oz_state_load(&saved);
    must(oz_sim_state_visit(sim, &save));
    must(oz_sim_state_visit(next, &load));
    OzSnapshot one = state_at(&rig, sim, 3 * STEPS), two = state_at(&rig, next, 3 * STEPS);
    assert_same_bits(&one, &two);
    oz_snapshot_free(&one);
    oz_snapshot_free(&two);
    oz_sim_free(next);
    oz_sim_free(sim);
    oz_state_free(&saved);
    rig_close(&rig);
}

static void runs_go_on_from_states(void **state)
{
    (void)state;
    expect_same_bits(mesh_crowd);
    expect_same_bits(tumbler);
}

/* What is exported stands where the walls stand: a quarter of a turn after the start the plate's
 * far edge is as far along y as it was along x, and a box as wide as it was deep. */
static void surfaces_are_where_walls_are(void **state)
{
    (void)state;
    const char *plate = mesh_of_text("v -5 0 -2\nv 5 0 -2\nv 5 0 2\nv -5 0 2\nf 4 3 2 1\n", "obj");
    char walls[512];
    Rig rig;
    OzSurface surface = {0};
    double far[3][3] = {{0}};
    snprintf(walls, sizeof walls,
             "  - {kind: mesh, path: '%s', scale: 1e-3, point: [5e-3, 0, 0],"
             " motion: {angular_velocity: 50, point: [0, 0, 0]}}\n"
             "  - {kind: rectangle, point: [5e-3, 0, 0], normal: [0, 1, 0], size: [10e-3, 4e-3],"
             " motion: {angular_velocity: 50, point: [0, 0, 0]}}\n"
             "  - {kind: box, point: [7e-3, 0, 0], size: [6e-3, 4e-3, 2],"
             " motion: {angular_velocity: 50, point: [0, 0, 0]}}\n",
             plate);
    rig_open(&rig, ONE, "double", 0.0, 0.0, 7e-3, 0.0, 1.0, 0.0, 0.0, walls);
    rig_start(&rig);
    rig.now.time = 3.14159265358979323846 / 100;
    oz_snapshot_move_walls(&rig.now);
    must(oz_surface_add_walls(&surface, &rig.now));
    for (int64_t cell = 0, c = 0; cell < surface.cell_count; cell++) {
        for (; c < surface.ends[cell]; c++) {
            for (int k = 0; k < 3; k++) {
                double x = (double)surface.points[3 * surface.corners[c] + k];
                far[surface.owner[cell]][k] = fmax(far[surface.owner[cell]][k], x);
            }
        }
    }
    for (int w = 0; w < 3; w++) {
        assert_within(far[w][0], w == 2 ? 2e-3 : 0, 1e-9);
        assert_within(far[w][1], 10e-3, 1e-9);
    }
    assert_within(far[2][2], 2, 1e-6); /* its point is at its bottom */
    oz_surface_free(&surface);
    rig_close(&rig);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_paddle_sweeps_a_sphere),
        cmocka_unit_test(a_paddle_stops),
        cmocka_unit_test(a_drum_starts_and_stops),
        cmocka_unit_test(a_turntable_is_a_turntable),
        cmocka_unit_test(a_meshed_drum_is_a_drum),
        cmocka_unit_test(the_device_does_as_the_reference),
        cmocka_unit_test(boxes_tumble),
        cmocka_unit_test(a_sphere_rests_in_a_turning_box),
        cmocka_unit_test(runs_go_on_from_states),
        cmocka_unit_test(surfaces_are_where_walls_are),
    };
    return cmocka_run_group_tests(tests, open_rig_device, close_rig_device);
}
