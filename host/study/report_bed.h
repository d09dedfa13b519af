/* How stiff a bed is as a whole: the fastest swing of all its contacts together, rotation and
 * sticking tangential springs included. A grain held by many neighbours, or by its end, swings
 * faster than any pair of centres, so that the bed's largest stable step is smaller than that of
 * `orzo check`'s rows. */
#ifndef OZ_STUDY_REPORT_BED_H
#define OZ_STUDY_REPORT_BED_H

#include "observe/snapshot.h"

typedef struct OzBedStiffness {
    int64_t contacts;    /* pairs and wall ends that touch                                     */
    double stiffness;    /* 1/s^2, largest eigenvalue of the linearised force per mass         */
    double damping;      /* 1/s, of the dashpots in that swing                                 */
    double largest_step; /* s, stable below it with the scene's integrator; INFINITY: no contact */
} OzBedStiffness;

/* Power iterations on the contacts of a snapshot, each at its closest points, every tangential
 * spring taken as sticking. Time grows with the square of the number of grains: fails with
 * OZ_ERR_INPUT above 20000. */
OzStatus oz_report_bed_measure(OzBedStiffness *bed, const OzSnapshot *now);

/* `orzo report --stability`: settles the scene, and prints its stiffness beside that of its
 * contacts. */
OzStatus oz_report_bed_say(const char *path, char *const *settings, int setting_count,
                           const char *device, int threads, const char *source_dir);

#endif
