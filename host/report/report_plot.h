/* The picture of a report: error against wall time and against force evaluations, drawn by gnuplot.
 */
#pragma once

#include "report/report_point.h"

/* Draws the points of one scene into folder/<scene>.png and .svg. Without gnuplot a line in the log
 * says so, and there is no picture. Fails with OZ_ERR_FILE when gnuplot does. */
OzStatus oz_report_plot_draw(const char *folder, const char *device, const OzReportPoint *points,
                             int count);
