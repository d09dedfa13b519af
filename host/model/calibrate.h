/* Contact constants that make up for the errors of the step (`restitution_calibration: discrete`):
 * the discrete map of a hit (predict.h) is inverted, so that an isolated central hit of two grains
 * returns the restitution asked although the step is coarse. */
#pragma once

#include "model/contact.h"

/* The constants of a scene's contact as the simulation uses them; without calibration those of
 * contact.h. A calibrated hit lasts a whole number of steps, the nearest to its contact time (the
 * scene's step is fitted to the scene's own; a wall's contact time is rounded). The Eulers with
 * `damping: constant`, `attraction: allow`: closed forms, exact at every phase of first touch.
 * velocity-verlet likewise but for its third eigenvalue: the restitution's mean over the phases is
 * exact, and single hits scatter about it. `smooth` and `clamp`: the stiffness stays that of the
 * continuous law and the damping is what gives the mean over the phases. Where no damping does (too
 * few steps), the continuous constants are returned. */
OzContactConstants oz_calibrate_contact(const OzScene *scene, const OzContactValues *values);

typedef enum OzCalibrated {
    OZ_CALIBRATED_NOT,         /* continuous: not asked for, or no law with a contact time    */
    OZ_CALIBRATED_EXACTLY,     /* every hit of two centres returns what was asked             */
    OZ_CALIBRATED_IN_THE_MEAN, /* their mean over the phases of first touch does              */
    OZ_CALIBRATED_IN_VAIN      /* asked for and not found: the continuous constants           */
} OzCalibrated;

/* What became of the calibration of these values. */
OzCalibrated oz_calibrate_outcome(const OzScene *scene, const OzContactValues *values);

/* A warning in the log for each of the scene's contacts that was calibrated in vain. */
void oz_calibrate_say(const OzScene *scene);
