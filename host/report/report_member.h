/* Ensembles that a study runs, and what a member of one says: numbers of its later half, read from
 * its series.csv. */
#pragma once

#include "cli.h"
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

enum { OZ_MEMBER_SETTINGS = 6, OZ_MEMBER_PATH = 1024 };

/* An ensemble to be run: the user's options with settings, folder and seeds of the study's own. */
typedef struct OzMemberOrder {
    OzOptions options;
    int own_count;
    char own[OZ_MEMBER_SETTINGS][64], folder[OZ_MEMBER_PATH]; /* options point into both */
} OzMemberOrder;

/* Begins with the user's options: no movie, and what an earlier run left in order->folder, which
 * the caller fills, may go. Seeds are the user's, else 1 to `seeds`. Fails with OZ_ERR_INPUT where
 * the user's settings leave no place for OZ_MEMBER_SETTINGS more. */
OzStatus oz_report_member_order(OzMemberOrder *order, const OzOptions *options, int seeds);

/* Adds key=value. */
void oz_report_member_set(OzMemberOrder *order, const char *key, const char *value);
void oz_report_member_set_number(OzMemberOrder *order, const char *key, double value);

/* Runs all members side by side. That a scene is refused or a guard stops it is an outcome: reason
 * (size bytes) then says so; *any is false where no member was run. */
OzStatus oz_report_member_run(const OzMemberOrder *order, char *reason, size_t size, bool *any);

/* Whether a seed's member reached the end; path receives that of its series.csv. */
bool oz_report_member_ended(const OzMemberOrder *order, uint64_t seed,
                            char path[OZ_MEMBER_PATH + 64]);
