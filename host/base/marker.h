/* The marker of a folder that orzo writes into: a text, the file .orzo. Its first line is
 * OZ_MARKER_HEAD, its second "pid N" of the process that wrote it last. Every further line names
 * what orzo has written there, relative to the folder; a folder with a marker of its own has a
 * slash at its end. */
#pragma once

#include "base/status.h"

#include <stdbool.h>

#define OZ_MARKER      ".orzo"
#define OZ_MARKER_HEAD "orzo's folder: what orzo wrote here, one name a line"

enum { OZ_MARKER_NAME = 512 }; /* bytes of the longest name, its zero included */

/* Zeroed: there is none. */
typedef struct OzMarker {
    char *text;        /* the whole file; the caller frees it */
    const char *names; /* in text: the lines of names         */
} OzMarker;

/* A folder without a marker gives a zeroed one. Refuses a file .orzo that is no marker. */
OzStatus oz_marker_read(OzMarker *marker, const char *folder);

/* A process that holds a lock on the marker of this descriptor: as the system tells, or the one
 * that wrote it last, if it lives; 0 when neither is known. */
long oz_marker_holder(int descriptor);

/* Copies the next name from *at, which starts as marker->names; false at the end. */
bool oz_marker_next(const char **at, char name[OZ_MARKER_NAME]);

bool oz_marker_has(const OzMarker *marker, const char *name);

/* Removes what the folder's marker names and one of the patterns (fnmatch; NULL: any) fits, and in named folders what their own markers name; a
 * folder stays when something else is in it. Follows no link. The folder's own marker stays. */
OzStatus oz_marker_clean(const char *folder, const char *const *patterns);
