/* Rows of pixels of a grain: rays cast block by block, as shaders/rods.glsl casts them one by one,
 * whose formulas these are. Knows neither cameras nor snapshots. */
#pragma once

#include <stdint.h>

/* What all rows of a view share. */
typedef struct OzRasterLens {
    float distance, depth;  /* view units: of the eye; half the depth range               */
    float pixel;            /* view units per pixel at the middle's depth                 */
    float plane[3], offset; /* the cut: its normal into the half that is kept, and offset */
    const float *along;     /* x of each column's ray, whose z is -1; a block more */
} OzRasterLens;

/* A rod or sphere. */
typedef struct OzRasterBody {
    float centre[3], radius, axis[3], half_shaft;
    float rgb[3]; /* 0 to 1 */
} OzRasterBody;

/* A row's pixels from first to before end, drawn in whole blocks; up: y of its rays. */
typedef struct OzRasterRow {
    float *depth;
    uint8_t *colour; /* RGB and outline_code */
    float up;
    int first, end;
} OzRasterRow;

/* What is nearer than what is there. Returns whether anything is. */
int oz_raster_row_whole(const OzRasterLens *lens, const OzRasterBody *body, const OzRasterRow *row);

/* The same of what is left of a grain behind the cut, with its section. */
int oz_raster_row_sliced(const OzRasterLens *lens, const OzRasterBody *body,
                         const OzRasterRow *row);

/* A faint line along the inside of its outline, over whatever is there. */
void oz_raster_row_outlined(const OzRasterLens *lens, const OzRasterBody *body,
                            const OzRasterRow *row);
