/* How densely grains lie inside a settled bed, away from its cylinder, floor and surface. */
#pragma once

#include "report/report_trial.h"

enum {
    OZ_LOOK_PACKING_DENSITY,  /* share of the inside that is filled, overlaps once           */
    OZ_LOOK_PACKING_CONTACTS, /* mean number of others that a grain inside touches           */
    OZ_LOOK_PACKING_BACKBONE, /* the same of those that bear: without grains of less than two
                                 contacts, again and again (Thornton 2000)                   */
    OZ_LOOK_PACKING_ASPECT,   /* of grain 0                                                  */
    OZ_LOOK_PACKING_OVERLAP   /* greatest, over the mean diameter                            */
};
void oz_report_validate_packing_look(OzTrialNumbers numbers, const OzSnapshot *now, int look);
