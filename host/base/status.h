/* What a call came to, and the one text that says why. OZ_OK is 0 and nothing else means success.
 * The innermost place that knows the facts writes the text once with oz_status_fail (what was
 * wanted, what happened, where, what to try); callers pass the status on unchanged. The text is
 * a thread's own, as errno is, so several simulations may run in one process. */
#pragma once

#include <stdio.h>

typedef enum OzStatus {
    OZ_OK = 0,
    OZ_ERR_INPUT,      /* the user's file, key or option is wrong: exit status 2 */
    OZ_ERR_MEMORY,     /* host memory ran out                                    */
    OZ_ERR_FILE,       /* a file could not be read or written                    */
    OZ_ERR_DEVICE,     /* OpenCL: none, refused, build failed, stopped           */
    OZ_ERR_BLOWUP,     /* a guard found NaN, an escaped grain, a too deep overlap */
    OZ_ERR_GRAPHICS,   /* no off-screen GL context, a shader failed              */
    OZ_ERR_MOVIE,      /* libav missing or failed                                */
    OZ_ERR_INTERRUPTED /* a signal asked to end: exit status 130                 */
} OzStatus;

/* Records the text (printf style, no newline at its end) and returns status, so that a failing
 * function can write `return oz_status_fail(OZ_ERR_FILE, ...)`. A second call replaces the text. */
OzStatus oz_status_fail(OzStatus status, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* The text of this thread's last failure; "" when there was none. Valid until the next failure. */
const char *oz_status_text(void);

/* For studies, to which a refusal (OZ_ERR_INPUT) or a blow-up is an outcome: returns OZ_OK for
 * these two, else status. Of every failure reason receives the text, cut to size. */
OzStatus oz_status_outcome(OzStatus status, char *reason, size_t size);

/* The process's exit status for a status: 0, 1, 2 or 130. */
int oz_status_exit_code(OzStatus status);

/* Leaves the calling function when a call failed. OZ_TRY leaves it at its one exit label `done`,
 * where what the function owns is freed, with `status` set. OZ_PASS returns the failure at once:
 * for functions that own nothing. */
#define OZ_TRY(call)                                                                               \
    do {                                                                                           \
        status = (call);                                                                           \
        if (status != OZ_OK) {                                                                     \
            goto done;                                                                             \
        }                                                                                          \
    } while (0)
#define OZ_PASS(call)                                                                              \
    do {                                                                                           \
        OzStatus passed_ = (call);                                                                 \
        if (passed_ != OZ_OK) {                                                                    \
            return passed_;                                                                        \
        }                                                                                          \
    } while (0)

/* Calls `later` whatever status is. After a failure, status and its text stay that failure's; after
 * none, status becomes what `later` returned. */
#define OZ_AFTER(status, later)                                                                    \
    do {                                                                                           \
        char text_[16384];                                                                         \
        snprintf(text_, sizeof text_, "%s", oz_status_text());                                     \
        OzStatus later_ = (later);                                                                 \
        (status) = (status) == OZ_OK ? later_ : oz_status_fail((status), "%s", text_);             \
    } while (0)
