/* The failure text of each thread. Knows nothing of what failed. */
#include "base/status.h"

#include <stdarg.h>
#include <stdio.h>

/* Long enough for a scene file with dozens of errors; a longer text is cut, never overrun. */
static _Thread_local char text[16384];

OzStatus oz_status_fail(OzStatus status, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    return status;
}

const char *oz_status_text(void)
{
    return text;
}

int oz_status_exit_code(OzStatus status)
{
    switch (status) {
    case OZ_OK:
        return 0;
    case OZ_ERR_INPUT:
        return 2;
    case OZ_ERR_INTERRUPTED:
        return 130;
    default:
        return 1;
    }
}

OzStatus oz_status_outcome(OzStatus status, char *reason, size_t size)
{
    if (status != OZ_OK) {
        snprintf(reason, size, "%.*s", (int)size - 1, oz_status_text());
    }
    return status == OZ_ERR_BLOWUP || status == OZ_ERR_INPUT ? OZ_OK : status;
}
