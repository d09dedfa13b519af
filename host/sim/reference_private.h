/* What the reference's own files know of it. For .c files alone. */
#pragma once

#include "model/step_clock.h"
#include "sim/dialect.h"
#include "sim/host_mesh.h"
#include "sim/ledger.h"
#include "sim/pair_list.h"
#include "sim/reference.h"

#include "kernels/servo_move.h"

struct OzReference {
    const OzScene *scene;
    const OzGrains *grains;
    OzPhysics physics;
    int64_t step;
    OzStepClock clock;
    OzBoundary cell; /* as it stands at the bodies' places, which are those in the lattice of
                        all its strain */
    bool primed;     /* the forces of step 0 are known (velocity-verlet) */
    int count;
    OzShape *shape;
    OzBody *body;
    OzGrain *seen; /* as the forces of this step see them */
    OzLoad *load;
    double *position, *axis; /* 3 x count each, of body */
    OzPairList near;
    OzPairForce *pair_force; /* of each pair of near             */
    OzWallForce *wall_force; /* count x physics.touches          */
    OzMemory *wall_memory;   /* count x physics.touches          */
    double *mesh_memory;     /* count x physics.meshes x slots x words (kernels/wall_shape.h) */
    int crowded;             /* a grain that touches a mesh in too many places; -1: none       */
    OzWallDrive wall_drive[OZ_WALLS_MAX]; /* when the forces act          */
    OzServoState servo[OZ_SERVOS_MAX];
    OzWork work;
    int64_t deep_count; /* contacts beyond guards.overlap.warn, each counted once a step */
};

static inline OzVec3 oz_reference_axis(const OzReference *r, int i)
{
    return oz_quaternion_axis(r->body[i].turn);
}

static inline OzGrain oz_reference_grain(const OzReference *r, int i, OzVec3 velocity, OzVec3 spin)
{
    OzVec3 u = oz_reference_axis(r, i);
    OzGrain grain = {.position = r->body[i].position,
                     .half_shaft = oz_scale(u, r->shape[i].half_length),
                     .velocity = velocity,
                     .rate = oz_body_rate(spin, u, r->shape[i]),
                     .radius = r->shape[i].radius,
                     .mass = r->shape[i].mass,
                     .inverse_inertia = r->shape[i].inverse_inertia};
    return grain;
}

static inline OzGrain oz_reference_now(const OzReference *r, int i)
{
    return oz_reference_grain(r, i, r->body[i].velocity, r->body[i].spin);
}

/* Differences of the bodies' places. */
static inline OzSpace oz_reference_space(const OzReference *r)
{
    return oz_dialect_sheared(&r->physics, r->cell.strain, r->cell.shear_rate);
}
