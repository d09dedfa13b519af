/* Figures of pictures: one row for each run and view, one column for each moment. */
#pragma once

#include "figures/figure_work.h"

/* Writes NAME.png and NAME.csv, which says what each picture shows and where it lies by itself. */
OzStatus oz_sheet_draw(const OzFigureWork *work);
