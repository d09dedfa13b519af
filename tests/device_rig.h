/* A scene of a test on the device, beside the host reference of rig.h. */
#ifndef OZ_TESTS_DEVICE_RIG_H
#define OZ_TESTS_DEVICE_RIG_H

#include "rig.h"

#include "base/random.h"
#include "sim/read_snapshot.h"
#include "sim/sim.h"

#include <stdlib.h>

/* How kernels are cut up: the device's own lanes, one lane, or one lane and work-items that share
 * the work, as on a GPU. */
typedef enum Shape { NATIVE, SCALAR, GROUP } Shape;

static OzDevice rig_device, large_device; /* the second takes every scene for a large one */

static inline int open_rig_device(void **state)
{
    (void)state;
    if (oz_device_open(&rig_device, NULL, 0) != OZ_OK) {
        print_error("%s\n", oz_status_text());
        return -1;
    }
    large_device = rig_device;
    large_device.small_most = 0;
    return 0;
}

static inline int close_rig_device(void **state)
{
    (void)state;
    oz_device_close(&rig_device);
    return 0;
}

static inline OzDevice shaped_device(Shape shape)
{
    OzDevice device = rig_device;
    if (shape != NATIVE) {
        device.float_lanes = 1;
        device.double_lanes = 1;
        device.group = shape == GROUP ? 8 : 1;
    }
    return device;
}

/* A simulation of the rig's scene and grains. The caller frees it; device must outlive it. */
static inline OzSim *start_sim(const Rig *rig, const OzDevice *device)
{
    OzSim *sim = NULL;
    OzMember member = {&rig->scene, &rig->grains};
    must(oz_sim_create(&sim, device, &member, 1, NULL));
    return sim;
}

/* The state at a step, contacts included; the caller frees the snapshot. */
static inline OzSnapshot state_at(const Rig *rig, OzSim *sim, int64_t step)
{
    OzSnapshot now;
    must(oz_sim_advance(sim, step));
    must(oz_snapshot_create(&now, &rig->scene, &rig->grains));
    must(oz_read_snapshot_snapshot(sim, 0, &now, true));
    return now;
}

/* The state at a step of a simulation made for this alone. */
static inline OzSnapshot state_after(const Rig *rig, Shape shape, int64_t step)
{
    OzDevice device = shaped_device(shape);
    OzSim *sim = start_sim(rig, &device);
    OzSnapshot now = state_at(rig, sim, step);
    oz_sim_free(sim);
    return now;
}

/* Throws every grain in a direction of its own. */
static inline void throw_grains(OzGrains *grains, double speed, double rate)
{
    OzRandom random = oz_random_stream(7, 0);
    for (int64_t i = 0; i < grains->count; i++) {
        oz_random_direction(&random, &grains->velocity[3 * i]);
        oz_random_direction(&random, &grains->angular_velocity[3 * i]);
        for (int c = 0; c < 3; c++) {
            grains->velocity[3 * i + c] *= speed;
            grains->angular_velocity[3 * i + c] *= rate;
        }
    }
}

/* The largest difference of any of so many numbers. */
static inline double farthest(const double *a, const double *b, int64_t count)
{
    double far = 0;
    for (int64_t i = 0; i < count; i++) {
        far = fmax(far, fabs(a[i] - b[i]));
    }
    return far;
}

static inline void assert_same_bits(const OzSnapshot *a, const OzSnapshot *b)
{
    size_t three = 3 * (size_t)a->count * sizeof(double);
    assert_memory_equal(a->position, b->position, three);
    assert_memory_equal(a->velocity, b->velocity, three);
    assert_memory_equal(a->angular_velocity, b->angular_velocity, three);
    assert_memory_equal(a->quaternion, b->quaternion, three / 3 * 4);
    assert_int_equal(a->contacts.count, b->contacts.count);
    for (int64_t i = 0; i < a->contacts.count; i++) {
        const OzContactEntry *x = &a->contacts.entry[i], *y = &b->contacts.entry[i];
        assert_true(x->a == y->a && x->b == y->b && x->slips == y->slips);
        assert_memory_equal(x->point, y->point, sizeof *x - offsetof(OzContactEntry, point));
    }
}

#endif
