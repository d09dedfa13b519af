/* Requests to the page of a run, as bytes on a connection; TOKEN and PORT in them become the true
 * ones, or nothing would be let in. What is set changes a scene, as a run would have it. */
#include "fuzz_file.h"

#include "run/page.h"
#include "run/serve_keys.h"

#include <arpa/inet.h>
#include <errno.h>
#include <math.h>
#include <string.h>
#include <sys/socket.h>

enum { LONGEST = 20000 }; /* more than the server reads */

static const char text[] = "model: rods\n"
                           "time: {step: 1e-5, duration: 1}\n"
                           "contact: {contact_time: 6e-4, restitution: 0.4, friction: 0.1}\n"
                           "grains: [{kind: random, count: 3, diameter: 1e-3, aspect: 2}]\n";
static OzScene running;
static OzPage *page;
static int port;
static char token[33];

static bool set(void *context, const char *key, const char *value, char *message, size_t size)
{
    char setting[5000], *settings[] = {setting};
    OzScene next;
    (void)context;
    snprintf(setting, sizeof setting, "%s=%s", key, value);
    bool applied = oz_scene_change(&next, &running, settings, 1) == OZ_OK;
    snprintf(message, size, "%s", applied ? "" : oz_status_text());
    oz_scene_free(&next);
    return applied;
}

/* With a row and a picture, so that every answer has something in it. */
static void open_page(void)
{
    const char *const columns[] = {"time", "angle", "density"};
    const OzPageSettings settings = {.title = "fuzz", .set = set};
    char *png = calloc(1, 8);
    if (!png || oz_scene_parse(&running, "fuzz.yaml", text, NULL, 0) != OZ_OK ||
        oz_page_open(&page, &settings) != OZ_OK || oz_serve_keys_show(page, &running) != OZ_OK ||
        oz_page_show_columns(page, columns, 3) != OZ_OK ||
        sscanf(oz_page_address(page), "http://127.0.0.1:%d/?token=%32s", &port, token) != 2) {
        abort();
    }
    oz_page_show_row(page, (double[]){0, 1, NAN});
    oz_page_show_picture(page, png, 8);
    oz_page_show(page, &(OzPageStatus){.step = 1, .tap = NAN});
}

/* The bytes with the two words replaced; their length. */
static size_t fill_in(const uint8_t *bytes, size_t size, char *request)
{
    size_t length = 0;
    for (size_t i = 0; i < size && length < LONGEST; i++) {
        bool is_token = i + 5 <= size && memcmp(bytes + i, "TOKEN", 5) == 0;
        bool is_port = i + 4 <= size && memcmp(bytes + i, "PORT", 4) == 0;
        if (is_token || is_port) {
            length += is_token ? (size_t)sprintf(request + length, "%s", token)
                               : (size_t)sprintf(request + length, "%d", port);
            i += is_token ? 4 : 3;
        } else {
            request[length++] = (char)bytes[i];
        }
    }
    return length;
}

/* The fuzzer's own timer may interrupt it. */
static int connect_to_page(void)
{
    struct sockaddr_in to = {.sin_family = AF_INET, .sin_port = htons((uint16_t)port)};
    int handle = -1;
    bool connected = false;
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    while (!connected) {
        handle = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
        connected = connect(handle, (struct sockaddr *)&to, sizeof to) == 0;
        if (!connected && errno != EINTR) {
            perror("fuzz_page");
            abort();
        }
        if (!connected) {
            close(handle);
        }
    }
    return handle;
}

/* Until the server has answered and closed: leaks are looked for afterwards, and an answer that is
 * still being made would be taken for one. */
static void exchange(const char *request, size_t length)
{
    char answer[4096];
    ssize_t got = 1;
    int handle = connect_to_page();
    send(handle, request, length, MSG_NOSIGNAL);
    shutdown(handle, SHUT_WR);
    while (got > 0 || (got < 0 && errno == EINTR)) {
        got = recv(handle, answer, sizeof answer, 0);
    }
    close(handle);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    static char request[LONGEST + 40];
    if (!page) {
        open_page();
    }
    exchange(request, fill_in(bytes, size, request));
    return 0;
}
