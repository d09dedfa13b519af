/* `orzo report --stability`, and the lines of `orzo check` about the bed: the stability of all its
 * contacts together (compute/stiffness.h). */
#ifndef OZ_STUDY_REPORT_BED_H
#define OZ_STUDY_REPORT_BED_H

#include "compute/device.h"
#include "model/grains.h"

#include <stdio.h>

/* Settles the scene where it says so, for at most `patience` seconds of computing (a bed cut short
 * is measured as it is then, and named so), and prints its stiffness and largest stable step.
 * Where its step is too large the log says so, as that of a run does.
 * Prints nothing for laws without a stiffness of their own and without grains. */
OzStatus oz_report_bed_print(FILE *file, const OzScene *scene, const OzGrains *grains,
                             const OzDevice *device, const char *source_dir, double patience);

/* The same for a scene file, with all the time it takes. */
OzStatus oz_report_bed_say(const char *path, char *const *settings, int setting_count,
                           const char *device, int threads, const char *source_dir);

#endif
