/* Entering and leaving the library. */
#include "library/entry.h"

#include "base/memory.h"

#include <stdlib.h>

OzStatus oz_entry_create(struct OrzoSim **out)
{
    OzStatus status = OZ_OK;
    struct OrzoSim *sim = NULL;
    *out = NULL;
    OZ_TRY(OZ_NEW(&sim, 1));
    OZ_TRY(oz_log_create(&sim->log, NULL, false));
    sim->locale = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    if (!sim->locale) {
        status = oz_status_fail(OZ_ERR_MEMORY, "out of memory for a locale");
        goto done;
    }
    *out = sim;
    sim = NULL;
done:
    oz_entry_free(sim);
    return status;
}

void oz_entry_free(struct OrzoSim *sim)
{
    if (!sim) {
        return;
    }
    oz_session_free(&sim->session);
    oz_log_free(sim->log);
    if (sim->locale) {
        freelocale(sim->locale);
    }
    free(sim);
}

OzEntry oz_entry_enter(const struct OrzoSim *sim)
{
    return (OzEntry){oz_log_use(sim->log), uselocale(sim->locale)};
}

void oz_entry_leave(const OzEntry *entry)
{
    oz_log_use(entry->log);
    uselocale(entry->locale);
}
