/* What drives a wall that holds a pressure, as a person wrote it. */
#pragma once

#include <stdbool.h>

/* Forces count along the wall's normal, into the bed. */
typedef struct OzServo {
    bool present;
    double pressure, force; /* Pa over the area that it closes, or N                 */
    double mass;            /* kg; 0: that of all grains                             */
    double damping;         /* kg/s                                                  */
    bool weight;            /* whether gravity pulls on it                           */
    bool has_pressure, has_force, has_damping; /* whether these were written, also as 0 */
} OzServo;
