/* A page with made-up data, and a client that speaks raw HTTP to it. */
#pragma once

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "run/page.h"

#include <arpa/inet.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

#define CHANGE "{\"key\": \"contact.friction\", \"value\": 0.3}"

static OzPage *page;
static int port;
static char token[33], answer[1 << 19], more_arguments[64];

#ifndef OZ_TESTS_PROGRAM_H /* which has it too */
static inline double now_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}
#endif

static inline void client_open_page(bool (*set)(void *, const char *, const char *, char *, size_t))
{
    static const char *const laws[] = {"hooke", "hertz", NULL};
    const OzPageKey keys[] = {
        {"contact.friction", "0.1", "", "Coulomb's coefficient", 0, 10, NULL},
        {"contact.contact_time", "6e-4", "s", "duration of a free hit", 1e-9, 1, NULL},
        {"contact.law", "hooke", "", "from overlap to force", NAN, NAN, laws},
        {"gravity", "[0, 0, -9.81]", "m/s^2", "acceleration of all grains", -1e6, 1e6, NULL}};
    const char *const columns[] = {"time", "angle", "density"};
    OzPageSettings settings = {.title = "a <bed>", .set = set};
    if (oz_page_open(&page, &settings) != OZ_OK) {
        fail_msg("%s", oz_status_text());
    }
    assert_int_equal(sscanf(oz_page_address(page), "http://127.0.0.1:%d/?token=%32s", &port, token),
                     2);
    assert_int_equal(strlen(token), 32);
    assert_int_equal(oz_page_show_keys(page, keys, 4), OZ_OK);
    assert_int_equal(oz_page_show_columns(page, columns, 3), OZ_OK);
    oz_page_show(
        page,
        &(OzPageStatus){
            .step = 1234, .time = 0.5, .tap = NAN, .progress = 0.25, .steps_per_second = 20000});
}

/* A connected socket, or -1. */
static inline int client_try(void)
{
    struct sockaddr_in to = {.sin_family = AF_INET, .sin_port = htons((uint16_t)port)};
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    int handle = socket(AF_INET, SOCK_STREAM, 0);
    if (connect(handle, (struct sockaddr *)&to, sizeof to) != 0) {
        close(handle);
        return -1;
    }
    return handle;
}

static inline int client_connect(void)
{
    int handle = client_try();
    assert_true(handle >= 0);
    return handle;
}

static inline int client_request(char *request, size_t size, const char *method, const char *path,
                                 const char *with_token, const char *lines, const char *body)
{
    char length[64] = "";
    if (*body) {
        snprintf(length, sizeof length, "Content-Length: %zu\r\n", strlen(body));
    }
    return snprintf(request, size, "%s %s?token=%s%s HTTP/1.1\r\nHost: 127.0.0.1:%d\r\n%s%s\r\n%s",
                    method, path, with_token, more_arguments, port, lines, length, body);
}

/* Sends the bytes and reads into `answer` until the server closes or ten seconds have passed. */
static inline void client_exchange(const char *request, size_t length)
{
    int handle = client_try(); /* the server may have ended just now: an empty answer */
    size_t got = 0;
    ssize_t part = 0;
    struct timeval limit = {.tv_sec = 10};
    setsockopt(handle, SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
    send(handle, request, length, MSG_NOSIGNAL);
    while (got < sizeof answer - 1 &&
           (part = recv(handle, answer + got, sizeof answer - 1 - got, 0)) > 0) {
        got += (size_t)part;
    }
    answer[got] = '\0';
    close(handle);
}

/* The same without an answer that matters: the client's side is closed at once. */
static inline void send_and_leave(const char *request, size_t length)
{
    int handle = client_connect();
    char rest[256];
    send(handle, request, length, MSG_NOSIGNAL);
    shutdown(handle, SHUT_WR);
    while (recv(handle, rest, sizeof rest, 0) > 0) {
    }
    close(handle);
}

static inline const char *ask(const char *method, const char *path, const char *with_token,
                              const char *lines, const char *body)
{
    static char request[8192];
    int length = client_request(request, sizeof request, method, path, with_token, lines, body);
    client_exchange(request, (size_t)length);
    return answer;
}

static inline void expect_answer(int code, const char *request)
{
    int got = 0;
    client_exchange(request, strlen(request));
    if (sscanf(answer, "HTTP/1.1 %d", &got) != 1 || got != code) {
        fail_msg("not %d, but \"%.300s\" to\n%.300s", code, answer, request);
    }
}

static inline void expect_code(int code, const char *method, const char *path,
                               const char *with_token, const char *lines, const char *body)
{
    static char request[8192];
    client_request(request, sizeof request, method, path, with_token, lines, body);
    expect_answer(code, request);
}

static inline const char *origin_line(const char *origin, int of_port)
{
    static char line[80];
    snprintf(line, sizeof line, "Origin: %s:%d\r\n", origin, of_port);
    return line;
}
