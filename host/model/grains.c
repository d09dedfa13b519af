/* Grain arrays, and the shape, mass and orientation of one spherocylinder. Knows nothing of where
 * grains lie or of how they move. */
#include "model/grains.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

OzStatus oz_grains_create(OzGrains *grains, int64_t count)
{
    OzStatus status = OZ_OK;
    memset(grains, 0, sizeof *grains);
    grains->count = count;
    OZ_TRY(OZ_NEW(&grains->diameter, count));
    OZ_TRY(OZ_NEW(&grains->length, count));
    OZ_TRY(OZ_NEW(&grains->mass, count));
    OZ_TRY(OZ_NEW(&grains->inertia, count));
    OZ_TRY(OZ_NEW(&grains->inertia_axis, count));
    OZ_TRY(OZ_NEW(&grains->population, count));
    OZ_TRY(OZ_NEW(&grains->position, 3 * count));
    OZ_TRY(OZ_NEW(&grains->quaternion, 4 * count));
    OZ_TRY(OZ_NEW(&grains->velocity, 3 * count));
    OZ_TRY(OZ_NEW(&grains->angular_velocity, 3 * count));
done:
    if (status != OZ_OK) {
        oz_grains_free(grains);
    }
    return status;
}

void oz_grains_free(OzGrains *grains)
{
    free(grains->diameter);
    free(grains->length);
    free(grains->mass);
    free(grains->inertia);
    free(grains->inertia_axis);
    free(grains->population);
    free(grains->position);
    free(grains->quaternion);
    free(grains->velocity);
    free(grains->angular_velocity);
    oz_elements_free(grains->elements);
    memset(grains, 0, sizeof *grains);
}

void oz_grains_set_mass(OzGrains *grains, int64_t i, double density)
{
    double d = grains->diameter[i]; /* m */
    double L = grains->length[i];   /* m */
    double d2 = d * d, d3 = d2 * d, d4 = d2 * d2, d5 = d4 * d;
    grains->mass[i] = density * oz_grains_volume(d, L);
    grains->inertia[i] =
        density * pi * (d2 * L * L * L / 48 + 3 * d4 * L / 64 + d5 / 60 + d3 * L * L / 24);
    grains->inertia_axis[i] = density * pi * (d4 * L / 32 + d5 / 60);
}

void oz_grains_axis(const double quaternion[4], double axis[3])
{
    double w = quaternion[0], x = quaternion[1], y = quaternion[2], z = quaternion[3];
    axis[0] = 2 * (x * z + w * y);
    axis[1] = 2 * (y * z - w * x);
    axis[2] = w * w - x * x - y * y + z * z;
}

/* The shortest turn from +z for the upper hemisphere; for the lower one half a revolution about x
 * followed by the shortest turn from -z, so that w never cancels. */
void oz_grains_quaternion(const double axis[3], double quaternion[4])
{
    double x = axis[0], y = axis[1];
    double w = sqrt(0.5 * (1 + fabs(axis[2])));
    if (axis[2] >= 0) {
        quaternion[0] = w;
        quaternion[1] = -0.5 * y / w;
        quaternion[2] = 0.5 * x / w;
        quaternion[3] = 0;
    } else {
        quaternion[0] = -0.5 * y / w;
        quaternion[1] = w;
        quaternion[2] = 0;
        quaternion[3] = 0.5 * x / w;
    }
}

double oz_grains_volume(double diameter, double length)
{
    return pi * diameter * diameter * (length / 4 + diameter / 6);
}

OzStatus oz_grains_check_memory(const char *scene_path, int64_t count)
{
    /* Bytes at the least: its start 200, a snapshot 300, packed 300; on a CPU device, in the same
     * memory, 700. */
    const double grain = 1500;
    double most = oz_memory_most(), needed = grain * (double)count;
    if (needed <= most) {
        return OZ_OK;
    }
    return oz_status_fail(OZ_ERR_INPUT,
                          "%s: %lld grains need at least %.3g GB of memory, and there are %.3g; "
                          "expected at most %.3g grains",
                          scene_path, (long long)count, needed / 1e9, most / 1e9, most / grain);
}
