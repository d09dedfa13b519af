/* Passing calls on to the simulation of the scene's model. */
#include "compute/drive.h"

#include "base/memory.h"
#include "compute/capture.h"
#include "compute/company.h"
#include "compute/piece_capture.h"
#include "compute/piece_company.h"
#include "compute/piece_settle.h"

#include <stdlib.h>

/* One of them is there. */
struct OzDrive {
    OzSim *rods;
    OzPieceSim *pieces;
};

static bool is_rods(const OzScene *scene)
{
    return scene->model == OZ_MODEL_RODS;
}

OzStatus oz_drive_create(OzDrive **out, const OzDevice *device, const OzMember *members,
                         int member_count, const char *source_dir)
{
    OzStatus status = OZ_OK;
    OzDrive *drive = NULL;
    *out = NULL;
    OZ_TRY(OZ_NEW(&drive, 1));
    if (is_rods(members[0].scene)) {
        OZ_TRY(oz_sim_create(&drive->rods, device, members, member_count, source_dir));
    } else {
        OZ_TRY(oz_piece_sim_create(&drive->pieces, device, members, member_count, source_dir));
    }
    *out = drive;
    drive = NULL;
done:
    oz_drive_free(drive);
    return status;
}

void oz_drive_free(OzDrive *drive)
{
    if (drive) {
        oz_sim_free(drive->rods);
        oz_piece_sim_free(drive->pieces);
        free(drive);
    }
}

OzStatus oz_drive_launch(OzDrive *drive, int64_t step)
{
    return drive->rods ? oz_sim_launch(drive->rods, step)
                       : oz_piece_sim_launch(drive->pieces, step);
}

OzStatus oz_drive_advance(OzDrive *drive, int64_t step)
{
    OzStatus status = OZ_OK;
    while (status == OZ_OK && oz_drive_step(drive) < step) {
        status = oz_drive_launch(drive, step);
    }
    return status;
}

int64_t oz_drive_step(const OzDrive *drive)
{
    return drive->rods ? oz_sim_step(drive->rods) : oz_piece_sim_step(drive->pieces);
}

const char *oz_drive_stopped(const OzDrive *drive, int member)
{
    return drive->rods ? oz_sim_stopped(drive->rods, member)
                       : oz_piece_sim_stopped(drive->pieces, member);
}

OzSimCounts oz_drive_counts(const OzDrive *drive)
{
    return drive->rods ? oz_sim_counts(drive->rods) : oz_piece_sim_counts(drive->pieces);
}

OzStatus oz_drive_settle(OzDrive *drive, double *seconds, OzSettleWatch watch, void *context)
{
    return drive->rods ? oz_settle_run(drive->rods, seconds, watch, context)
                       : oz_piece_settle_run(drive->pieces, seconds, watch, context);
}

OzStatus oz_drive_capture(OzDrive *drive, int member, OzSnapshot *snapshot, bool contacts)
{
    return drive->rods ? oz_capture_snapshot(drive->rods, member, snapshot, contacts)
                       : oz_piece_capture_snapshot(drive->pieces, member, snapshot, contacts);
}

OzStatus oz_drive_describe(const OzDevice *device, const OzScene *scene, const OzGrains *grains,
                           FILE *file)
{
    return is_rods(scene) ? oz_sim_describe(device, scene, grains, file)
                          : oz_piece_sim_describe(device, scene, grains, file);
}

bool oz_drive_fits(const OzDevice *device, const OzMember *a, const OzMember *b)
{
    if (a->scene->model != b->scene->model) {
        return false;
    }
    return is_rods(a->scene) ? oz_company_fits(device, a, b) : oz_piece_company_fits(device, a, b);
}

OzStatus oz_drive_most(const OzDevice *device, const OzMember *member, int64_t *most, double *bytes)
{
    return is_rods(member->scene) ? oz_company_most(device, member, most, bytes)
                                  : oz_piece_company_most(device, member, most, bytes);
}
