/* Reading counts off the device's arrays. */
#include "compute/probe.h"

#include "base/memory.h"
#include "compute/sim_private.h"

#include <stdlib.h>

/* The whole of a member's field in new memory; the caller frees. */
static OzStatus download(const OzSim *sim, OzFieldId field, int member, void **data)
{
    OzStatus status = OZ_OK;
    size_t bytes = oz_arrays_bytes(field, &sim->arrays.switches, &sim->arrays.sizes);
    OZ_TRY(oz_memory_new(data, bytes, 1, "device array"));
    OZ_TRY(oz_arrays_read(&sim->arrays, field, member, *data, bytes));
done:
    return status;
}

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
    const OzSizes *z = &sim->arrays.sizes;
    int lanes = sim->arrays.switches.lanes, *count = NULL, *picked = NULL;
    OZ_TRY(download(sim, OZ_FIELD_pair_count, member, (void **)&count));
    OZ_TRY(download(sim, OZ_FIELD_pair_picked, member, (void **)&picked));
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
    OzStatus status = OZ_OK;
    const OzSwitches *s = &sim->arrays.switches;
    *probe = (OzProbe){.grains = (int64_t)sim->arrays.sizes.count * sim->crew.member_count,
                       .walls = s->walls,
                       .is_double = s->is_double,
                       .history = s->history,
                       .equal = s->equal,
                       .round = s->round};
    for (int f = 0; f < OZ_FIELD_COUNT; f++) {
        probe->bytes +=
            sim->crew.member_count * (int64_t)oz_arrays_bytes((OzFieldId)f, s, &sim->arrays.sizes);
    }
    for (int m = 0; m < sim->crew.member_count; m++) {
        OZ_TRY(count_pairs(probe, sim, m));
    }
done:
    return status;
}
