/* The phases of a scene's protocol: they follow each other from time 0, and each may change keys as
 * it begins. */
#pragma once

#include "scene/scene_types.h"
#include "scene/tree.h"

/* A part of a run. */
typedef struct OzPhase {
    char *name;        /* for messages, or NULL                                   */
    double time, taps; /* s, periods: as written; 0: not                          */
    char *set;         /* "key=value; key=value", what changes as it begins; NULL */
    double length;     /* s                                                       */
    int line;          /* where it was written                                    */
} OzPhase;

/* A phase begins at the last step before its time, or at it but for so much of a step: a wall that
 * is shaken stops at the end of a period then, and not half a period later. */
#define OZ_PHASES_SLACK 1e-6

/* How many there are in all cycles. Below, phases of the second cycle follow those of the first:
 * phase n is of row n % phase_count. */
int64_t oz_phases_count(const OzScene *scene);

/* s: when a phase begins. */
double oz_phases_begin(const OzScene *scene, int64_t phase);

/* The phase at a time, from 0; after the last one's end the last. -1 without any. */
int64_t oz_phases_at(const OzScene *scene, double time);

/* What a phase sets, as settings of oz_scene_change ("contact.friction=0.2"); the caller frees
 * every text and the array. */
OzStatus oz_phases_settings(char ***settings, int *count, const OzPhase *phase);

/* Finds how long each phase is, and adds faults for those that have no length or that the run is
 * too short for. Whether a phase may set what it sets shows when the run is prepared
 * (run/protocol.h). */
void oz_phases_check(OzScene *scene, OzNode *root, OzFaults *faults);
