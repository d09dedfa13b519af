/* Counting the hits of two grains: a hit is a span of looks at which they touch, and it counts when
 * it has a fair share of the impulse of all of them. Grazes are spans too, and do not count. */
#pragma once

#include "model/snapshot.h"

/* The share of the impulse of all spans that a hit has at least, unless the user says otherwise.
 * The second hit of two dice has a share that falls with their speed from three tenths to nothing,
 * so this number decides at which speed it is no longer counted. Grazes have hundred-thousandths.
 */
#define OZ_HITS_SHARE 0.05

/* No more than 1 / share spans can count: keeping so many greatest loses none at shares from
 * OZ_HITS_SHARE_LEAST on. */
#define OZ_HITS_SHARE_LEAST 0.01
enum { OZ_HITS_SPANS = 100 };

/* Zeroed is valid: nothing seen yet. */
typedef struct OzHits {
    int64_t looks;
    bool touching;                 /* at the last look: its span has not ended   */
    double before[2];              /* m/s, relative velocity before the span     */
    int span_count;                /* that are kept, in order of time            */
    double impulse[OZ_HITS_SPANS]; /* kg m/s, of each                            */
    double total;                  /* kg m/s, of all spans that ended            */
} OzHits;

/* Looks at the first two grains of a snapshot with contacts, in order of time. The impulse is the
 * reduced mass times the change of their relative velocity, which gravity leaves alone; other
 * grains and walls must not be there. */
void oz_hits_look(OzHits *hits, const OzSnapshot *snapshot);

/* Impulse of a kept span over that of all. */
double oz_hits_share(const OzHits *hits, int span);

/* How many spans have at least this share, OZ_HITS_SHARE_LEAST to 1. */
int oz_hits_count(const OzHits *hits, double share);
