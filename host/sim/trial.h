/* How far the beams of a grain go when it hits something: the grain, alone and without gravity, is
 * thrown at a floor by the host's reference. Serves `orzo check` and what the guards say. */
#pragma once

#include "model/grains.h"

/* Beyond these, three quarters of the way to where the guards stop (kernels/element_law.h), beams
 * are called soft: a grain held between others may be bent by a third more than by a hit alone.
 * What is advised goes half the way. */
#define OZ_TRIAL_BEND_MOST       0.75  /* rad */
#define OZ_TRIAL_STRETCH_MOST    0.375 /* of the length at rest */
#define OZ_TRIAL_BEND_ADVISED    0.5
#define OZ_TRIAL_STRETCH_ADVISED 0.25

typedef struct OzTrial {
    int64_t grain;
    double speed;   /* m/s                                                          */
    double bend;    /* rad: the largest bending of a beam's end                     */
    double stretch; /* the largest change of a beam's length over that at rest      */
    double force;   /* N, the largest of the floor on the grain                     */
    bool deep;      /* contacts are softer than they may be even at a slower speed  */
} OzTrial;

/* A hit of a grain of the scene at a speed (m/s), the worst of eight orientations, from first touch
 * until its beams would have swung back. A hit that no guard would let pass is made slower, and its
 * figures are multiplied. Zeroes for a grain without beams. Takes some ten milliseconds. */
OzStatus oz_trial_hit(OzTrial *trial, const OzScene *scene, const OzGrains *grains, int64_t grain,
                      double speed);

/* The speed of the hits to be expected, m/s: of the fastest grain at the start, of a shaken wall,
 * and of a fall: from the highest grain to the lowest wall (of random grains half of it, by which
 * their column settles). */
double oz_trial_speed(const OzScene *scene, const OzGrains *grains);

/* The worst of the heaviest grain of each population at oz_trial_speed; grain -1 without beams. */
OzStatus oz_trial_worst(OzTrial *trial, const OzScene *scene, const OzGrains *grains);

/* The slowest hit, m/s, that breaks a beam of a grain whose scene says what its beams bear, in the
 * worst of eight orientations, to a tenth; 0 where a guard stops it first, or a thousand times
 * `speed` does not. Takes some tenths of a second. */
OzStatus oz_trial_break(double *slowest, const OzScene *scene, const OzGrains *grains,
                        int64_t grain, double speed);

/* One clause, as "beams are too soft ...", with the second moment or stiffness that would do; empty
 * where the trial is within the limits. Bending falls with the root of the second moment or faster,
 * stretch with that of the stiffness. */
void oz_trial_advise(char *text, size_t size, const OzTrial *trial, const OzScene *scene);
