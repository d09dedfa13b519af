/* OpenCL error codes as names, and the macro that turns a failing call into a status. */
#pragma once

#include "base/status.h"

#include <CL/cl.h>

/* "CL_OUT_OF_RESOURCES"; "unknown OpenCL error" for what the standard does not name. */
const char *oz_cl_try_name(cl_int code);

/* OZ_OK for CL_SUCCESS; else fails with OZ_ERR_DEVICE, naming the code, the call and where it
 * stands.
 */
OzStatus oz_cl_try_check(cl_int code, const char *call, const char *file, int line);

/* As OZ_TRY and OZ_PASS, for an OpenCL call that returns its code. */
#define CL_TRY(call)  OZ_TRY(oz_cl_try_check((call), #call, __FILE__, __LINE__))
#define CL_PASS(call) OZ_PASS(oz_cl_try_check((call), #call, __FILE__, __LINE__))

/* Releases a Kernel, a Program or a MemObject; nothing for NULL. */
#define CL_RELEASE(Kind, object) ((void)((object) ? clRelease##Kind(object) : CL_SUCCESS))
