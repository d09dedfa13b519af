/* Tables of where the time of a step goes, and of shares of contacts, beside a paper's numbers. */
#pragma once

#include "figures/figure_work.h"

/* Times the parts of a step of the figure's first run's scene, into folder/times, where that is not
 * there yet (bench/bench.h). To be called before this process opens a device: it makes a process of
 * its own that does. */
OzStatus oz_shares_measure(const OzFigureWork *work);

/* Writes NAME.csv and prints it: the figure's rows with the paper's numbers, %, and ours. A row's
 * part is a sum of parts of a step, or "mean COLUMN": the mean over the run of a share in
 * series.csv. */
OzStatus oz_shares_draw(const OzFigureWork *work);
