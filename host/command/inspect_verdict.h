/* The first lines of `orzo check`: whether a run of the scene can be trusted, and what it costs. */
#pragma once

#include "cli.h"
#include "report/rehearsal.h"

#include <stdio.h>

/* What the verdict is about; all borrowed. */
typedef struct OzVerdict {
    const OzOptions *options;
    const OzScene *scene;
    const OzGrains *grains;
    const OzDevice *device;
    const OzRehearsal *rehearsal; /* as far as it came          */
    const char *burst;            /* why a guard stopped it there; "": none did */
} OzVerdict;

/* Prints restitution, stability, cost in wall time and memory, what single precision resolves, and
 * which columns stay empty. Draws two pictures to time those of a movie. */
OzStatus oz_inspect_verdict_print(FILE *file, const OzVerdict *verdict);
