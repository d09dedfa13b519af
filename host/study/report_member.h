/* What one member of an ensemble says: numbers of its later half, read from its series.csv. */
#pragma once

#include "model/grains.h"

/* One measured quantity. */
typedef struct OzMemberQuantity {
    const char *name, *unit; /* name: of columns too                                        */
    const char *column; /* of series.csv                                                       */
    bool per_tap;       /* its growth in a tap instead of its mean                              */
    double (*unit_of)(const OzScene *scene, const OzGrains *grains); /* divides; NULL: 1        */
} OzMemberQuantity;

enum { OZ_MEMBER_QUANTITIES = 4 };

/* THE list: density, angle, contacts of a grain, energy that walls put in during a tap. */
extern const OzMemberQuantity oz_report_member_quantities[OZ_MEMBER_QUANTITIES];

/* Fills values (in the list's order) from the rows whose tap is at least half of the last one's;
 * NAN where the scene has no such column, or no number in one of those rows. Fails with OZ_ERR_FILE
 * when the file cannot be read. */
OzStatus oz_report_member_read(double values[OZ_MEMBER_QUANTITIES], const char *path,
                               const OzScene *scene, const OzGrains *grains);

/* The mean of any column over the rows whose time is at least half of the last one's, or NAN as
 * above. */
OzStatus oz_report_member_mean(double *value, const char *path, const char *column);
