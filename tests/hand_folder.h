/* A folder for the files that a test writes, and the comparison of numbers. */
#ifndef TESTS_HAND_FOLDER_H
#define TESTS_HAND_FOLDER_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char folder[] = "/tmp/orzo-test-XXXXXX";

static inline char *in_folder(const char *name)
{
    static char path[256];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

static inline void assert_near(double value, double expected, double tolerance)
{
    if (!(fabs(value - expected) <= tolerance)) {
        fail_msg("%.12g is not %.12g within %g", value, expected, tolerance);
    }
}

static inline int make_folder(void **state)
{
    (void)state;
    return mkdtemp(folder) ? 0 : -1;
}

/* names: what the tests wrote, ending with NULL. */
static inline int remove_folder(const char *const *names)
{
    for (; *names; names++) {
        remove(in_folder(*names));
    }
    return rmdir(folder);
}

#endif
