/* Colours: what a grain's colour means, and the colour bar's own. sRGB, 0..1. */
#pragma once

#include "draw/renderer.h"

/* Dark blue over green to yellow for x from 0 to 1, even in lightness; after viridis (van der Walt
 * and Smith 2015). Clamped. */
void oz_palette_viridis(double x, float rgb[3]);

/* Dark to light grey for x from 0 to 1. Clamped. */
void oz_palette_grey(double x, float rgb[3]);

/* Once around the hues, equally light, for x from 0 to 1; wraps. */
void oz_palette_cyclic(double x, float rgb[3]);

/* A colour told apart from those of the other rows; after eight rows they begin again. */
void oz_palette_type(int row, float rgb[3]);

/* Whether colours are a row for each kind of grain, and no scale. */
bool oz_palette_is_by_type(const OzLook *look);

/* The colour of grain i; a grain without the quantity (the angle of a sphere, or of a square) is
 * grey. share: of every grain, 0 to 1, for OZ_COLOUR_ORDER (crystal of model/local_order.h),
 * _FORCE and _COORDINATION (draw/pressed.h); else NULL will do. */
void oz_palette_grain(const OzSnapshot *snapshot, const OzLook *look, const double *share,
                      int64_t i, float rgb[3]);

/* Where a scale ends that begins at 0: the smallest of 1, 2, 5 times a power of ten that is at
 * least x (x > 0). */
double oz_palette_round_up(double x);
