/* Trigrains' part of a simulation, and the model's row. */
#include "compute/trigrains.h"

#include "base/memory.h"
#include "compute/cl_try.h"
#include "compute/launch.h"
#include "compute/piece_capture.h"
#include "compute/piece_guard.h"
#include "compute/piece_motion.h"
#include "compute/piece_pack.h"
#include "compute/piece_private.h"
#include "compute/piece_sizes.h"
#include "compute/piece_upload.h"

#include <stddef.h>
#include <stdlib.h>

enum { JUDGE_STEPS = 512 };

_Static_assert(offsetof(OzPieceSwitches, ledger) == offsetof(OzSwitchesHead, ledger) &&
                   offsetof(OzPieceSwitches, lanes) == offsetof(OzSwitchesHead, lanes) &&
                   offsetof(OzPieceSwitches, group) == offsetof(OzSwitchesHead, group),
               "switches begin with what the driver reads");

static const OzSwitch switch_rows[] = {
#define ROW(name, member, left_out) {#name, left_out},
    OZ_PIECE_SWITCHES(ROW)
#undef ROW
};

static void derive(void *switches, const OzScene *scene, const OzGrains *grains,
                   const OzDevice *device)
{
    *(OzPieceSwitches *)switches = oz_piece_switches_derive(scene, grains, device);
}

static const char *program(const void *switches)
{
    (void)switches;
    return "kernels/trigrains.cl";
}

static int64_t count_pieces(const OzGrains *grains)
{
    return grains->pieces->count;
}

/* Numbers of pieces may differ. */
static bool fits(const OzMember *a, const OzMember *b, const void *switches)
{
    (void)switches;
    return a->scene->wall_count == b->scene->wall_count;
}

static OzStatus open(OzSim *sim)
{
    OzStatus status = OZ_OK;
    cl_int code = CL_SUCCESS;
    OzTrigrains *own = NULL;
    OZ_TRY(OZ_NEW(&own, 1));
    sim->own = own;
    OZ_TRY(OZ_NEW(&own->present, sim->crew.member_count));
    sim->advance = clCreateKernel(sim->program, "oz_advance", &code);
    CL_TRY(code);
    own->begin = clCreateKernel(sim->program, "oz_begin", &code);
    CL_TRY(code);
done:
    return status;
}

static void close(OzSim *sim)
{
    OzTrigrains *own = sim->own;
    if (own && own->begin) {
        clReleaseKernel(own->begin);
    }
    if (own) {
        free(own->present);
        free(own);
    }
}

/* The start, and the records of pieces and walls. */
static OzStatus start(OzSim *sim)
{
    OzStatus status = OZ_OK;
    sim->crew.walls_still = sim->crew.members[0].scene->settle.present;
    for (int m = 0; m < sim->crew.member_count; m++) {
        OZ_TRY(oz_piece_upload_member(sim, m));
    }
    OZ_TRY(oz_sim_write_parameters(sim));
    for (int m = 0; m < sim->crew.member_count; m++) {
        OZ_TRY(oz_piece_motion_write_motion(sim, m, 0));
    }
    OZ_TRY(oz_launch_write_control(sim));
    OZ_TRY(oz_launch_enqueue(sim, oz_piece_own(sim)->begin, -1));
done:
    return status;
}

static OzStatus write_parameters(OzSim *sim, int member)
{
    return oz_piece_pack_parameters(&sim->arrays, member, oz_piece_parameters(sim, member));
}

static bool is_through(const void *control, int steps)
{
    return ((const OzPieceControl *)control)->step >= steps;
}

/* All members then make their lists anew. */
static OzStatus let_go(OzSim *sim)
{
    for (int m = 0; m < sim->crew.member_count; m++) {
        oz_piece_control(sim, m)->outer_holds = oz_piece_control(sim, m)->inner_holds = 0;
    }
    return OZ_OK;
}

const OzModel oz_trigrains_model = {
    .name = "trigrains",
    .field_count = OZ_PIECE_FIELD_COUNT,
    .control_field = OZ_PIECE_FIELD_control,
    .fields = oz_piece_fields_rows,
    .field_bytes = oz_piece_fields_bytes,
    .body = "piece",
    .body_count = count_pieces,
    .switches_bytes = sizeof(OzPieceSwitches),
    .sizes_bytes = sizeof(OzPieceSizes),
    .parameters_bytes = sizeof(OzPieceParameters),
    .control_bytes = sizeof(OzPieceControl),
    .switch_count = sizeof switch_rows / sizeof switch_rows[0],
    .switches = switch_rows,
    .derive = derive,
    .program = program,
    .fill = oz_piece_sizes_parameters,
    .choose = oz_piece_sizes_choose,
    .join = oz_piece_sizes_join,
    .fits = fits,
    .alike = "features, walls, step and settling",
    .open = open,
    .start = start,
    .close = close,
    .write_parameters = write_parameters,
    .steps_alike = oz_piece_motion_steps_alike,
    .prepare = oz_piece_motion_prepare,
    .is_through = is_through,
    .let_go = let_go,
    .unpack = oz_piece_capture_state,
    .contacts = oz_piece_capture_contacts,
    .energy = oz_piece_capture_energy,
    .judge_steps = JUDGE_STEPS,
    .start_ledger = oz_piece_capture_start_ledger,
    .stop_count = OZ_PIECE_GUARD_STOPS,
    .stops = oz_piece_guard_stops,
    .grain_of = oz_piece_guard_grain,
    .advise = oz_piece_guard_advise,
};
