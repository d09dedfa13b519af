/* Figures of a sweep: what a column came to, against the value swept, mean over seeds, with a
 * constant and a power fitted to it. */
#pragma once

#include "figures/figure_work.h"

/* Of the figure's first run and column writes NAME.csv (value, members, mean, spread, ci95, bar),
 * NAME_fit.csv, NAME.png, NAME.svg and NAME.pdf. */
OzStatus oz_swept_draw(const OzFigureWork *work);
