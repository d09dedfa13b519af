/* A bed written by hand for tests of what looks at snapshots: a cylinder of 8 mm on a floor at
 * z = 1 mm, and any number of equal grains. */
#ifndef TESTS_HAND_BED_H
#define TESTS_HAND_BED_H

#include "hand_folder.h"

#include "base/random.h"
#include "model/snapshot.h"

typedef struct Bed {
    OzWall walls[2];
    OzScene scene;
    OzGrains grains;
    OzSnapshot snapshot;
} Bed;

static inline void bed_create(Bed *bed, int64_t count, double diameter, double length)
{
    memset(bed, 0, sizeof *bed);
    bed->walls[0] = (OzWall){.kind = OZ_WALL_PLANE, .point = {0, 0, 1e-3}, .normal = {0, 0, 1}};
    bed->walls[1] = (OzWall){.kind = OZ_WALL_CYLINDER, .diameter = 8e-3};
    bed->scene.walls = bed->walls;
    bed->scene.wall_count = 2;
    bed->scene.gravity[2] = -9.81;
    bed->scene.observe = (OzObserve){.samples_per_tap = 2, .layer_thickness = 4e-3};
    assert_int_equal(oz_grains_create(&bed->grains, count), OZ_OK);
    for (int64_t i = 0; i < count; i++) {
        bed->grains.diameter[i] = diameter;
        bed->grains.length[i] = length;
        oz_grains_set_mass(&bed->grains, i, 2500);
    }
    assert_int_equal(oz_snapshot_create(&bed->snapshot, &bed->scene, &bed->grains), OZ_OK);
}

static inline void bed_free(Bed *bed)
{
    oz_snapshot_free(&bed->snapshot);
    oz_grains_free(&bed->grains);
}

static inline void put(Bed *bed, int64_t i, double z, double ux, double uy, double uz)
{
    double *axis = &bed->snapshot.axis[3 * i];
    bed->snapshot.position[3 * i + 2] = z;
    axis[0] = ux, axis[1] = uy, axis[2] = uz;
    oz_grains_quaternion(axis, &bed->snapshot.quaternion[4 * i]);
}

static inline void fill_randomly(Bed *bed)
{
    OzRandom random = oz_random_stream(11, 0);
    for (int64_t i = 0; i < bed->grains.count; i++) {
        double axis[3];
        oz_random_direction(&random, axis);
        put(bed, i, 0, axis[0], axis[1], axis[2]);
        oz_grains_axis(&bed->snapshot.quaternion[4 * i], &bed->snapshot.axis[3 * i]);
        for (int k = 0; k < 3; k++) {
            bed->snapshot.position[3 * i + k] = oz_random_uniform(&random, 0, 0.02);
            bed->snapshot.velocity[3 * i + k] = oz_random_uniform(&random, -1, 1);
            bed->snapshot.angular_velocity[3 * i + k] = oz_random_uniform(&random, -100, 100);
        }
    }
}

#endif
