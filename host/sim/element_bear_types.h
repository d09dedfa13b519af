/* What evaluations of forces know of beams that can break or yield. */
#pragma once

#include "model/wear.h"
#include "sim/element_laws.h"

#include <stdbool.h>

typedef struct OzElementBear {
    OzBeamConstants beam;
    OzBeamStrength strength, yield;
    OzWear *wear;  /* borrowed: what has become of the beams; NULL: they bear anything        */
    bool wears;    /* evaluations change it: beams break and yield, scars heal                */
    double before; /* s: how long before an evaluation a beam that breaks was there last      */
    bool broke;    /* a beam has, since it was set to false                                   */
} OzElementBear;
