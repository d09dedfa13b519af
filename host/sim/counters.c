/* Reading counts off the device's arrays. */
#include "sim/counters.h"

#include "sim/rods_private.h"

#include <stdlib.h>

static int count_bits(int bits)
{
    int count = 0;
    for (unsigned left = (unsigned)bits; left; left &= left - 1) {
        count++;
    }
    return count;
}

static OzStatus count_pairs(OzCounters *probe, const OzSim *sim, int member)
{
    OzStatus status = OZ_OK;
    const OzSizes *z = oz_rods_sizes(sim);
    int lanes = oz_rods_switches(sim)->lanes, *count = NULL, *active = NULL;
    OZ_TRY(oz_arrays_download(&sim->arrays, OZ_FIELD_pair_count, member, &count));
    OZ_TRY(oz_arrays_download(&sim->arrays, OZ_FIELD_pair_active, member, &active));
    for (int region = 0; region < z->regions; region++) {
        int begin = region * z->inner_capacity / lanes;
        probe->pairs += count[region];
        for (int block = begin; block < begin + (count[region] + lanes - 1) / lanes; block++) {
            probe->touching += count_bits(active[block]);
        }
    }
done:
    free(count);
    free(active);
    return status;
}

OzStatus oz_counters_read(OzCounters *probe, const OzSim *sim)
{
    const OzSwitches *s = oz_rods_switches(sim);
    *probe = (OzCounters){.grains = (int64_t)oz_rods_sizes(sim)->count * sim->batch.member_count,
                          .walls = s->walls,
                          .is_double = s->is_double,
                          .history = s->history,
                          .equal = s->equal,
                          .round = s->round};
    for (int f = 0; f < OZ_FIELD_COUNT; f++) {
        probe->bytes += sim->batch.member_count * (int64_t)oz_arrays_bytes(&sim->arrays, f);
    }
    for (int m = 0; m < sim->batch.member_count; m++) {
        OZ_PASS(count_pairs(probe, sim, m));
    }
    return OZ_OK;
}
