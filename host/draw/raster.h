/* Rods and spheres drawn on the host, into planes of colours and depths: where there is no GPU,
 * drivers would do the same on the host, and not know what capsules are. Grains are drawn nearest
 * first, those behind others not at all. The pictures are those of shaders/rods.glsl within a level
 * of colour. */
#pragma once

#include "draw/bodies.h"
#include "draw/drawn.h"
#include "draw/raster_row.h"

/* A view in the making. */
typedef struct OzRaster {
    const OzBodies *bodies; /* borrowed, and drawn's planes */
    OzDrawn drawn;
    OzView view;
    OzRasterLens lens;
    double middle[2];   /* pixels of the planes: where the origin of view coordinates lies */
    float *along, *far; /* lens.along; the furthest depth in each block of some rows    */
    int blocks;         /* in a row of pixels                                           */
} OzRaster;

/* For a panel's view; drawn has what lies behind the grains. Fails with OZ_ERR_MEMORY. */
OzStatus oz_raster_begin(OzRaster *raster, const OzDrawn *drawn, const OzBodies *bodies, int panel);

/* All grains, and over them the outlines of those before the cut if the look wants these. */
void oz_raster_draw(OzRaster *raster);

void oz_raster_end(OzRaster *raster); /* zeroed is fine */
