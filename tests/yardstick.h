/* The yardstick that orzo's speed is compared with: experiment an6 of Pournin et al. (2005) in
 * plain C, single precision, for one core. It uses nothing of orzo, so that nothing can slow both.
 * This is what its timed part (yardstick.c, yardstick_contact.h) and its runner (yardstick_run.c)
 * share. SI units. */
#ifndef OZ_TESTS_YARDSTICK_H
#define OZ_TESTS_YARDSTICK_H

#define OZ_YARDSTICK_DIAMETER 0.523e-3F
#define OZ_YARDSTICK_HALF     (2 * OZ_YARDSTICK_DIAMETER) /* of a shaft, from middle to end */
#define OZ_YARDSTICK_MASS     1.310816e-6F                /* kg, at 2500 kg/m^3 */
#define OZ_YARDSTICK_STEP     2e-5F

typedef struct OzVec {
    float x, y, z;
} OzVec;

/* The caller sets place, shaft (half of it), velocity and spin, all in the world frame. */
typedef struct OzRod {
    OzVec place, shaft, velocity, spin, force, torque;
    float path; /* bound on its points' ways since the list was built, the mean motion taken off */
    int cell;
    unsigned walls; /* a bit for each wall contact that touches */
} OzRod;

typedef struct OzYardstickWork {
    long steps, rebuilds, contacts;
} OzYardstickWork;

/* Room for so many rods, zeroed, to be filled before the first step, which sorts them in space;
 * NULL without memory. The room lives as long as the program. container: the cylinder's diameter,
 * m; skin in m, at most 1.5 diameters, for which the list has room. */
OzRod *oz_yardstick_start(int count, double container, double skin);

/* One step, added to work. The floor, at height 0 for phase 0, shakes at 30 Hz with that
 * acceleration over gravity; velocities are multiplied by damping. */
void oz_yardstick_step(OzYardstickWork *work, double phase, double acceleration_ratio,
                       float damping);

#endif
