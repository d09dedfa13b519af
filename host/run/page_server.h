/* A small server of HTTP on 127.0.0.1 by libmicrohttpd, which is opened by dlopen by the first
 * server and by nothing else. It knows nothing of what it serves; it lets nobody in who was not
 * given the address:
 *
 *   - it is bound to the loopback alone; Host must name that (any port, so that `ssh -L` works), so
 *     a rebound DNS name is refused; an Origin, where there is one, must be the page's own;
 *   - every request needs ?token=, 128 random bits, compared in constant time;
 *   - a request names a row of the list of routes and nothing else; bodies are bounded;
 *   - connections are few, idle ones end, and none lives longer than a request may take;
 *   - answers may not be framed, kept or sniffed, and run no script but the page's own.
 *
 * Refused are 403 (host, origin, token, in this order and before anything else), 404, 405, 411 (a
 * body without a length) and 413. */
#pragma once

#include "base/status.h"

#include <stddef.h>

typedef struct OzPageServer OzPageServer;

typedef struct OzPageRequest {
    const char *argument; /* the route's own one, or NULL */
    const char *body;     /* "" without one               */
    const char *nonce;    /* a script or style of the answer runs where it has this */
} OzPageRequest;

/* Zeroed is an empty one; the server frees body. */
typedef struct OzPageAnswer {
    int code;         /* 0: 200                                      */
    const char *type; /* NULL: text/plain                            */
    char *body;       /* owned                                       */
    size_t length;
    long number; /* of the header X-Number; 0: none              */
} OzPageAnswer;

typedef struct OzPageRoute {
    const char *path, *method;
    const char *argument; /* of the query; NULL: none */
    void (*answer)(void *context, const OzPageRequest *request, OzPageAnswer *answer);
} OzPageRoute;

/* Serves routes (ending with a NULL path, borrowed, as is context) in threads of the library, until
 * closed; port 0 is a free one. Fails with OZ_ERR_FILE, saying what to do. */
OzStatus oz_page_server_open(OzPageServer **server, int port, const OzPageRoute *routes,
                             void *context);

/* "http://127.0.0.1:PORT/?token=TOKEN". */
const char *oz_page_server_address(const OzPageServer *server);

/* Ends all connections; NULL is fine. */
void oz_page_server_close(OzPageServer *server);
