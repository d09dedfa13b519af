/* What of a study is wrong although each of its values is of its type. Adds faults at their lines.
 */
#pragma once

#include "figures/study.h"

/* A name that becomes one of a file or folder, and is new. */
void oz_study_check_name(const OzNode *map, const char *name, bool is_taken, OzFaults *faults);

/* A run: its scene is there, its seeds are a span. */
void oz_study_check_run(const OzNode *map, const OzStudyRun *run, OzFaults *faults);

/* A figure: its runs are the study's, its columns are columns of series.csv, its ranges and sizes
 * can be drawn. */
void oz_study_check_figure(const OzStudy *study, const OzNode *map, const OzStudyFigure *figure,
                           OzFaults *faults);
