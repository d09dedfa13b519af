/* Entering and leaving the switches of a scene. */
#include "sim/host_switches.h"

_Thread_local OzHostSwitches oz_host_switches_now;

OzHostSwitches oz_host_switches_rods(const OzSwitches *switches)
{
    OzHostSwitches before = oz_host_switches_now;
    oz_host_switches_now.rods = *switches;
    return before;
}

OzHostSwitches oz_host_switches_elements(const OzScene *scene)
{
    OzHostSwitches before = oz_host_switches_now;
    oz_host_switches_now.field = scene->triangles.overlap == OZ_OVERLAP_FIELD;
    oz_host_switches_now.midpoint = scene->triangles.force_point == OZ_FORCE_MIDPOINT;
    oz_host_switches_now.balanced = scene->beams.damping_shear == OZ_SHEAR_BALANCED;
    return before;
}

void oz_host_switches_leave(const OzHostSwitches *before)
{
    oz_host_switches_now = *before;
}
