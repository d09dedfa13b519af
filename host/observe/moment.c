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
    *value = oz_phases_at(scene, o->snapshot->time + scene->step / 2) + 1;
    return scene->phase_count > 0;
}
