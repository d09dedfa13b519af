/* `orzo plot`. */
#pragma once

#include "cli.h"

/* Writes plot.png and plot.svg (plot/plot.h) into the run's folder, or into -o. */
OzStatus oz_plot_folder_run(const OzOptions *options);
