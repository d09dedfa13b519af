/* `orzo report --stability`, and the lines of `orzo check` about the bed: the stability of all its
 * contacts together (sim/stiffness.h). */
#pragma once

#include "report/rehearsal.h"

#include <stdio.h>

/* Prints the stiffness and the largest stable step of a rehearsed bed; one whose settling was cut
 * short is named so. Where its step is too large the log says so, as that of a run does. Prints
 * nothing for laws without a stiffness of their own and without grains. */
void oz_report_bed_print(FILE *file, const OzScene *scene, const OzRehearsal *rehearsal);

/* The same for a scene file, with all the time that settling takes. */
OzStatus oz_report_bed_say(const char *path, char *const *settings, int setting_count,
                           const char *device, int threads, const char *source_dir);
