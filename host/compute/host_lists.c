/* Outer lists from P's sort along one axis. */
#include "compute/host_lists.h"

#include "compute/sim_private.h"

OzStatus oz_host_lists_make(OzSim *sim)
{
    return oz_status_fail(OZ_ERR_DEVICE, "%s: the device stopped without a reason",
                          sim->members[0].scene->path);
}
