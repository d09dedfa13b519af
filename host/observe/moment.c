/* Steps, seconds, taps and phases. */
#include "observe/moment.h"

#include "model/motion.h"
#include "scene/phases.h"

bool oz_moment_step(const OzObservation *o, double *value)
{
    *value = (double)o->snapshot->step;
    return true;
}

bool oz_moment_time(const OzObservation *o, double *value)
{
    *value = o->snapshot->time;
    return true;
}

bool oz_moment_tap(const OzObservation *o, double *value)
{
    const OzScene *scene = o->snapshot->scene;
    *value = oz_motion_tap(scene, o->snapshot->time);
    return scene->period > 0;
}

bool oz_moment_phase(const OzObservation *o, double *value)
{
    const OzScene *scene = o->snapshot->scene;
    int64_t phase = oz_phases_at(scene, o->snapshot->time + (1 - OZ_PHASES_SLACK) * scene->step);
    bool any = phase >= 0;
    *value =
        !any ? 0
             : (double)(1 + (o->index ? phase / scene->phase_count : phase % scene->phase_count));
    return any;
}
