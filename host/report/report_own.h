/* `orzo report SCENE` of a scene that no answer is known for: what can be said of any. How long
 * paths of grains can be compared at all, and what each integrator and step makes of them; whether
 * means over seeds depend on either; how stable the bed is. */
#pragma once

#include "report/report_means.h"

/* Prints the study, with one sentence of advice as its last line, and leaves paths.csv and the
 * runs of ensembles in folder/NAME. A scene of some hundred grains takes a few minutes, with
 * --quick less than one, and the building of kernels. */
OzStatus oz_report_own_study(const char *path, const char *folder, const OzOptions *options,
                             const OzDevice *device);

/* The cheapest setting whose path is right to `tolerance` (diameters) with a step of at most nine
 * tenths of the largest stable one; the most accurate where none is; NULL where none was measured.
 */
const OzReportPath *oz_report_own_choose(const OzReportPaths *paths, double tolerance);
