/* Work in a process of its own: its threads, its memory and its crashes end with it. OpenCL's
 * threads can be limited only before a process's first OpenCL call, so every benchmark row runs
 * apart, and the process that starts them makes no OpenCL call at all. */
#pragma once

#include "base/status.h"

#include <stddef.h>

/* Calls work(context) in a child process and waits. The child sees the caller's memory as it was;
 * only result (size bytes, no pointers in it) comes back. Fails as work does, with its text, or
 * with OZ_ERR_DEVICE when the child ended otherwise. */
OzStatus oz_subprocess_run(OzStatus (*work)(void *context), void *context, void *result,
                           size_t size);
