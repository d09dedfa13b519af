/* What the parts of a step of trigrains cost, each timed by itself on a simulation that stands
 * still. For `orzo bench`. */
#pragma once

#include "sim/sim.h"

/* THE list of parts: name, kernel, the kernel whose time is taken off (NULL: none). */
#define OZ_ELEMENT_STAGES(X)                                                                       \
    X(PREDICT, "predictor", "oz_repeat_predict_correct", "oz_repeat_correct")                      \
    X(CLASSIFY, "classifying", "oz_repeat_classify", NULL)                                         \
    X(CONTACTS, "contact forces", "oz_repeat_contacts", NULL)                                      \
    X(BEAMS, "beams", "oz_repeat_beams", NULL)                                                     \
    X(LOADS, "adding up", "oz_repeat_loads", NULL)                                                 \
    X(CORRECT, "corrector", "oz_repeat_correct", NULL)                                             \
    X(REFRESH, "inner list", "oz_repeat_refresh", NULL)                                            \
    X(REBUILD, "outer list", "oz_repeat_rebuild", "oz_repeat_refresh")

typedef enum OzElementPhase {
#define OZ_ELEMENT_STAGES_ID(id, name, kernel, less) OZ_ELEMENT_PHASE_##id,
    OZ_ELEMENT_STAGES(OZ_ELEMENT_STAGES_ID)
#undef OZ_ELEMENT_STAGES_ID
        OZ_ELEMENT_PHASE_COUNT
} OzElementPhase;

/* "classifying" */
const char *oz_element_stage_timing_name(OzElementPhase phase);

/* Seconds (of a CPU: processor time) of doing each once for all elements of the first member.
 * Afterwards every array of the device holds the same bits as before, and the simulation can go on.
 */
OzStatus oz_element_stage_timing_measure(double seconds[OZ_ELEMENT_PHASE_COUNT], OzSim *sim,
                                         const char *source_dir);
