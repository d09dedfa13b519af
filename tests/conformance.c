/* Tiny scenes of both models on whatever OpenCL implementation the loader finds, each beside the
 * host reference: in double and float, cut up in every way, by the small path and the large one.
 * Run by tests/conformance.sh; no ctest. conformance            every shape conformance one-lane
 * without the device's own lanes: for a simulator, which has none and is slow */
#include "base/memory.h"
#include "model/insert.h"
#include "sim/element_reference.h"
#include "sim/read_snapshot.h"
#include "sim/reference.h"
#include "sim/sim.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define VESSEL                                                                                     \
    "gravity: [0.3, 0, -9.81]\n"                                                                   \
    "walls:\n"                                                                                     \
    "  - {kind: plane, motion: {frequency: 300, amplitude: 1e-4}}\n"                               \
    "  - {kind: cylinder, diameter: 3e-3, contact: {restitution: 0.6}}\n"
#define RODS "grains: [{kind: random, count: 9, diameter: 0.5e-3, aspect: 3, fill: 0.2}]\n"
#define MIXTURE                                                                                    \
    "grains:\n"                                                                                    \
    "  - {kind: random, count: 4, diameter: 0.6e-3, fill: 0.2}\n"                                  \
    "  - {kind: random, count: 5, diameter: [0.4e-3, 0.8e-3], aspect: [0.5, 3], fill: 0.2}\n"
#define DICE                                                                                       \
    "grains:\n"                                                                                    \
    "  - {kind: single, shape: square, edge: 2e-3, position: [0, 0], velocity: [0.5, 0], angle: "  \
    "30}\n"                                                                                        \
    "  - {kind: single, shape: square, edge: 2e-3, position: [2.2e-3, 0.3e-3], velocity: [0, "     \
    "-0.5], angle: 30}\n"                                                                          \
    "walls:\n"                                                                                     \
    "  - {kind: floor, width: 2e-2, point: [1e-3, -1.5e-3], motion: {frequency: 100, amplitude: "  \
    "1e-4}}\n"
#define DISCS                                                                                      \
    "contact: {law: hertz, hertz_stiffness: 1e5, normal_damping_rate: 100, "                       \
    "tangential_damping_rate: 100, friction: 0.5}\n"                                               \
    "grains:\n"                                                                                    \
    "  - {kind: single, shape: disc, radius: 1e-3, position: [0, 0], velocity: [0.5, 0]}\n"        \
    "  - {kind: single, shape: disc, radius: 1e-3, position: [2.1e-3, 0.3e-3], velocity: [-0.5, "  \
    "0]}\n"

/* Grains of rods are thrown, so that they meet within the steps. */
typedef struct Case {
    const char *name, *text;
    int steps;
    bool has_large_path;
} Case;

static const Case cases[] = {
    {"paper's rods",
     "model: rods\ntime: {step: 1e-5, duration: 1}\nobserve: {ledger: true}\nintegrator: euler\n"
     "contact: {contact_time: 3e-4, restitution: 0.5, friction: 0.2, "
     "contact_point: surfaces}\ngyroscopic: false\n" VESSEL RODS,
     150, true},
    {"mixture, other choices",
     "model: rods\ntime: {step: 1e-5, duration: 1}\nintegrator: velocity-verlet\n"
     "contact: {law: hertz-mindlin, youngs_modulus: 1e6, poisson_ratio: 0.3, restitution: 0.5, "
     "friction: 0.4, "
     "parallel: line}\n" VESSEL MIXTURE,
     150, true},
    {"dice",
     "model: trigrains\ngravity: [0, 0]\ntime: {step: 4e-6, duration: 1}\nintegrator: gear4\n"
     "observe: {ledger: true}\n" DICE,
     100, false},
    {"discs", "model: trigrains\ngravity: [0, 0]\ntime: {step: 4e-6, duration: 1}\n" DISCS, 60,
     false},
};

/* How kernels are cut up. */
static const struct {
    const char *name;
    int group; /* 0: the device's own lanes and group */
} shapes[] = {{"own lanes", 0}, {"1 lane", 1}, {"1 lane, 8 work-items", 8}};

typedef struct Bed {
    OzScene scene;
    OzGrains grains;
} Bed;

/* In the place of OpenCL's own, for the simulator Oclgrind takes words filled by that for words
 * that nobody wrote. */
cl_int clEnqueueFillBuffer(cl_command_queue queue, cl_mem buffer, const void *pattern,
                           size_t pattern_size, size_t offset, size_t size, cl_uint event_count,
                           const cl_event *events, cl_event *event)
{
    char *words = malloc(size);
    for (size_t at = 0; words && at + pattern_size <= size; at += pattern_size) {
        memcpy(words + at, pattern, pattern_size);
    }
    cl_int code = words ? clEnqueueWriteBuffer(queue, buffer, CL_TRUE, offset, size, words,
                                               event_count, events, event)
                        : CL_OUT_OF_HOST_MEMORY;
    free(words);
    return code;
}

static void must(OzStatus status)
{
    if (status != OZ_OK) {
        fprintf(stderr, "conformance: %s\n", oz_status_text());
        exit(1);
    }
}

static Bed open_bed(const Case *row, const char *precision)
{
    Bed bed = {0};
    char setting[40], *settings[] = {setting};
    snprintf(setting, sizeof setting, "precision=%s", precision);
    must(oz_scene_parse(&bed.scene, row->name, row->text, settings, 1));
    must(oz_insert_grains(&bed.grains, &bed.scene));
    for (int64_t i = 0; bed.scene.model == OZ_MODEL_RODS && i < bed.grains.count; i++) {
        for (int k = 0; k < 3; k++) {
            bed.grains.velocity[3 * i + k] = -100 * bed.grains.position[3 * i + k];
        }
    }
    return bed;
}

static void close_bed(Bed *bed)
{
    oz_grains_free(&bed->grains);
    oz_scene_free(&bed->scene);
}

static OzSnapshot by_reference(const Bed *bed, int steps)
{
    OzSnapshot now;
    must(oz_snapshot_create(&now, &bed->scene, &bed->grains));
    if (bed->scene.model == OZ_MODEL_RODS) {
        OzReference *reference = NULL;
        must(oz_reference_create(&reference, &bed->scene, &bed->grains));
        must(oz_reference_advance(reference, steps));
        must(oz_reference_snapshot(reference, &now));
        oz_reference_free(reference);
    } else {
        OzElementReference *reference = NULL;
        must(oz_element_reference_create(&reference, &bed->scene, &bed->grains));
        must(oz_element_reference_advance(reference, steps));
        must(oz_element_reference_snapshot(reference, &now));
        oz_element_reference_free(reference);
    }
    return now;
}

static OzSnapshot by_device(const Bed *bed, const OzDevice *device, int steps)
{
    OzSim *sim = NULL;
    OzSnapshot now;
    OzMember member = {&bed->scene, &bed->grains};
    must(oz_sim_create(&sim, device, &member, 1, NULL));
    must(oz_sim_advance(sim, steps));
    must(oz_snapshot_create(&now, &bed->scene, &bed->grains));
    must(oz_read_snapshot_snapshot(sim, 0, &now, true));
    oz_sim_free(sim);
    return now;
}

/* NaN is the largest gap of all. */
static double largest_gap(const double *a, const double *b, int64_t count)
{
    double gap = 0;
    for (int64_t i = 0; i < count; i++) {
        gap = fabs(a[i] - b[i]) <= gap ? gap : fabs(a[i] - b[i]);
    }
    return gap;
}

/* Of centres, m, and of their velocities, m/s. */
typedef struct Gap {
    double position, velocity;
} Gap;

static Gap compare(const OzSnapshot *a, const OzSnapshot *b, const Bed *bed)
{
    return bed->scene.model == OZ_MODEL_RODS
               ? (Gap){largest_gap(a->position, b->position, 3 * a->count),
                       largest_gap(a->velocity, b->velocity, 3 * a->count)}
               : (Gap){largest_gap(a->element_position, b->element_position, 2 * a->element_count),
                       largest_gap(a->element_velocity, b->element_velocity, 2 * a->element_count)};
}

/* Rounding of one step is 1e-19 m and 1e-16 m/s in double, 1e-10 m and 3e-8 m/s in float; some hits
 * and the fastest vibration (1e5/s of an element) make it ten thousand times larger. A wrong term
 * moves a grain by a tenth of its way, 1e-5 m, and changes velocities of 0.1 m/s in the first
 * digits. */
static bool is_close(Gap gap, bool wide)
{
    return gap.position < (wide ? 1e-13 : 1e-7) && gap.velocity < (wide ? 1e-10 : 3e-3);
}

/* One line; whether it is as it should be. */
static bool judge(const Case *row, const char *precision, const OzDevice *device, const char *how)
{
    Bed bed = open_bed(row, precision);
    OzSnapshot right = by_reference(&bed, row->steps);
    OzSnapshot got = by_device(&bed, device, row->steps);
    Gap gap = compare(&got, &right, &bed);
    bool good = is_close(gap, precision[0] == 'd');
    printf("%-24s %-8s %-32s %8.2g m %8.2g m/s  %s\n", row->name, precision, how, gap.position,
           gap.velocity, good ? "agrees" : "DIFFERS");
    fflush(stdout);
    oz_snapshot_free(&right);
    oz_snapshot_free(&got);
    close_bed(&bed);
    return good;
}

static bool judge_shape(const Case *row, OzDevice device, int shape)
{
    static const char *const precisions[] = {"double", "float"};
    bool good = true;
    if (shapes[shape].group > 0) {
        device.float_lanes = device.double_lanes = 1;
        device.group = shapes[shape].group;
    }
    for (int p = 0; p < 2; p++) {
        if (device.has_double || p == 1) {
            good = judge(row, precisions[p], &device, shapes[shape].name) && good;
        }
    }
    if (row->has_large_path) {
        char how[60];
        snprintf(how, sizeof how, "large, %s", shapes[shape].name);
        device.small_most = 0;
        good = judge(row, "float", &device, how) && good;
    }
    return good;
}

int main(int argc, char **argv)
{
    OzDevice device;
    bool good = true;
    int first = argc > 1 && strcmp(argv[1], "one-lane") == 0 ? 1 : 0;
    must(oz_device_open(&device, NULL, 0));
    printf("%s\n", device.name);
    for (size_t c = 0; c < sizeof cases / sizeof cases[0]; c++) {
        for (int s = first; s < (int)(sizeof shapes / sizeof shapes[0]); s++) {
            good = judge_shape(&cases[c], device, s) && good;
        }
    }
    oz_device_close(&device);
    return good ? 0 : 1;
}
