/* The part of a spherocylinder below a level plane, in closed form. */
#pragma once

/* Volume, m^3, of the part of a spherocylinder that lies below `height` (m, measured from its
 * centre). axis_z is the z component of its unit axis; length 0 is a sphere. Exact up to rounding:
 * about 1e-10 of the volume. */
double oz_clip_below(double diameter, double length, double axis_z, double height);
