/* What one of the kernels' lengths, times and masses is. */
#pragma once

#include "kernels/real.h"

/* Powers of two, so that numbers keep their digits. In single precision the squares of small lengths and forces would
 * vanish if they were counted in metres; 1 in double. */
typedef struct OzUnits {
    scalar length; /* m  */
    scalar time;   /* s  */
    scalar mass;   /* kg; of trigrains, a metre deep */
} OzUnits;
