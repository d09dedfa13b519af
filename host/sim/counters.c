/* Reading counts off the device's arrays. */
#include "sim/counters.h"

#include "sim/rods_private.h"

#include <stdlib.h>

static OzStatus count_pairs(OzCounters *probe, const OzSim *sim, int member)
{
    OzStatus status = OZ_OK;
    const OzSizes *z = oz_rods_sizes(sim);
    int lanes = oz_rods_switches(sim)->lanes, *a = NULL, *count = NULL, *active = NULL;
    OZ_TRY(oz_arrays_download(&sim->arrays, OZ_FIELD_pair_a, member, &a));
    OZ_TRY(oz_arrays_download(&sim->arrays, OZ_FIELD_pair_count, member, &count));
    OZ_TRY(oz_arrays_download(&sim->arrays, OZ_FIELD_pair_active, member, &active));
    for (int region = 0; region < z->regions; region++) {
        int begin = region * z->inner_capacity;
        for (int p = begin; p < begin + count[region]; p++) {
            bool counts = oz_rods_fields_counts(&sim->arrays, region, a[p]);
            probe->pairs += counts;
            probe->touching += counts && ((unsigned)active[p / lanes] >> (p % lanes) & 1);
        }
    }
done:
    free(a);
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
