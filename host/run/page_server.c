/* libmicrohttpd with a thread for each of a few connections, and one of ours that ends those that
 * are too slow. */
#include "run/page_server.h"

#include "base/clock.h"
#include "base/memory.h"
#include "base/thread.h"

#include <arpa/inet.h>
#include <dlfcn.h>
#include <errno.h>
#include <microhttpd.h>
#include <pthread.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/random.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

enum {
    BODY_MOST = 4096,   /* bytes; a change has some 50                                        */
    CONNECTIONS = 16,   /* a browser opens six                                                */
    IDLE = 5,           /* s without a byte                                                   */
    DEADLINE = 20,      /* s that a connection lives, however busily it drips                 */
    MEMORY = 16 * 1024, /* bytes for a request's line and headers                             */
    STACK = 512 * 1024, /* bytes of a connection's thread; a status text takes 16 kB in OZ_AFTER */
    TOKEN = 32          /* hexadecimal digits                                                 */
};

/* Every function of libmicrohttpd that is used. */
#define FUNCTIONS(F)                                                                               \
    F(MHD_start_daemon)                                                                            \
    F(MHD_stop_daemon)                                                                             \
    F(MHD_create_response_from_buffer) F(MHD_add_response_header) F(MHD_queue_response)            \
        F(MHD_destroy_response) F(MHD_lookup_connection_value) F(MHD_get_connection_info)
#define FUNCTION(function) __typeof__(function) *function;
static struct {
    FUNCTIONS(FUNCTION)
} mhd;

/* A connection that is open; free places have socket -1. */
typedef struct Guest {
    int socket;
    double since;
} Guest;

struct OzPageServer {
    const OzPageRoute *routes;
    void *context;
    struct MHD_Daemon *daemon;
    pthread_t reaper;
    pthread_mutex_t lock; /* of what follows */
    pthread_cond_t changed;
    bool has_reaper, closing;
    Guest guests[CONNECTIONS];
    char token[TOKEN + 1], address[80];
};

/* What is kept of a request between the library's calls. */
typedef struct Upload {
    size_t length;
    char body[BODY_MOST + 1];
} Upload;

static OzStatus load(void)
{
    static bool loaded;
    void *library = loaded ? NULL : dlopen("libmicrohttpd.so.12", RTLD_NOW | RTLD_LOCAL);
    if (!loaded && !library) {
        return oz_status_fail(OZ_ERR_FILE,
                              "--serve: cannot open libmicrohttpd: %s; install libmicrohttpd12",
                              dlerror());
    }
#define FIND(function)                                                                             \
    if (!loaded) {                                                                                 \
        void *address = dlsym(library, #function);                                                 \
        memcpy(&mhd.function, &address, sizeof address); /* ISO C has no cast for this */          \
        if (!address) {                                                                            \
            return oz_status_fail(OZ_ERR_FILE, "--serve: libmicrohttpd lacks " #function);         \
        }                                                                                          \
    }
    FUNCTIONS(FIND)
    loaded = true;
    return OZ_OK;
}

static OzStatus make_token(char token[TOKEN + 1])
{
    unsigned char bytes[TOKEN / 2];
    if (getrandom(bytes, sizeof bytes, 0) != (ssize_t)sizeof bytes) {
        return oz_status_fail(OZ_ERR_FILE, "--serve: no random bytes for a token: %s",
                              strerror(errno));
    }
    for (size_t i = 0; i < sizeof bytes; i++) {
        snprintf(token + 2 * i, 3, "%02x", bytes[i]);
    }
    return OZ_OK;
}

/* In the same time wherever they differ. */
static bool is_token(const char *token, const char *given)
{
    unsigned char difference = 0;
    if (!given || strlen(given) != TOKEN) {
        return false;
    }
    for (int i = 0; i < TOKEN; i++) {
        difference |= (unsigned char)(token[i] ^ given[i]);
    }
    return difference == 0;
}

/* The loopback's name, alone or with a port. */
static bool is_own_host(const char *host)
{
    static const char *const names[] = {"127.0.0.1", "localhost"};
    for (int i = 0; host && i < 2; i++) {
        size_t length = strlen(names[i]);
        if (strncmp(host, names[i], length) == 0) {
            const char *port = host + length;
            return !*port || (*port == ':' && port[1] && !port[1 + strspn(port + 1, "0123456789")]);
        }
    }
    return false;
}

static bool is_own_origin(const char *origin, const char *host)
{
    static const char scheme[] = "http://";
    size_t length = sizeof scheme - 1;
    return !origin || (strncmp(origin, scheme, length) == 0 && strcmp(origin + length, host) == 0);
}

static const char *header(struct MHD_Connection *connection, const char *name)
{
    return mhd.MHD_lookup_connection_value(connection, MHD_HEADER_KIND, name);
}

static const char *argument(struct MHD_Connection *connection, const char *name)
{
    return mhd.MHD_lookup_connection_value(connection, MHD_GET_ARGUMENT_KIND, name);
}

static void add_headers(struct MHD_Response *response, const OzPageAnswer *answer,
                        const char *nonce)
{
    char policy[400], number[32];
    snprintf(policy, sizeof policy,
             "default-src 'none'; script-src 'nonce-%s'; style-src 'nonce-%s'; img-src 'self' "
             "blob: data:; connect-src 'self'; base-uri 'none'; form-action 'none'; "
             "frame-ancestors 'none'",
             nonce, nonce);
    const char *const rows[][2] = {
        {"Content-Security-Policy", policy},
        {"Content-Type", answer->type ? answer->type : "text/plain; charset=utf-8"},
        {"Cache-Control", "no-store"},
        {"Referrer-Policy", "no-referrer"},
        {"X-Content-Type-Options", "nosniff"},
        {"X-Frame-Options", "DENY"},
        {"Cross-Origin-Resource-Policy", "same-origin"},
        {"Connection", "close"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        mhd.MHD_add_response_header(response, rows[i][0], rows[i][1]);
    }
    if (answer->number) {
        snprintf(number, sizeof number, "%ld", answer->number);
        mhd.MHD_add_response_header(response, "X-Number", number);
    }
}

/* The answer's body becomes the response's. */
static enum MHD_Result send_answer(struct MHD_Connection *connection, OzPageAnswer *answer,
                                   const char *nonce, const char *allow)
{
    unsigned code = answer->code ? (unsigned)answer->code : MHD_HTTP_OK;
    struct MHD_Response *response =
        mhd.MHD_create_response_from_buffer(answer->length, answer->body, MHD_RESPMEM_MUST_FREE);
    if (!response) {
        free(answer->body);
        return MHD_NO;
    }
    add_headers(response, answer, nonce);
    if (allow) {
        mhd.MHD_add_response_header(response, "Allow", allow);
    }
    enum MHD_Result result = mhd.MHD_queue_response(connection, code, response);
    mhd.MHD_destroy_response(response);
    return result;
}

static enum MHD_Result refuse(struct MHD_Connection *connection, int code, const char *why,
                              const char *allow)
{
    OzPageAnswer answer = {.code = code, .length = strlen(why)};
    answer.body = strdup(why);
    return answer.body ? send_answer(connection, &answer, "none", allow) : MHD_NO;
}

static const OzPageRoute *find_route(const OzPageServer *server, const char *path)
{
    const OzPageRoute *route = server->routes;
    while (route->path && strcmp(route->path, path) != 0) {
        route++;
    }
    return route->path ? route : NULL;
}

/* Why a caller is none of ours; NULL lets in. */
static const char *judge_caller(const OzPageServer *server, struct MHD_Connection *connection)
{
    const char *host = header(connection, "Host");
    if (!is_own_host(host)) {
        return "not served under this name\n";
    }
    if (!is_own_origin(header(connection, "Origin"), host)) {
        return "not served to other pages\n";
    }
    return is_token(server->token, argument(connection, "token")) ? NULL : "wrong token\n";
}

/* A request's beginning, no body read: *refused says whether it was answered here. */
static enum MHD_Result judge(const OzPageServer *server, struct MHD_Connection *connection,
                             const char *path, const char *method, bool *refused)
{
    const char *why = judge_caller(server, connection);
    const OzPageRoute *route = find_route(server, path);
    const char *length = header(connection, "Content-Length");
    *refused = true;
    if (why) {
        return refuse(connection, MHD_HTTP_FORBIDDEN, why, NULL);
    }
    if (!route) {
        return refuse(connection, MHD_HTTP_NOT_FOUND, "there is nothing here\n", NULL);
    }
    if (strcmp(route->method, method) != 0) {
        return refuse(connection, MHD_HTTP_METHOD_NOT_ALLOWED, "not this way\n", route->method);
    }
    if (header(connection, "Transfer-Encoding") || (!length && strcmp(method, "POST") == 0)) {
        return refuse(connection, MHD_HTTP_LENGTH_REQUIRED, "a length is needed\n", NULL);
    }
    if (length && strtoull(length, NULL, 10) > BODY_MOST) {
        return refuse(connection, MHD_HTTP_CONTENT_TOO_LARGE, "too long\n", NULL);
    }
    *refused = false;
    return MHD_YES;
}

static enum MHD_Result answer_request(const OzPageServer *server, struct MHD_Connection *connection,
                                      const char *path, const Upload *upload)
{
    const OzPageRoute *route = find_route(server, path);
    char nonce[TOKEN + 1];
    OzPageAnswer answer = {0};
    if (make_token(nonce) != OZ_OK) {
        return MHD_NO;
    }
    OzPageRequest request = {route->argument ? argument(connection, route->argument) : NULL,
                             upload->body, nonce};
    route->answer(server->context, &request, &answer);
    return send_answer(connection, &answer, nonce, NULL);
}

/* Called with the headers, with each part of a body, and with the end. */
static enum MHD_Result handle(void *context, struct MHD_Connection *connection, const char *path,
                              const char *method, const char *version, const char *data,
                              size_t *size, void **kept)
{
    const OzPageServer *server = context;
    Upload *upload = *kept;
    bool refused = false;
    (void)version;
    if (!upload) {
        enum MHD_Result result = judge(server, connection, path, method, &refused);
        if (!refused) {
            *kept = calloc(1, sizeof *upload);
            result = *kept ? MHD_YES : MHD_NO;
        }
        return result;
    }
    if (*size > 0) {
        if (*size > BODY_MOST - upload->length) {
            return MHD_NO;
        }
        memcpy(upload->body + upload->length, data, *size);
        upload->length += *size;
        *size = 0;
        return MHD_YES;
    }
    return answer_request(server, connection, path, upload);
}

static void forget(void *context, struct MHD_Connection *connection, void **kept,
                   enum MHD_RequestTerminationCode how)
{
    (void)context, (void)connection, (void)how;
    free(*kept);
    *kept = NULL;
}

/* A connection has come or is about to be closed. */
static void note_guest(void *context, struct MHD_Connection *connection, void **kept,
                       enum MHD_ConnectionNotificationCode what)
{
    OzPageServer *server = context;
    (void)kept;
    const union MHD_ConnectionInfo *info =
        mhd.MHD_get_connection_info(connection, MHD_CONNECTION_INFO_CONNECTION_FD);
    int socket = info ? info->connect_fd : -1;
    bool comes = what == MHD_CONNECTION_NOTIFY_STARTED;
    pthread_mutex_lock(&server->lock);
    for (int i = 0; i < CONNECTIONS; i++) {
        if (server->guests[i].socket == (comes ? -1 : socket)) {
            server->guests[i] = (Guest){comes ? socket : -1, oz_clock_now()};
            break;
        }
    }
    pthread_mutex_unlock(&server->lock);
}

/* Once a second; the library closes what was shut down here. */
static void *reap(void *context)
{
    OzPageServer *server = context;
    pthread_mutex_lock(&server->lock);
    while (!server->closing) {
        struct timespec until;
        clock_gettime(CLOCK_REALTIME, &until);
        until.tv_sec++;
        pthread_cond_timedwait(&server->changed, &server->lock, &until);
        for (int i = 0; i < CONNECTIONS; i++) {
            Guest *guest = &server->guests[i];
            if (guest->socket >= 0 && oz_clock_now() - guest->since > DEADLINE) {
                shutdown(guest->socket, SHUT_RDWR);
            }
        }
    }
    pthread_mutex_unlock(&server->lock);
    return NULL;
}

/* A listening socket on the loopback, and the port that it got. */
static OzStatus listen_on(int *listener, int *port)
{
    struct sockaddr_in address = {.sin_family = AF_INET, .sin_port = htons((uint16_t)*port)};
    socklen_t length = sizeof address;
    int on = 1;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    *listener = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (*listener < 0 || setsockopt(*listener, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on) != 0 ||
        bind(*listener, (struct sockaddr *)&address, length) != 0 ||
        listen(*listener, CONNECTIONS) != 0 ||
        getsockname(*listener, (struct sockaddr *)&address, &length) != 0) {
        return oz_status_fail(
            OZ_ERR_FILE,
            "--serve: cannot listen on 127.0.0.1, port %d: %s; give another port, "
            "or none for a free one",
            *port, strerror(errno));
    }
    *port = ntohs(address.sin_port);
    return OZ_OK;
}

static OzStatus start(OzPageServer *server, int listener)
{
    server->daemon = mhd.MHD_start_daemon(
        MHD_USE_THREAD_PER_CONNECTION | MHD_USE_INTERNAL_POLLING_THREAD | MHD_USE_POLL, 0, NULL,
        NULL, handle, server, MHD_OPTION_LISTEN_SOCKET, listener, MHD_OPTION_CONNECTION_LIMIT,
        (unsigned)CONNECTIONS, MHD_OPTION_CONNECTION_TIMEOUT, (unsigned)IDLE,
        MHD_OPTION_CONNECTION_MEMORY_LIMIT, (size_t)MEMORY, MHD_OPTION_THREAD_STACK_SIZE,
        (size_t)STACK, MHD_OPTION_NOTIFY_COMPLETED, forget, server, MHD_OPTION_NOTIFY_CONNECTION,
        note_guest, server, MHD_OPTION_END);
    if (!server->daemon) {
        close(listener);
        return oz_status_fail(OZ_ERR_FILE, "--serve: libmicrohttpd did not start: %s",
                              strerror(errno));
    }
    int code = oz_thread_start(&server->reaper, reap, server);
    server->has_reaper = code == 0;
    return code == 0 ? OZ_OK
                     : oz_status_fail(OZ_ERR_MEMORY, "--serve: cannot start a thread: %s",
                                      strerror(code));
}

OzStatus oz_page_server_open(OzPageServer **server, int port, const OzPageRoute *routes,
                             void *context)
{
    OzStatus status = OZ_OK;
    int listener = -1;
    OZ_PASS(OZ_NEW(server, 1));
    OzPageServer *s = *server;
    s->routes = routes;
    s->context = context;
    pthread_mutex_init(&s->lock, NULL);
    pthread_cond_init(&s->changed, NULL);
    for (int i = 0; i < CONNECTIONS; i++) {
        s->guests[i].socket = -1;
    }
    OZ_TRY(load());
    OZ_TRY(make_token(s->token));
    OZ_TRY(listen_on(&listener, &port));
    snprintf(s->address, sizeof s->address, "http://127.0.0.1:%d/?token=%s", port, s->token);
    status = start(s, listener);
    listener = -1;
done:
    if (status != OZ_OK) {
        if (listener >= 0) {
            close(listener);
        }
        oz_page_server_close(s);
        *server = NULL;
    }
    return status;
}

const char *oz_page_server_address(const OzPageServer *server)
{
    return server->address;
}

void oz_page_server_close(OzPageServer *server)
{
    if (!server) {
        return;
    }
    if (server->daemon) {
        mhd.MHD_stop_daemon(server->daemon);
    }
    pthread_mutex_lock(&server->lock);
    server->closing = true;
    pthread_cond_broadcast(&server->changed);
    pthread_mutex_unlock(&server->lock);
    if (server->has_reaper) {
        pthread_join(server->reaper, NULL);
    }
    pthread_cond_destroy(&server->changed);
    pthread_mutex_destroy(&server->lock);
    free(server);
}
