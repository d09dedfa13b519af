/* THE list of stiff and extreme cases of rods, and what a row of any model is. A new case is a row;
 * the table and the test walk the rows, and those of report/report_extreme_elements.h. */
#pragma once

#include "model/snapshot.h"

enum { OZ_EXTREME_SETTINGS_MAX = 6 };

typedef struct OzExtremeCase {
    const char *name;
    const char *grains; /* YAML: the list of populations                              */
    const char *walls;  /* YAML: the list of walls; NULL: those that its model's cases share */
    const char *settings[OZ_EXTREME_SETTINGS_MAX]; /* on top of the common scene            */
    const char *brief;    /* setting that shortens it, or NULL                           */
    const char *measured; /* what the value is; NULL: the case must be refused           */
    double (*value)(const OzSnapshot *end);
    double low, high;  /* the value, both allowed                                     */
    double float_high; /* in float, where its rounding shows; 0: high; below: not for float */
    OzModelKind model;
    bool forced;      /* a step that is refused as unstable is made all the same          */
    const char *says; /* to be found in a refusal's message; NULL: it is right whatever   */
} OzExtremeCase;

/* The cases of one model. */
typedef struct OzExtremeSuite {
    const char *common;        /* YAML: the keys that all cases share, without grains and walls */
    const char *walls;         /* YAML: the walls of a case without its own                     */
    const OzExtremeCase *rows; /* ending with one whose name is NULL                     */
} OzExtremeSuite;

/* Rods of diameter 5 mm are meant, contact time 1 ms, 50 steps per contact, restitution 0.5,
 * friction 0.3, no gravity; a plane at rest, z = 0, and a cylinder out of reach. */
extern const OzExtremeSuite oz_report_extreme_cases_suite;
