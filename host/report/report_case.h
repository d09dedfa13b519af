/* A small scene of known outcome that `orzo report` studies: what is measured at its end, and what
 * it must be. A new case is a scene in scenes/report/ and a row in report_cases.c or
 * report_element_cases.c. */
#pragma once

#include "cli.h"
#include "model/snapshot.h"

enum { OZ_REPORT_VALUES = 8 };

typedef struct OzReportCase {
    const char *scene; /* name of the scene file without folder and .yaml                        */
    const char *quantity; /* as in "an error of 1 % in <quantity>" */
    const char *unit; /* "" where the error is a share of the truth or of what `values` are scaled
                         by, else the error's unit                                              */
    bool phases;      /* grains touch at a time that a shift of the start can move by a share of
                         a step                                                                 */
    OzModelKind model;
    /* the number at the end; or fills at most OZ_REPORT_VALUES, scaled so that the distance
     * between two outcomes is the error, and returns how many                                  */
    double (*value)(const OzSnapshot *end);
    int (*values)(const OzSnapshot *end, double *values);
    /* what the value is in truth, unless all are zero; without either that of the reference in
     * small steps                                                                              */
    double (*exact)(const OzSnapshot *end);
    bool zero;
    int starts;   /* without phases: how many starts of its own; 0: all alike                   */
    double floor; /* what is not linear, say, keeps errors above this: no order below it        */
    /* makes a start (0 .. starts - 1) of the placed grains; NULL: they start as placed         */
    void (*start)(const OzScene *scene, OzGrains *grains, int index);
    OzStatus (*study)(const char *path, const char *folder,
                      const OzOptions *options); /* NULL; or in place of all the above */
} OzReportCase;
