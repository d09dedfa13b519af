/* A measured motion of a wall, from a CSV: offsets or accelerations against time, joined to one
 * smooth way whose velocity is continuous. Where offsets are given, cubic splines go through them
 * (not-a-knot ends; the error is of fourth order in their distance). Where accelerations are given,
 * straight lines join them, and the way is what they add up to exactly, from rest; or, closed, from
 * the velocity with which it ends where it began. Either way begins at offset 0, where the wall was
 * built. */
#pragma once

#include "scene/faults.h"
#include "scene/scene_types.h"

#include <stdbool.h>
#include <stdint.h>

/* Shared by the copies of a scene and never changed: the last of them frees it. */
struct OzTrace {
    _Atomic int keepers;
    int64_t count;
    double *time;     /* s, of each row, from the first one on              */
    double *offset;   /* m, there                                           */
    double *velocity; /* m/s, there; cubics lie between                     */
    double reach;     /* m, greatest offset, without sign                   */
    double speed;     /* m/s, greatest velocity                             */
    double offset_rms, velocity_rms, acceleration_rms; /* about their means, over the whole time */
    double acceleration_mean;                          /* m/s^2 */
    double acceleration_most;                          /* m/s^2, greatest, without sign */
    int64_t digest; /* of rows and numbers: another trace has another one */
};

/* Offset (m) and velocity (m/s) at a time since its first row, s; at rest before and after. */
void oz_trace_at(const OzTrace *trace, double time, double *offset, double *velocity);

/* Loads the traces of all walls that name a file; what is wrong with one becomes a fault at its
 * line. Fails with OZ_ERR_MEMORY alone. */
OzStatus oz_trace_load_walls(OzScene *scene, OzFaults *faults);

/* For a scene whose walls were copied as they stand, and for one that is freed. */
void oz_trace_keep_walls(OzScene *scene);
void oz_trace_free_walls(OzScene *scene);

/* "offset of shake.csv: 400 rows in 2.5 s; rms offset 1.2e-3 m, ..." */
void oz_trace_describe(const OzMotion *motion, char *text, size_t size);

/* A line in the log for each wall that follows one. */
void oz_trace_say(const OzScene *scene);
