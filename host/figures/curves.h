/* Figures of curves: columns of series.csv against tap or time, mean over seeds with a band of
 * their standard deviation to either side, in one panel, one for each run or one for each column.
 */
#pragma once

#include "figures/figure_work.h"

/* Writes NAME.csv, NAME.png, NAME.svg and NAME.pdf; of an inset NAME_inset.csv too. */
OzStatus oz_curves_draw(const OzFigureWork *work);
