/* THE list of small scenes of known outcome that `orzo report` studies: what is measured at the end
 * of each, and what it must be. A new case is a scene in scenes/report/ and a row. */
#pragma once

#include "cli.h"
#include "model/snapshot.h"

typedef struct OzReportCase {
    const char *scene; /* name of the scene file without folder and .yaml                        */
    const char *quantity; /* as in "an error of 1 % in <quantity>" */
    const char *unit; /* "" where the error is a share of the truth, else the error's unit      */
    bool phases;      /* grains touch at a time that a shift of the start can move by a share of
                         a step                                                                 */
    double (*value)(const OzSnapshot *end);
    double (*exact)(const OzSnapshot *end); /* NULL: the reference in small steps is the truth */
    OzStatus (*study)(const char *path, const char *folder,
                      const OzOptions *options); /* NULL; or in place of all the above */
} OzReportCase;

/* The rows, ending with one whose scene is NULL. */
const OzReportCase *oz_report_cases_all(void);

/* The row of a scene's name, or NULL. */
const OzReportCase *oz_report_cases_find(const char *scene);

/* Error of a value: a share of the truth where the case has no unit. */
double oz_report_cases_error(const OzReportCase *row, double value, double truth);
