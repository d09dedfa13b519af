/* THE list of kinds of figures: X(name in a study, what measures before any run or NULL, what
 * draws). Both are functions of an OzFigureWork (figures/figure_work.h). To add one: these, a row
 * here and, of its keys, rows in figures/study.c that say under `of` which kinds know them. */
#pragma once

#define OZ_FIGURE_KINDS(X)                                                                         \
    X(curves, NULL, oz_curves_draw)                                                                \
    X(pictures, NULL, oz_sheet_draw)                                                               \
    X(sweep, NULL, oz_swept_draw)                                                                  \
    X(shares, oz_shares_measure, oz_shares_draw)
