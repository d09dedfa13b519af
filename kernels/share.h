/* The kernel with which host and device compare their idea of shared structs, in every program. */
#ifndef OZ_KERNELS_SHARE_H
#define OZ_KERNELS_SHARE_H

#include "kernels/layout.h"

/* Sizes of the structs that both sides share. */
kernel void oz_layout(global int *sizes)
{
    sizes[0] = (int)sizeof(OzParameters);
    sizes[1] = (int)sizeof(OzControl);
    sizes[2] = (int)sizeof(OzSizes);
    sizes[3] = (int)sizeof(scalar);
    sizes[4] = OZ_LANES;
}

#endif
