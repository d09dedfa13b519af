/* What the files of liborzo's calls share among themselves. */
#pragma once

#include "library/entry.h"
#include "library/orzo.h"
#include "library/session_start.h"

/* All of a call's function: enters, starts the session if need be, calls, leaves. */
#define ORZO_STARTED(sim, call)                                                                    \
    do {                                                                                           \
        OzEntry entry = oz_entry_enter(sim);                                                       \
        OzStatus status = oz_session_start_run(&(sim)->session);                                   \
        status = status == OZ_OK ? (call) : status;                                                \
        oz_entry_leave(&entry);                                                                    \
        return (OrzoStatus)status;                                                                 \
    } while (0)
