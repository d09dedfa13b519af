/* Reading counts off the device's arrays. */
#include "compute/probe.h"

#include "base/memory.h"
#include "compute/rods_private.h"

#include <stdlib.h>

static int count_bits(int bits)
{
    int count = 0;
    for (unsigned left = (unsigned)bits; left; left &= left - 1) {
        count++;
    }
    return count;
}

static OzStatus count_pairs(OzProbe *probe, const OzSim *sim, int member)
{
    OzStatus status = OZ_OK;
    const OzSizes *z = oz_rods_sizes(sim);
    int lanes = oz_rods_switches(sim)->lanes, *count = NULL, *picked = NULL;
    OZ_TRY(oz_arrays_download(&sim->arrays, OZ_FIELD_pair_count, member, &count));
    OZ_TRY(oz_arrays_download(&sim->arrays, OZ_FIELD_pair_picked, member, &picked));
    for (int region = 0; region < z->regions; region++) {
        int begin = region * z->inner_capacity / lanes;
        probe->pairs += count[region];
        for (int block = begin; block < begin + (count[region] + lanes - 1) / lanes; block++) {
            probe->touching += count_bits(picked[block]);
        }
    }
done:
    free(count);
    free(picked);
    return status;
}

OzStatus oz_probe_read(OzProbe *probe, const OzSim *sim)
{
    const OzSwitches *s = oz_rods_switches(sim);
    *probe = (OzProbe){.grains = (int64_t)oz_rods_sizes(sim)->count * sim->crew.member_count,
                       .walls = s->walls,
                       .is_double = s->is_double,
                       .history = s->history,
                       .equal = s->equal,
                       .round = s->round};
    for (int f = 0; f < OZ_FIELD_COUNT; f++) {
        probe->bytes += sim->crew.member_count * (int64_t)oz_arrays_bytes(&sim->arrays, f);
    }
    for (int m = 0; m < sim->crew.member_count; m++) {
        OZ_PASS(count_pairs(probe, sim, m));
    }
    return OZ_OK;
}
