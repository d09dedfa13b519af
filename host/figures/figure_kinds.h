/* THE list of kinds of figures: X(name in a study, the function that draws one). To add one: such a
 * function, of an OzFigureWork (figures/figure_work.h), and a row here; its keys say in
 * figures/study.c under `of` that it knows them. */
#pragma once

#define OZ_FIGURE_KINDS(X) X(curves, oz_curves_draw)
