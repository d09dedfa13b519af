/* What drivers are told of building kernels, by their environment: where PoCL keeps those that it
 * has built (where it cannot write, it finds no device at all or ends the process), and that
 * Intel's for CPUs does not vectorize them, unless CL_CONFIG_CPU_VECTORIZER_MODE says otherwise. */
#pragma once

/* To be called before the first OpenCL call; later calls do nothing. Where PoCL's own choice
 * (POCL_CACHE_DIR, else XDG_CACHE_HOME, else HOME) cannot be written, a folder of this user's among
 * the temporary ones takes its place, and a warning says so. */
void oz_kernel_cache_choose(void);

/* Why there is no place to write, for the message that no device was found; "" when there is one.
 */
const char *oz_kernel_cache_trouble(void);
