/* Columns of a run's series.csv as curves, one above the other; of an ensemble the mean of its
 * members with its 95 % interval, and every member thin behind it. gnuplot draws. */
#pragma once

#include "base/status.h"

enum { OZ_PLOT_COLUMNS = 64 };

/* All borrowed. */
typedef struct OzPlot {
    const char *folder;         /* of the run                                                  */
    const char *out;            /* where pictures go; NULL: into the run's folder              */
    const char *const *columns; /* names, at most OZ_PLOT_COLUMNS; NULL: the usual ones that have
                                 * values                                                      */
    int count;
    const char *against; /* step, time or tap; NULL: taps where there are any */
} OzPlot;

/* Writes plot.png and plot.svg. Without gnuplot the log says so. Fails with OZ_ERR_INPUT for what is
 * no column with values, and with OZ_ERR_FILE. */
OzStatus oz_plot_draw(const OzPlot *plot);

/* A run's last picture: series.png, where there are usual columns with values in three rows or more,
 * and gnuplot. */
OzStatus oz_plot_series(const char *folder);
