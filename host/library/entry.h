/* What a call of the library does to its thread while it lasts: the simulation's log, and the C
 * locale's numbers, whatever the program around it has chosen. */
#pragma once

#include "base/log.h"
#include "library/session.h"

#include <locale.h>

/* What stands behind the library's OrzoSim. */
struct OrzoSim {
    OzSession session;
    OzLog *log;      /* without a stream; with a file once one was asked for */
    locale_t locale; /* "C"                                                  */
};

/* Of the thread before the call. */
typedef struct OzEntry {
    OzLog *log;
    locale_t locale;
} OzEntry;

/* Makes room for a simulation: a log, a locale, an empty session. On failure *sim is NULL. */
OzStatus oz_entry_create(struct OrzoSim **sim);
void oz_entry_free(struct OrzoSim *sim); /* NULL is fine; between enter and leave of another one */

OzEntry oz_entry_enter(const struct OrzoSim *sim);
void oz_entry_leave(const OzEntry *entry);
