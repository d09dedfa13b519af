/* THE list of small scenes of trigrains that `orzo report` studies. What comes out of each is a few
 * numbers, scaled so that the distance between two outcomes is the error. A new case is a scene in
 * scenes/report/ and a row. */
#pragma once

#include "report/report_cases.h"

enum { OZ_REPORT_ELEMENT_VALUES = 8 };

typedef struct OzReportElementCase {
    OzReportCase row; /* scene, quantity, unit and phases of it                                 */
    int starts;       /* without phases: how many starts of its own; 0: all alike               */
    double floor;     /* what is not linear, say, keeps errors above this: no order below it     */
    bool exact;       /* the values are 0 in truth; otherwise the reference's in small steps     */
    /* makes a start (0 .. starts - 1) of the placed grains; NULL: they start as placed         */
    void (*start)(const OzScene *scene, OzGrains *grains, int index);
    /* fills at most OZ_REPORT_ELEMENT_VALUES numbers and returns how many; NULL with a study     */
    int (*values)(const OzSnapshot *end, double *values);
} OzReportElementCase;

/* The rows, ending with one whose scene is NULL. */
const OzReportElementCase *oz_report_element_cases_all(void);

/* The row of a scene's name, or NULL. */
const OzReportElementCase *oz_report_element_cases_find(const char *scene);

/* Distance of an end from the truth (zeros where the case is exact). */
double oz_report_element_cases_error(const OzReportElementCase *elements, const OzSnapshot *end,
                                     const double truth[OZ_REPORT_ELEMENT_VALUES]);
