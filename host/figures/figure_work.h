/* What a kind of figure is given to draw with. */
#pragma once

#include "figures/study_runs.h"

enum { OZ_FIGURE_CAPTION = 1024 };

/* All borrowed. */
typedef struct OzFigureWork {
    const OzStudy *study;
    const OzStudyFigure *figure; /* its runs have ended */
    const char *folder;          /* of the study        */
    const OzOptions *options;    /* of `orzo figures`   */
    const char *caption;         /* seeds and steps behind it */
} OzFigureWork;

/* The study's run that a figure names. */
const OzStudyRun *oz_figure_work_run(const OzFigureWork *work, const char *name);

/* The seeds and steps behind a figure's runs, in one line. */
OzStatus oz_figure_work_caption(const OzFigureWork *work, char caption[OZ_FIGURE_CAPTION]);

/* Starts gnuplot for folder/NAME.ENDING, noted as the folder's, on a terminal of this size in
 * pixels. NULL where there is no gnuplot. */
OzStatus oz_figure_work_open(const OzFigureWork *work, const char *ending, int width, int height,
                             FILE **gnuplot);

/* Waits until it is drawn and says so. NULL is fine. */
OzStatus oz_figure_work_close(const OzFigureWork *work, const char *ending, FILE *gnuplot);

/* A text between quotes of gnuplot's. */
void oz_figure_work_text(FILE *gnuplot, const char *text);

/* "set xrange [a:b]" of a range that is given. */
void oz_figure_work_range(FILE *gnuplot, const char *axis, const OzNumbers *range);

/* Where the names of curves stand, "top-left" and so on, in gnuplot's words; NULL: top-left. */
void oz_figure_work_key(FILE *gnuplot, const char *place);

/* The caption and what follows it, small below the figure. */
void oz_figure_work_send_caption(const OzFigureWork *work, FILE *gnuplot, const char *more);
