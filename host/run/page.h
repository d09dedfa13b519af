/* The page of a run (`--serve`): what is shown there is given to it; it knows nothing of the
 * simulation. Whatever is given is copied under a lock, which costs a run with nobody looking next
 * to nothing. From any thread.
 *
 *   GET /            the page itself
 *   GET /state       JSON: title, step, time, tap, done, stopped, progress, steps_per_second,
 *                    picture, rows, columns, log [{number, applied, text}], keys [{key, value,
 * unit, low, high, choices, help}] GET /frame.png   the newest picture; after=N: 204 while there is
 * none after number N, which the header X-Number tells GET /series      columns=a,b: {"columns":
 * [...], "rows": [[...], ...]} POST /set        {"key": ..., "value": ...}: {"applied": bool,
 * "message": ...}
 *
 * each with ?token=. */
#pragma once

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct OzPage OzPage;

typedef struct OzPageSettings {
    int port;          /* 0: a free one            */
    const char *title; /* of the run, copied       */
    const char *source_dir;
    /* Sets one key: whether it was applied, and what changed or why not. Called in a thread of the
     * page, several at once; it returns within some seconds. NULL: nothing can be set. */
    bool (*set)(void *context, const char *key, const char *value, char *message, size_t size);
    void *context;
} OzPageSettings;

typedef struct OzPageStatus {
    int64_t step;
    double time, tap; /* s, 1; NAN: there are no taps         */
    double progress;  /* 0 to 1; NAN: the run has no end      */
    double settling;  /* s so far, before time 0; 0: it is over */
    double steps_per_second;
    bool done, stopped; /* to the end; ended before it          */
} OzPageStatus;

/* A key that may be set. Texts are copied. */
typedef struct OzPageKey {
    const char *key, *value, *unit, *help; /* value as YAML; empty: none     */
    double low, high;                      /* NAN: no number                 */
    const char *const *choices;            /* ending with NULL; NULL: none   */
} OzPageKey;

OzStatus oz_page_open(OzPage **page, const OzPageSettings *settings);
const char *oz_page_address(const OzPage *page);

/* The page's end. Whoever looks may take a second to see the last status. NULL is fine. */
void oz_page_close(OzPage *page);

/* What the run is at. */
void oz_page_show(OzPage *page, const OzPageStatus *status);

/* Whether somebody asked for a picture within the last second: only then is one to be drawn. */
bool oz_page_wants_picture(OzPage *page);

/* A whole PNG file in memory of malloc, which becomes the page's. */
void oz_page_show_picture(OzPage *page, char *png, size_t length);

/* The table of keys, instead of the one before. */
OzStatus oz_page_show_keys(OzPage *page, const OzPageKey *keys, int count);

/* A line of the log of changes. */
void oz_page_say(OzPage *page, bool applied, const char *text);

/* The columns of rows, again when they are others, and a row of them (NAN: an empty cell). Of a
 * long run every 2nd, 4th,
 * ... row is kept. */
OzStatus oz_page_show_columns(OzPage *page, const char *const *names, int count);
void oz_page_show_row(OzPage *page, const double *values);
