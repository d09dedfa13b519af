/* Watching a scene file, and the one that it extends, in a thread: what is saved there is asked of
 * the run (run/reload.h) at once, whichever way an editor writes. */
#pragma once

#include "run/reload.h"

typedef struct OzWatch OzWatch;

/* The scene's file and base are watched from now on, by inotify on their folders and by a look at
 * them twice a second, which sees changes on network folders too. */
OzStatus oz_watch_start(OzWatch **watch, OzReload *reload, const OzScene *scene);

/* Ends the thread; NULL is fine. */
void oz_watch_end(OzWatch *watch);

/* The file as it is now, tried again a fifth of a second later if it cannot be taken, as an editor
 * may be about to finish it; then what became of it is said in the log
 * and to who listens. From any thread. */
void oz_watch_read(OzReload *reload);
