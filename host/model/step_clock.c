/* Steps and times of one stretch. */
#include "model/step_clock.h"

#include <math.h>

OzStepClock oz_step_clock_begin(double dt)
{
    return (OzStepClock){.dt = dt};
}

double oz_step_clock_time(const OzStepClock *clock, int64_t step)
{
    return clock->start + (double)(step - clock->first) * clock->dt;
}

int64_t oz_step_clock_nearest(const OzStepClock *clock, double time)
{
    const double most = 9e18; /* below what 64 bits hold */
    double steps = (time - clock->start) / clock->dt;
    return steps < most ? clock->first + llround(steps) : INT64_MAX;
}

void oz_step_clock_change(OzStepClock *clock, int64_t step, double dt)
{
    if (dt != clock->dt) {
        *clock = (OzStepClock){step, oz_step_clock_time(clock, step), dt};
    }
}

OzStatus oz_step_clock_state(OzStepClock *clock, OzStateVisit *visit, const char *name)
{
    OZ_PASS(oz_state_enter(visit, name, 1));
    OZ_PASS(oz_state_int64(visit, "first", "step", &clock->first));
    OZ_PASS(oz_state_double(visit, "start", "s", &clock->start, 1));
    OZ_PASS(oz_state_double(visit, "dt", "s", &clock->dt, 1));
    oz_state_leave(visit);
    return OZ_OK;
}
