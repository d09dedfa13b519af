/* Calls of liborzo as a program makes them, one after the other; exit status 0: all came out. The
 * scene is tests/run_bed.h's: 30 rods, taps of 0.02 s of which it makes two. */
#include <math.h>
#include <orzo.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ROOM = 30 * 3 };

#define EXPECT(what)                                                                               \
    do {                                                                                           \
        if (!(what)) {                                                                             \
            fprintf(stderr, "%s:%d: %s; \"%s\"\n", __FILE__, __LINE__, #what, orzo_error());       \
            exit(1);                                                                               \
        }                                                                                          \
    } while (0)

static const char *scene; /* path */

static OrzoSim *open_scene(void)
{
    OrzoSim *sim = NULL;
    EXPECT(orzo_open(&sim, scene) == ORZO_OK);
    return sim;
}

/* A simulation from its scene on, with a friction of its own. */
typedef struct Job {
    const char *friction;
    double place[ROOM];
} Job;

static void *simulate(void *of)
{
    Job *job = of;
    OrzoSim *sim = open_scene();
    EXPECT(orzo_set(sim, "contact.friction", job->friction) == ORZO_OK);
    for (int k = 1; k <= 8; k++) {
        EXPECT(orzo_run_to(sim, 0.004 * k) == ORZO_OK);
    }
    EXPECT(orzo_read(sim, ORZO_POSITION, job->place, ROOM) == ORZO_OK);
    orzo_close(sim);
    return NULL;
}

/* Two at once, a thread each: the bits of one after the other. */
static void test_threads(void)
{
    static Job together[2] = {{.friction = "0.5"}, {.friction = "0.2"}},
               alone[2] = {{.friction = "0.5"}, {.friction = "0.2"}};
    pthread_t threads[2];
    for (int k = 0; k < 2; k++) {
        EXPECT(pthread_create(&threads[k], NULL, simulate, &together[k]) == 0);
    }
    for (int k = 0; k < 2; k++) {
        EXPECT(pthread_join(threads[k], NULL) == 0);
        simulate(&alone[k]);
        EXPECT(memcmp(together[k].place, alone[k].place, sizeof alone[k].place) == 0);
    }
    EXPECT(memcmp(alone[0].place, alone[1].place, sizeof alone[0].place) != 0);
}

static void test_failures(void)
{
    OrzoSim *sim = NULL;
    double values[ROOM];
    EXPECT(orzo_open(&sim, "nowhere.yaml") == ORZO_ERR_INPUT && !sim);
    EXPECT(strstr(orzo_error(), "nowhere.yaml"));
    EXPECT(orzo_open_text(&sim, "model: rods\ntime: {step: -1}\n") == ORZO_ERR_INPUT && !sim);
    EXPECT(strstr(orzo_error(), "scene:2: time.step is -1; expected"));
    sim = open_scene();
    EXPECT(orzo_set(sim, "contact.frction", "1") == ORZO_ERR_INPUT);
    EXPECT(strstr(orzo_error(), "contact.frction"));
    EXPECT(orzo_set(sim, "contact.contact_time", "1e-9") == ORZO_OK);
    EXPECT(orzo_start(sim) == ORZO_ERR_INPUT && strstr(orzo_error(), "unstable"));
    EXPECT(orzo_set(sim, "contact.contact_time", "6e-4") == ORZO_OK);
    EXPECT(orzo_set_device(sim, "no such device", 0) == ORZO_OK);
    EXPECT(orzo_start(sim) == ORZO_ERR_INPUT && strstr(orzo_error(), "no such device"));
    EXPECT(orzo_set_device(sim, NULL, 0) == ORZO_OK);
    EXPECT(orzo_read(sim, ORZO_MASS, values, ROOM) == ORZO_ERR_INPUT);
    EXPECT(strstr(orzo_error(), "1 for each of 30 grains"));
    EXPECT(orzo_set_device(sim, "cpu", 0) == ORZO_ERR_INPUT);
    EXPECT(orzo_run_to(sim, 1) == ORZO_ERR_INPUT && strstr(orzo_error(), "scene's end, 0.04 s"));
    EXPECT(orzo_observe(sim, "nothing", values) == ORZO_ERR_INPUT);
    EXPECT(orzo_set(sim, "contact.friction", "-1") == ORZO_ERR_INPUT);
    EXPECT(orzo_set(sim, "seed", "3") == ORZO_ERR_INPUT && strstr(orzo_error(), "cannot change"));
    EXPECT(orzo_run_to(sim, 0.001) == ORZO_OK);
    orzo_close(sim);
}

/* Columns are series.csv's, contacts carry what these say, and a picture has something on it. */
static void test_looks(void)
{
    OrzoSim *sim = open_scene();
    OrzoContact contacts[200];
    double mean = 0, counted = 0, z[ROOM], axis[ROOM], offset, velocity;
    int64_t count = 0;
    int width, height;
    EXPECT(orzo_set(sim, "movie", "{size: [160, 120]}") == ORZO_OK);
    EXPECT(orzo_run_to(sim, 0.011) == ORZO_OK && fabs(orzo_time(sim) - 0.011) < 1e-9);
    EXPECT(orzo_step(sim) == 550 && orzo_step_length(sim) == 2e-5 && orzo_period(sim) == 0.02);
    EXPECT(orzo_contacts(sim, contacts, 200, &count) == ORZO_OK && count > 0 && count < 200);
    EXPECT(orzo_observe(sim, "contact_count", &counted) == ORZO_OK && counted > 0);
    int between = 0;
    for (int64_t k = 0; k < count; k++) {
        const double *n = contacts[k].normal;
        EXPECT(fabs(n[0] * n[0] + n[1] * n[1] + n[2] * n[2] - 1) < 1e-6);
        between += contacts[k].b >= 0;
    }
    EXPECT(between >= counted);
    EXPECT(orzo_read(sim, ORZO_AXIS, axis, ROOM) == ORZO_OK);
    EXPECT(orzo_read(sim, ORZO_POSITION, z, ROOM) == ORZO_OK);
    EXPECT(orzo_wall(sim, 0, &offset, &velocity) == ORZO_OK);
    EXPECT(fabs(velocity - 2 * 9.81 / (100 * M_PI) * cos(100 * M_PI * 0.011)) < 1e-4);
    EXPECT(orzo_column(sim, orzo_column_count(sim)) == NULL);
    EXPECT(orzo_observe(sim, "angle", &mean) == ORZO_OK && mean > 0 && mean < 90);
    orzo_picture_size(sim, &width, &height);
    EXPECT(width == 160 && height == 120);
    static uint8_t pixels[160 * 120 * 4];
    EXPECT(orzo_draw(sim, pixels, sizeof pixels) == ORZO_OK);
    int other = 0;
    for (size_t k = 4; k < sizeof pixels; k += 4) {
        other += memcmp(pixels + k, pixels, 4) != 0;
    }
    EXPECT(other > 1000);
    orzo_close(sim);
}

/* A state in a file, of which another simulation goes on, changed on the way: the same bits. */
static void test_states(void)
{
    OrzoSim *sim = open_scene(), *other = NULL;
    double whole[ROOM], resumed[ROOM], row[2];
    EXPECT(orzo_run_to(sim, 0.01) == ORZO_OK);
    EXPECT(orzo_set(sim, "contact.friction", "0.3") == ORZO_OK);
    EXPECT(orzo_set(sim, "walls.0.motion.frequency", "70") == ORZO_OK);
    EXPECT(orzo_run_to(sim, 0.013) == ORZO_OK && orzo_save(sim, "library.h5") == ORZO_OK);
    EXPECT(orzo_run_to(sim, 0.027) == ORZO_OK);
    EXPECT(orzo_read(sim, ORZO_POSITION, whole, ROOM) == ORZO_OK);
    EXPECT(orzo_load(&other, scene) == ORZO_ERR_INPUT &&
           strstr(orzo_error(), "expected a state of orzo"));
    EXPECT(orzo_load(&other, "library.h5") == ORZO_OK);
    EXPECT(orzo_run_to(other, 0.027) == ORZO_OK);
    EXPECT(orzo_read(other, ORZO_POSITION, resumed, ROOM) == ORZO_OK);
    EXPECT(memcmp(whole, resumed, sizeof whole) == 0);
    EXPECT(orzo_observe(sim, "density_tap_mean", &row[0]) == ORZO_OK);
    EXPECT(orzo_observe(other, "density_tap_mean", &row[1]) == ORZO_OK);
    EXPECT(row[0] == row[1] && row[0] > 0);
    orzo_close(sim);
    orzo_close(other);
}

/* A sphere (1 mm, 2500 kg/m^3) that a force pushes and a torque turns from rest, far from all else;
 * its neighbour stays. Places are exact to rounding: velocity-verlet is under a constant force. A
 * state in between changes no bit. */
static void test_forces(void)
{
    static const char text[] =
        "model: rods\n"
        "time: {step: 2e-5, duration: 1}\n"
        "gravity: [0, 0, 0]\n"
        "contact: {contact_time: 6e-4, restitution: 0.5}\n"
        "integrator: velocity-verlet\n"
        "precision: double\n"
        "grains:\n"
        "  - {kind: single, diameter: 1e-3, aspect: 0, position: [0, 0, 0]}\n"
        "  - {kind: single, diameter: 1e-3, aspect: 0, position: [1, 0, 0]}\n";
    OrzoSim *sim = NULL, *other = NULL;
    double place[6], spin[6], resumed[6], mass[2], t = 0.1, m, inertia;
    int64_t second = 1, third = 2;
    const double force[3] = {1e-6, 0, -2e-6}, torque[3] = {0, 3e-12, 0};
    EXPECT(orzo_open_text(&sim, text) == ORZO_OK);
    EXPECT(orzo_push(sim, &third, 1, force, torque) == ORZO_ERR_INPUT);
    EXPECT(orzo_push(sim, &second, 1, force, torque) == ORZO_OK);
    EXPECT(orzo_run_to(sim, t / 2) == ORZO_OK && orzo_save(sim, "pushed.h5") == ORZO_OK);
    EXPECT(orzo_run_to(sim, t) == ORZO_OK);
    EXPECT(orzo_read(sim, ORZO_POSITION, place, 6) == ORZO_OK);
    EXPECT(orzo_read(sim, ORZO_ANGULAR_VELOCITY, spin, 6) == ORZO_OK);
    EXPECT(orzo_read(sim, ORZO_MASS, mass, 2) == ORZO_OK);
    m = mass[1];
    inertia = 0.4 * m * 0.5e-3 * 0.5e-3;
    EXPECT(place[0] == 0 && place[1] == 0 && place[2] == 0 && spin[1] == 0);
    EXPECT(fabs((place[3] - 1) / (force[0] * t * t / (2 * m)) - 1) < 1e-9);
    EXPECT(fabs(place[5] / (force[2] * t * t / (2 * m)) - 1) < 1e-9);
    EXPECT(fabs(spin[4] / (torque[1] * t / inertia) - 1) < 1e-9);
    EXPECT(orzo_load(&other, "pushed.h5") == ORZO_OK && orzo_run_to(other, t) == ORZO_OK);
    EXPECT(orzo_read(other, ORZO_POSITION, resumed, 6) == ORZO_OK);
    EXPECT(memcmp(place, resumed, sizeof place) == 0);
    EXPECT(orzo_push(sim, &second, 1, NULL, NULL) == ORZO_OK &&
           orzo_run_steps(sim, 100) == ORZO_OK);
    orzo_close(sim);
    orzo_close(other);
}

/* The floor driven from outside: it goes on from where it was, and grains with it. */
static void test_walls(void)
{
    OrzoSim *sim = open_scene(), *other = NULL;
    double before, offset, speed, place[ROOM], resumed[ROOM];
    EXPECT(orzo_run_to(sim, 0.003) == ORZO_OK);
    EXPECT(orzo_wall(sim, 0, &before, &speed) == ORZO_OK);
    EXPECT(orzo_drive_wall(sim, 1, 0.1) == ORZO_ERR_INPUT &&
           orzo_drive_wall(sim, 7, 0.1) != ORZO_OK);
    EXPECT(orzo_drive_wall(sim, 0, 0.05) == ORZO_OK);
    EXPECT(orzo_run_to(sim, 0.013) == ORZO_OK && orzo_save(sim, "driven.h5") == ORZO_OK);
    EXPECT(orzo_run_to(sim, 0.033) == ORZO_OK);
    EXPECT(orzo_wall(sim, 0, &offset, &speed) == ORZO_OK && speed == 0.05);
    EXPECT(fabs(offset - before - 0.05 * 0.03) < 1e-12);
    EXPECT(orzo_read(sim, ORZO_POSITION, place, ROOM) == ORZO_OK);
    for (int i = 0; i < ROOM; i += 3) {
        EXPECT(place[i + 2] > offset);
    }
    EXPECT(orzo_load(&other, "driven.h5") == ORZO_OK && orzo_run_to(other, 0.033) == ORZO_OK);
    EXPECT(orzo_read(other, ORZO_POSITION, resumed, ROOM) == ORZO_OK);
    EXPECT(memcmp(place, resumed, sizeof place) == 0);
    orzo_close(sim);
    orzo_close(other);
}

int main(int argc, char **argv)
{
    EXPECT(argc == 2);
    scene = argv[1];
    test_threads();
    test_failures();
    test_looks();
    test_states();
    test_forces();
    test_walls();
    return 0;
}
