/* An experiment of which the outcome is known, and what is known of it. */
#pragma once

#include "report/report_trial.h"

/* A quantity with the interval that the literature gives it: its uncertainty or the spread of its
 * sources, and of a closed form what our soft contacts and finite number of looks may add to it. */
typedef struct OzKnown {
    const char *quantity, *unit;
    double low, high;
    const char *source; /* author, year */
    const char *remark; /* what the interval is, said below the row; NULL: nothing */
    double (*value)(const OzTrialNumbers *numbers); /* of one seed, by variant; NAN: none */
    const char *cause; /* why ours differs, as experiments found; NULL: not known */
} OzKnown;

enum { OZ_VALIDATION_KNOWN = 4 };

/* One experiment and what is known of it. */
typedef struct OzValidation {
    const char *name; /* as on the command line; ends the list: NULL */
    OzTrial trial;
    OzKnown known[OZ_VALIDATION_KNOWN]; /* until one without a quantity */
} OzValidation;
