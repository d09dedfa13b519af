/* A run on its page (`--serve`): what a run's parts tell is put into the page's words. Nothing here
 * depends on whether somebody looks but the pictures' copies. */
#pragma once

#include "cli.h"
#include "draw/render_queue.h"
#include "observe/series.h"

typedef struct OzReload OzReload;
typedef struct OzServe OzServe;

/* Opens the page and prints its address, once, to the log's stream and not into log.txt. The
 * movie's frames, if there are any, come by the render queue, and what is set is asked of reload
 * (NULL: this run takes no changes), to which the page listens while it is open. Of several members
 * the first is shown. What is given is borrowed. */
OzStatus oz_serve_open(OzServe **serve, const OzOptions *options, const OzScene *scene,
                       OzReload *reload, OzRenderQueue *render_queue);

/* The run ends: done, or stopped for the reason that the status text gives. Closes; NULL is fine.
 */
void oz_serve_close(OzServe *serve, OzStatus status);

/* Another scene has taken over: the table of keys shows its values. NULL is fine. */
OzStatus oz_serve_renew(OzServe *serve);

/* Where the run is, and the scene that runs, from one thread; last_step 0 or INT64_MAX: it has no
 * end. NULL is fine. */
void oz_serve_show(OzServe *serve, const OzScene *scene, int64_t step, double time,
                   int64_t last_step);

/* Its grains have settled for so long, s, from the same thread. NULL is fine. */
void oz_serve_settle(OzServe *serve, double time);

/* The newest row, if there is one; the columns are told where they are others. NULL is fine. */
OzStatus oz_serve_row(OzServe *serve, const OzSeries *series);
