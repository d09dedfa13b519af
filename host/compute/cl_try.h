/* OpenCL error codes as names, and the macro that turns a failing call into a status. */
#pragma once

#include "base/status.h"

#include <CL/cl.h>

/* "CL_OUT_OF_RESOURCES"; "unknown OpenCL error" for what the standard does not name. */
const char *oz_cl_try_name(cl_int code);

/* Fails with OZ_ERR_DEVICE, naming the code, the call and where it stands. */
OzStatus oz_cl_try_fail(cl_int code, const char *call, const char *file, int line);

/* As OZ_TRY, for an OpenCL call that returns its code. */
#define CL_TRY(call)                                                                               \
    do {                                                                                           \
        cl_int cl_code_ = (call);                                                                  \
        if (cl_code_ != CL_SUCCESS) {                                                              \
            status = oz_cl_try_fail(cl_code_, #call, __FILE__, __LINE__);                          \
            goto done;                                                                             \
        }                                                                                          \
    } while (0)
