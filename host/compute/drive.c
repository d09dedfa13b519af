/* Passing calls on to the simulation of the scene's model. */
#include "compute/drive.h"

#include "base/memory.h"
#include "compute/capture.h"
#include "compute/company.h"

#include <stdlib.h>

struct OzDrive {
    OzSim *rods;
};

OzStatus oz_drive_create(OzDrive **out, const OzDevice *device, const OzMember *members,
                         int member_count, const char *source_dir)
{
    OzStatus status = OZ_OK;
    OzDrive *drive = NULL;
    *out = NULL;
    OZ_TRY(OZ_NEW(&drive, 1));
    OZ_TRY(oz_sim_create(&drive->rods, device, members, member_count, source_dir));
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
        free(drive);
    }
}

OzStatus oz_drive_launch(OzDrive *drive, int64_t step)
{
    return oz_sim_launch(drive->rods, step);
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
    return oz_sim_step(drive->rods);
}

const char *oz_drive_stopped(const OzDrive *drive, int member)
{
    return oz_sim_stopped(drive->rods, member);
}

OzSimCounts oz_drive_counts(const OzDrive *drive)
{
    return oz_sim_counts(drive->rods);
}

OzStatus oz_drive_settle(OzDrive *drive, double *seconds, OzSettleWatch watch, void *context)
{
    return oz_settle_run(drive->rods, seconds, watch, context);
}

OzStatus oz_drive_capture(OzDrive *drive, int member, OzSnapshot *snapshot, bool contacts)
{
    return oz_capture_snapshot(drive->rods, member, snapshot, contacts);
}

OzStatus oz_drive_describe(const OzDevice *device, const OzScene *scene, const OzGrains *grains,
                           FILE *file)
{
    return oz_sim_describe(device, scene, grains, file);
}

bool oz_drive_fits(const OzDevice *device, const OzMember *a, const OzMember *b)
{
    return oz_company_fits(device, a, b);
}

OzStatus oz_drive_most(const OzDevice *device, const OzMember *member, int64_t *most, double *bytes)
{
    return oz_company_most(device, member, most, bytes);
}
