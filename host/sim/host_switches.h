/* What the kernels' switches are on the host: constants of a program on a device, here the values
 * of one scene, for one thread and as long as a block lasts. Whoever calls physics by sim/dialect.h
 * or sim/element_dialect.h says so first; nothing else sets them. */
#pragma once

#include "sim/switches.h"

typedef struct OzHostSwitches {
    OzSwitches rods;
    bool field, midpoint, balanced; /* trigrains: triangles' contacts have a potential; the force
                                       point of those that have not; beams' damping moments are
                                       balanced by a shear force */
} OzHostSwitches;

extern _Thread_local OzHostSwitches oz_host_switches_now;

/* Sets those of rods, or of trigrains; returns what was before, which leave puts back. */
OzHostSwitches oz_host_switches_rods(const OzSwitches *switches);
OzHostSwitches oz_host_switches_elements(const OzScene *scene);
void oz_host_switches_leave(const OzHostSwitches *before);

/* For the rest of the block, however it is left: OZ_USE_SWITCHES(oz_host_switches_rods(...)); It
 * stands where no goto jumps over it: what was before would not be known where the block is left.
 */
#define OZ_USE_SWITCHES(entered)                                                                   \
    const OzHostSwitches switches_before                                                           \
        __attribute__((cleanup(oz_host_switches_leave), unused)) = (entered)
