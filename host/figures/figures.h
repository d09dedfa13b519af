/* `orzo figures`: a paper's figures from its runs. */
#pragma once

#include "cli.h"

/* Runs what the study of options->paths[0] has not yet, and draws its figures (with --only one of
 * them): pictures and the numbers in them, NAME.png and NAME.csv. A figure that fails is said, and
 * the others follow. A signal ends it in order and says how to go on. Fails with OZ_ERR_INPUT for a
 * study that is wrong, before anything is touched. */
OzStatus oz_figures_run(const OzOptions *options);
