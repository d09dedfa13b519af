/* `orzo check`: what follows from a scene before it is run. */
#pragma once

#include "cli.h"

#include <stdio.h>

/* Prints to file: the verdict (inspect_verdict.h), then what it rests on: grains, walls, contacts
 * with predicted restitution and stability margin, the settled bed; with --verbose kernel switches,
 * what is left out and device memory. Settles the bed and makes its first steps, for some seconds
 * at most. Then fails as a run would before its first step, with the same text in the log:
 * OZ_ERR_INPUT (exit status 2) for an unstable step, unless
 * --force; of a sweep, when any member would be refused; OZ_ERR_BLOWUP where a guard stops the
 * first steps. A bed whose own limit lies below the step is a warning, as it is in a run. */
OzStatus oz_inspect_scene(const OzOptions *options, FILE *file);
