/* Scenes that take over. It knows no model and no key. */
#include "sim/take_over.h"

#include "base/memory.h"
#include "scene/boundary.h"
#include "sim/models.h"
#include "sim/read_snapshot.h"
#include "sim/sim_private.h"
#include "sim/sim_state.h"

#include <stdlib.h>
#include <string.h>

/* What a scene would be, and what it is; units are neither here nor there. */
typedef struct Compared {
    OzModelLayout next, running;
} Compared;

/* State that the next program needs and the running one does not keep; what begins empty is none.
 */
static OzStatus check_state(const Compared *c, const OzModel *model, const OzScene *next)
{
    for (int f = 0; f < model->field_count; f++) {
        size_t needed = oz_model_field_bytes(model, f, c->next.switches, c->next.sizes);
        size_t kept = oz_model_field_bytes(model, f, c->running.switches, c->running.sizes);
        bool begins_empty = oz_model_field_begins_empty(&model->fields[f]);
        if (model->fields[f].class == OZ_FIELD_STATE && needed > 0 && kept == 0 && !begins_empty) {
            return oz_status_fail(OZ_ERR_INPUT,
                                  "%s: it needs %s of the grains, which the running scene does not "
                                  "keep; expected another run",
                                  next->path, model->fields[f].name);
        }
    }
    return OZ_OK;
}

OzStatus oz_take_over_compare(OzTakeOver *how, const OzDevice *device, const OzGrains *grains,
                              const OzScene *running, const OzScene *next)
{
    OzStatus status = OZ_OK;
    Compared c = {0};
    const OzModel *model = oz_models_of(running);
    const OzMember old = {running, grains}, other = {next, grains};
    OZ_TRY(oz_model_layout(&c.next, model, &other, device, NULL));
    OZ_TRY(oz_model_layout(&c.running, model, &old, device, NULL));
    OZ_TRY(check_state(&c, model, next));
    OZ_TRY(oz_boundary_check_next(running, next));
    bool same = memcmp(c.next.switches, c.running.switches, model->switches_bytes) == 0 &&
                memcmp(c.next.sizes, c.running.sizes, model->sizes_bytes) == 0;
    *how = same ? OZ_TAKE_OVER_APPLY : OZ_TAKE_OVER_REBUILD;
done:
    oz_model_layout_free(&c.next);
    oz_model_layout_free(&c.running);
    return status;
}

/* New parameters; drag is there while settling alone, and is not the scene's. */
static OzStatus take(OzSim *sim, int member, const OzScene *next)
{
    OzStatus status = OZ_OK;
    OzModelLayout layout = {0};
    OzParametersHead *own = oz_sim_parameters(sim, member);
    const OzMember other = {next, sim->batch.members[member].grains};
    double step = own->dt, drag = own->drag;
    OZ_TRY(oz_model_layout(&layout, sim->model, &other, sim->device, own));
    OZ_TRY(oz_batch_take_scene(&sim->batch, member, next));
    memcpy(own, layout.parameters, sim->model->parameters_bytes);
    own->drag = drag;
    if (sim->model->adopt) {
        OZ_TRY(sim->model->adopt(sim, sim, member, step));
    }
done:
    oz_model_layout_free(&layout);
    return status;
}

OzStatus oz_take_over_apply(OzSim *sim, const OzScene *const *next)
{
    OZ_PASS(oz_sim_state_save_springs(sim));
    for (int m = 0; m < sim->batch.member_count; m++) {
        if (!sim->batch.stopped[m]) {
            OZ_PASS(take(sim, m, next[m]));
        }
    }
    OZ_PASS(oz_sim_write_parameters(sim));
    return oz_sim_state_renew(sim);
}

OzStatus oz_take_over_build(OzSim **sim, const OzSim *running, const OzDevice *device,
                            const OzScene *const *next, const char *source_dir)
{
    OzStatus status = OZ_OK;
    int count = running->batch.member_count;
    OzMember *members = NULL;
    *sim = NULL;
    OZ_TRY(OZ_NEW(&members, count));
    for (int m = 0; m < count; m++) {
        members[m] = (OzMember){next[m], running->batch.members[m].grains};
    }
    OZ_TRY(oz_sim_create_after(sim, device, members, count, source_dir, running));
done:
    free(members);
    return status;
}

OzStatus oz_take_over_swap(OzSim *sim, OzSim *running, const OzScene *const *next)
{
    int count = running->batch.member_count;
    const OzSwitchesHead *now = oz_arrays_switches(&sim->arrays);
    const OzSwitchesHead *before = oz_arrays_switches(&running->arrays);
    OZ_PASS(oz_sim_state_move(sim, running));
    for (int m = 0; m < count; m++) {
        const OzScene *scene = sim->batch.stopped[m] ? running->batch.members[m].scene : next[m];
        OZ_PASS(oz_batch_take_scene(&sim->batch, m, scene));
    }
    sim->batch.counts = running->batch.counts;
    sim->batch.launch_steps = running->batch.launch_steps;
    OZ_PASS(oz_sim_state_renew(sim));
    if (now->ledger && !before->ledger) {
        OZ_PASS(oz_read_snapshot_start_ledger(sim));
    }
    return OZ_OK;
}
