/* How stiff a bed is as a whole: the fastest swing of all its contacts together, rotation and
 * sticking tangential springs included. A grain held by many neighbours, or by its end, swings
 * faster than any pair of centres, so that the bed's largest stable step is smaller than that of a
 * single contact (model/predict.h). */
#pragma once

#include "model/snapshot.h"

typedef struct OzStiffness {
    int64_t contacts;    /* pairs and wall ends that touch                                     */
    double stiffness;    /* 1/s^2, largest eigenvalue of the linearised force per mass         */
    double damping;      /* 1/s, of the dashpots in that swing                                 */
    double largest_step; /* s, stable below it with the scene's integrator; INFINITY: no contact */
} OzStiffness;

/* Whether contacts of the scene have a stiffness that does not depend on how deep they are. */
bool oz_stiffness_applies(const OzScene *scene);

/* Power iterations on the contacts of a snapshot, each at its closest points (a parallel pair at
 * one), every tangential spring taken as sticking; from below, within 1 %. A bed of 1000 rods takes
 * 0.05 s, larger ones in proportion. Only where oz_stiffness_applies. */
OzStatus oz_stiffness_measure(OzStiffness *stiffness, const OzSnapshot *now);

/* The same of one grain alone that lies at wall w, with both ends of its shaft (a sphere touches
 * once): the stiffest of them all, which is the longest or the shortest for its width. There must
 * be grains. Only where oz_stiffness_applies. */
OzStatus oz_stiffness_at_wall(OzStiffness *stiffness, const OzScene *scene, const OzGrains *grains,
                              int w);

/* One line in the log, with a warning where the scene's step is too large; none without contacts.
 */
void oz_stiffness_say(const OzStiffness *stiffness, const OzScene *scene);
