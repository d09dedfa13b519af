/* A study: which scenes are run with which seeds, and which figures show which columns of them.
 * Read from a YAML file:
 *
 *     name: pournin2005                     # of its folder
 *     quick: {seeds: 2, set: [time.taps=300]}
 *     runs:
 *       - {name: an6, scene: ../an6.yaml, seeds: [1, 8]}
 *     figures:
 *       - {name: figure_7, kind: curves, runs: [an6], columns: [angle_tap_mean], against: tap}
 *
 * Paths of scenes are relative to the file. */
#pragma once

#include "figures/study_fields.h"

#include <stdint.h>

/* One scene with its seeds, a folder of that name below the study's. */
typedef struct OzStudyRun {
    char *name, *scene; /* the scene as written */
    char *path;         /* of the scene, as seen from the working folder */
    char *label;        /* in legends; NULL: the name                    */
    OzNumbers seeds;    /* first and last; none: 1 alone                 */
    OzTexts set;        /* settings                                      */
    int line;           /* in the study's file */
    OzTexts quick;      /* with --quick besides; none: the study's       */
} OzStudyRun;

/* A figure; which keys it has is its kind's matter. Ranges are none, or two numbers. */
typedef struct OzStudyFigure {
    char *name, *kind, *title;
    OzTexts runs;
    OzTexts columns;  /* a column of series.csv, or a sum of some with + between */
    OzTexts labels;   /* of columns in legends                                   */
    char *against;    /* the column along x                                      */
    char *panels;     /* "runs", "columns": one each; NULL: all curves in one    */
    OzNumbers smooth; /* curves are means over so many rows, the last of them at x */
    bool dashes;      /* columns after the first are dashed */
    char *x_label, *y_label;
    char *key; /* where the names of curves stand */
    OzNumbers x_range, y_range;
    bool x_log;
    bool absolute;                    /* values without their sign */
    OzTexts inset_run, inset_columns; /* a small plot within the first panel */
    OzNumbers inset_range;
    char *at_greatest; /* pictures where this column is greatest, from time `from`, s, on,
                        * and `before`, s, that */
    OzNumbers before, from;
    OzNumbers at;        /* taps or times of pictures, as the scene counts */
    char *bars;          /* of a sweep: the column that bars show */
    OzNumbers power;     /* of a sweep: the paper's exponent */
    OzTexts rows, parts; /* of shares: the paper's rows, and what they are of here */
    OzNumbers paper;     /* of shares: its numbers, %                          */
    OzTexts views;       /* a row of pictures for each                     */
    OzTexts picture;     /* settings of `orzo draw`                        */
    OzNumbers size;      /* pixels of one picture                          */
} OzStudyFigure;

/* What --quick changes. */
typedef struct OzStudyQuick {
    OzNumbers seeds; /* at most so many of each run */
    OzTexts set;
} OzStudyQuick;

typedef struct OzStudy {
    char *path; /* of the file */
    char *name, *title;
    OzStudyQuick quick;
    OzStudyRun *runs;
    int run_count;
    OzStudyFigure *figures;
    int figure_count;
} OzStudy;

/* The number of a run or figure of that name, or -1. */
int oz_study_find_run(const OzStudy *study, const char *name);
int oz_study_find_figure(const OzStudy *study, const char *name);
