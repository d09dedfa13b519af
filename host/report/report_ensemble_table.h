/* Ensembles in words and pictures: means over seeds with their spread and interval. */
#pragma once

#include "base/student.h"
#include "report/report_member.h"

#include <stdio.h>

enum { OZ_ENSEMBLE_SEEDS_MAX = 256 };

/* One setting. */
typedef struct OzEnsemblePoint {
    OzIntegrator integrator;
    int steps;      /* per contact time                                              */
    double seconds; /* wall clock of all members                                     */
    int members;    /* that reached the end                                          */
    double value[OZ_MEMBER_QUANTITIES][OZ_ENSEMBLE_SEEDS_MAX];
    char reason[200]; /* why there are no members, or not all; empty: there are       */
} OzEnsemblePoint;

/* Over the members of a point. */
OzMoments oz_report_ensemble_table_moments(const OzEnsemblePoint *point, int quantity);

/* Ends with a line about what is left out. */
void oz_report_ensemble_table_print(FILE *file, const OzEnsemblePoint *points, int count);

/* Writes folder/ensemble.csv and, where there is gnuplot, folder/ensemble.png. */
OzStatus oz_report_ensemble_table_write(const char *folder, const char *title,
                                        const OzEnsemblePoint *points, int count);
