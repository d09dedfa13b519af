/* The physics of elements compiled for the host: real is double, and the switches that are
 * constants on a device are those of sim/host_switches.h. For .c files alone. */
#pragma once

#include "sim/element_laws.h"
#include "sim/host_switches.h"

#define OZ_TRIANGLE_FIELD oz_host_switches_now.field
#define OZ_FORCE_POINT    oz_host_switches_now.midpoint
#define OZ_DAMPING_SHEAR  oz_host_switches_now.balanced

#include "kernels/beam_strength.h"
#include "kernels/beam_yield.h"
#include "kernels/disc.h"
#include "kernels/triangle_field.h"
