/* Members that go on in pieces. */
#include "sim/element_mend.h"

#include "sim/element_pack.h"
#include "sim/element_part.h"
#include "sim/element_private.h"
#include "sim/element_wear.h"

#include <stdlib.h>
#include <string.h>

/* Bodies and contacts after a break, where it parted a grain. */
static OzStatus part(OzSim *sim, int member, OzSnapshot *now, const int *before)
{
    OzStatus status = OZ_OK;
    const OzUnits *units = &oz_element_parameters(sim, member)->units;
    const OzElements *elements = now->whole->elements;
    int *after = NULL;
    OZ_TRY(oz_element_wear_bodies(&sim->arrays, member, elements, &after));
    if (memcmp(before, after, (size_t)elements->free_count * sizeof *after) != 0) {
        OZ_TRY(
            oz_element_pack_state(&sim->arrays, member, oz_element_parameters(sim, member), now));
        OZ_TRY(oz_element_wear_read(&sim->arrays, member, units, &now->wear));
        oz_element_part_contacts(&now->wear, now->scene, elements, now->element_position,
                                 now->element_angle, (OzElementParting){before, after});
        OZ_TRY(oz_element_wear_write(&sim->arrays, member, units, &now->wear));
        OZ_TRY(oz_element_pack_bodies(&sim->arrays, member, now->whole,
                                      oz_element_own(sim)->present[member]));
        oz_element_control(sim, member)->truth = OZ_SPRINGS_AT_NONE; /* all lists anew */
    }
done:
    free(after);
    return status;
}

OzStatus oz_element_mend_member(OzSim *sim, int member)
{
    OzStatus status = OZ_OK;
    OzSnapshot now = {0};
    OzElementControl *control = oz_element_control(sim, member);
    const OzMember *of = &sim->batch.members[member];
    int *before = NULL;
    if (control->stop_bits != OZ_ELEMENT_STOP_BROKE) {
        return OZ_OK;
    }
    OZ_TRY(oz_snapshot_create(&now, of->scene, of->grains));
    OZ_TRY(oz_arrays_download(&sim->arrays, OZ_ELEMENT_FIELD_body, member, &before));
    OZ_TRY(part(sim, member, &now, before));
    control->stop_bits = 0;
    control->stop_step = control->stop_index = OZ_NEVER;
done:
    oz_snapshot_free(&now);
    free(before);
    return status;
}

OzStatus oz_element_mend_start_ledger(OzSim *sim, int member)
{
    OzStatus status = OZ_OK;
    OzWear wear = {0};
    const OzUnits one = {1, 1, 1};
    if (!oz_element_switches(sim)->strength) {
        return OZ_OK;
    }
    OZ_TRY(oz_wear_create(&wear, sim->batch.members[member].grains->elements));
    OZ_TRY(oz_element_wear_read(&sim->arrays, member, &one, &wear));
    memset(wear.lost, 0, (size_t)wear.beam_count * sizeof *wear.lost);
    OZ_TRY(oz_element_wear_write(&sim->arrays, member, &one, &wear));
done:
    oz_wear_free(&wear);
    return status;
}
