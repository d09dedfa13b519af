/* What is wrong with a scene, gathered while it is read so that a person gets every error at once,
 * in file order. Running out of memory while gathering is kept and reported in place of the errors.
 */
#pragma once

#include "base/status.h"

#include <stdbool.h>

/* Where a value was written. */
typedef struct OzSource {
    const char *name; /* the file as given, or "--set key=value"; borrowed       */
    char *folder;     /* of the file, NULL for the working folder; owned         */
    int rank;         /* the scene, what it extends, then the settings, in order */
    bool setting;     /* given with --set: there are no lines                    */
} OzSource;

typedef struct OzFault {
    int rank, line;
    char *text;
} OzFault;

typedef struct OzFaults {
    OzFault *rows;
    int count;
    int left_out; /* beyond the most that are kept */
    int misspelt; /* of these, unknown keys that are nearly a known one */
    bool no_memory;
} OzFaults;

/* Adds `name:line: text`; the text is printf style: what is wrong; what was expected. */
void oz_faults_add(OzFaults *faults, const OzSource *source, int line, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* Whether a fault is of the value at path, or of one in it. */
bool oz_faults_name(const OzFaults *faults, const char *path);

/* OZ_OK without any fault; otherwise fails with OZ_ERR_INPUT and every fault on its own line. */
OzStatus oz_faults_report(OzFaults *faults);

/* Forgets every fault; a zeroed list is fine. */
void oz_faults_free(OzFaults *faults);
