/* `orzo plot`: columns of a run's series.csv as curves, one above the other; of an ensemble the
 * mean of its members with its 95 % interval, and every member thin behind it. */
#pragma once

#include "cli.h"

/* Writes plot.png and plot.svg into the run's folder, or into -o. */
OzStatus oz_plot_folder_run(const OzOptions *options);
