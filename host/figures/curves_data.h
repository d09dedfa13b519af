/* The numbers in a figure of curves, as a table beside the picture:
 *
 *     run,step,AGAINST,members,COLUMN,COLUMN_spread,COLUMN_ci95,...
 *
 * COLUMN is the mean over a run's seeds, spread their standard deviation, ci95 half the 95 %
 * interval of the mean; both are empty of sums of columns and of one seed.
 * Where the figure is smoothed, all are means over its number of rows. */
#pragma once

#include "figures/figure_work.h"

/* Writes folder/NAME of the ensemble.csv of these runs. *has_spread: any run has two seeds or more.
 * Fails with OZ_ERR_INPUT for a column that a run has not. */
OzStatus oz_curves_data_write(const OzFigureWork *work, const char *name, const OzTexts *runs,
                              const OzTexts *columns, bool *has_spread);
