/* Names from times. Knows nothing of pictures. */
#include "draw/picture_name.h"

#include "model/motion.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

enum {
    TAP_DECIMALS = 3,
    TIME_DECIMALS = 6,
    MOST_DECIMALS = 17, /* beyond these two doubles of order one are the same */
    NUMBER_SIZE = 400   /* the longest double in digits                       */
};

/* Whether pictures are called after taps: where there are any, unless times were asked for. */
static bool is_by_tap(const OzScene *scene)
{
    const OzSnapshotSettings *shots = &scene->snapshots;
    return scene->period > 0 && (shots->tap_count > 0 || shots->count == 0);
}

/* What snapshot i was asked for: a tap or a time. */
static double asked(const OzScene *scene, int i)
{
    return is_by_tap(scene) ? scene->snapshots.taps[i] : scene->snapshots.times[i];
}

static bool share_a_step(const OzScene *scene, int i, int k)
{
    const double *times = scene->snapshots.times;
    return llround(times[i] / scene->step) == llround(times[k] / scene->step);
}

static bool all_differ(const OzScene *scene, int decimals)
{
    char one[NUMBER_SIZE], other[NUMBER_SIZE];
    for (int i = 1; i < scene->snapshots.count; i++) {
        snprintf(one, sizeof one, "%.*f", decimals, asked(scene, i - 1));
        snprintf(other, sizeof other, "%.*f", decimals, asked(scene, i));
        if (strcmp(one, other) == 0 && !share_a_step(scene, i - 1, i)) {
            return false;
        }
    }
    return true;
}

int oz_picture_name_decimals(const OzScene *scene)
{
    int decimals = is_by_tap(scene) ? TAP_DECIMALS : TIME_DECIMALS;
    while (decimals < MOST_DECIMALS && !all_differ(scene, decimals)) {
        decimals++;
    }
    return decimals;
}

/* The snapshot that was asked for within half a step of time, and a little for rounding; -1: none.
 */
static int find_asked(const OzScene *scene, double time)
{
    for (int i = 0; i < scene->snapshots.count; i++) {
        if (fabs(scene->snapshots.times[i] - time) <= 0.501 * scene->step) {
            return i;
        }
    }
    return -1;
}

void oz_picture_name_make(const OzScene *scene, double time, int decimals, char *name, size_t size)
{
    int found = find_asked(scene, time);
    double period = is_by_tap(scene) ? scene->period : 0;
    double number = found >= 0   ? asked(scene, found)
                    : period > 0 ? oz_motion_tap(scene, time)
                                 : time;
    double off = fabs(number - round(number)) * period;
    if (!(period > 0)) {
        snprintf(name, size, "time_%.*f.png", decimals, number);
    } else if (found >= 0 ? off < 1e-9 * period : off < scene->step) {
        snprintf(name, size, "tap_%05.0f.png", number);
    } else {
        snprintf(name, size, "tap_%0*.*f.png", 6 + decimals, decimals, number);
    }
}
