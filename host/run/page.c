/* What the page shows, kept under one lock, and the answers made of it. */
#include "run/page.h"

#include "base/clock.h"
#include "base/embed.h"
#include "base/memory.h"
#include "run/page_json.h"
#include "run/page_rows.h"
#include "run/page_server.h"

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum {
    LINES = 100,      /* of the log of changes              */
    LINE_SIZE = 1000, /* bytes                              */
    KEY_SIZE = 2048   /* of a change's key and value        */
};

typedef struct Line {
    bool applied;
    char text[LINE_SIZE];
} Line;

struct OzPage {
    OzPageSettings settings;
    OzPageServer *server;
    char *title, *html;
    pthread_mutex_t lock; /* of what follows */
    OzPageStatus status;
    double looked, picture_asked; /* when; clock                                     */
    bool last_seen;               /* a status with done or stopped was answered      */
    char *png;
    size_t png_length;
    long png_number; /* of pictures so far                              */
    char *keys;      /* JSON                                            */
    Line lines[LINES];
    long line_count; /* so far; the last ones are kept                  */
    OzPageRows rows;
};

static void lock(OzPage *page)
{
    pthread_mutex_lock(&page->lock);
}

static void unlock(OzPage *page)
{
    pthread_mutex_unlock(&page->lock);
}

/* Ends a stream in memory; without memory the answer is 500. */
static void finish(FILE *file, OzPageAnswer *answer)
{
    if (fclose(file) != 0) {
        free(answer->body);
        *answer = (OzPageAnswer){.code = 500};
    }
}

static FILE *begin(OzPageAnswer *answer)
{
    FILE *file = open_memstream(&answer->body, &answer->length);
    answer->type = "application/json";
    answer->code = file ? 200 : 500;
    return file;
}

static void print_log(const OzPage *page, FILE *file)
{
    long first = page->line_count > LINES ? page->line_count - LINES : 0;
    for (long i = first; i < page->line_count; i++) {
        const Line *line = &page->lines[i % LINES];
        fprintf(file, "%s{\"number\": %ld, \"applied\": %s, \"text\": ", i > first ? ", " : "",
                i + 1, line->applied ? "true" : "false");
        oz_page_json_text(file, line->text);
        fputc('}', file);
    }
}

static void print_state(const OzPage *page, FILE *file)
{
    const OzPageStatus *s = &page->status;
    const struct {
        const char *name;
        double value;
    } numbers[] = {{"time", s->time},
                   {"tap", s->tap},
                   {"progress", s->progress},
                   {"settling", s->settling},
                   {"steps_per_second", s->steps_per_second}};
    fputs("{\"title\": ", file);
    oz_page_json_text(file, page->title);
    fprintf(file, ", \"step\": %lld, \"done\": %s, \"stopped\": %s", (long long)s->step,
            s->done ? "true" : "false", s->stopped ? "true" : "false");
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        fprintf(file, ", \"%s\": ", numbers[i].name);
        oz_page_json_number(file, numbers[i].value);
    }
    fprintf(file, ", \"picture\": %ld, \"rows\": %lld, \"columns\": ", page->png_number,
            (long long)page->rows.count);
    oz_page_rows_print_names(&page->rows, file);
    fputs(", \"log\": [", file);
    print_log(page, file);
    fprintf(file, "], \"keys\": %s}\n", page->keys ? page->keys : "[]");
}

static void answer_state(void *context, const OzPageRequest *request, OzPageAnswer *answer)
{
    OzPage *page = context;
    FILE *file = begin(answer);
    (void)request;
    if (!file) {
        return;
    }
    lock(page);
    page->looked = oz_clock_now();
    page->last_seen = page->status.done || page->status.stopped;
    print_state(page, file);
    unlock(page);
    finish(file, answer);
}

static void answer_frame(void *context, const OzPageRequest *request, OzPageAnswer *answer)
{
    OzPage *page = context;
    long after = request->argument ? strtol(request->argument, NULL, 10) : 0;
    lock(page);
    page->picture_asked = oz_clock_now();
    answer->number = page->png_number;
    answer->code = page->png_number > 0 && page->png_number != after ? 200 : 204;
    if (answer->code == 200) {
        answer->type = "image/png";
        answer->length = page->png_length;
        answer->body = malloc(page->png_length);
        if (answer->body) {
            memcpy(answer->body, page->png, page->png_length);
        } else {
            *answer = (OzPageAnswer){.code = 500};
        }
    }
    unlock(page);
}

static void answer_series(void *context, const OzPageRequest *request, OzPageAnswer *answer)
{
    OzPage *page = context;
    FILE *file = begin(answer);
    if (!file) {
        return;
    }
    lock(page);
    page->looked = oz_clock_now();
    oz_page_rows_print(&page->rows, request->argument, file);
    unlock(page);
    finish(file, answer);
}

static void answer_set(void *context, const OzPageRequest *request, OzPageAnswer *answer)
{
    OzPage *page = context;
    char key[KEY_SIZE], value[KEY_SIZE], message[LINE_SIZE] = "this run takes no changes";
    bool applied = false, is_read = oz_page_json_change(request->body, key, value, KEY_SIZE);
    FILE *file = begin(answer);
    if (!file) {
        return;
    }
    if (!is_read) {
        answer->code = 400;
        snprintf(message, sizeof message, "expected {\"key\": ..., \"value\": ...}");
    } else if (page->settings.set) {
        message[0] = '\0';
        applied = page->settings.set(page->settings.context, key, value, message, sizeof message);
    }
    fprintf(file, "{\"applied\": %s, \"message\": ", applied ? "true" : "false");
    oz_page_json_text(file, message);
    fputs("}\n", file);
    finish(file, answer);
    if (is_read) {
        oz_page_say(page, applied, message);
    }
}

/* The page with every NONCE in it replaced. */
static void answer_page(void *context, const OzPageRequest *request, OzPageAnswer *answer)
{
    static const char mark[] = "NONCE";
    OzPage *page = context;
    FILE *file = begin(answer);
    if (!file) {
        return;
    }
    answer->type = "text/html; charset=utf-8";
    const char *at = page->html;
    for (const char *next; (next = strstr(at, mark)) != NULL; at = next + sizeof mark - 1) {
        fwrite(at, 1, (size_t)(next - at), file);
        fputs(request->nonce, file);
    }
    fputs(at, file);
    finish(file, answer);
}

static const OzPageRoute ROUTES[] = {
    {"/", "GET", NULL, answer_page},
    {"/state", "GET", NULL, answer_state},
    {"/frame.png", "GET", "after", answer_frame},
    {"/series", "GET", "columns", answer_series},
    {"/set", "POST", NULL, answer_set},
    {NULL, NULL, NULL, NULL},
};

OzStatus oz_page_open(OzPage **page, const OzPageSettings *settings)
{
    OzStatus status = OZ_OK;
    OZ_PASS(OZ_NEW(page, 1));
    OzPage *p = *page;
    p->settings = *settings;
    p->looked = p->picture_asked = -INFINITY;
    pthread_mutex_init(&p->lock, NULL);
    OZ_TRY(oz_memory_text(&p->title, settings->title));
    OZ_TRY(oz_embed_read(&p->html, settings->source_dir, "host/run/page.html"));
    OZ_TRY(oz_page_server_open(&p->server, settings->port, ROUTES, p));
done:
    if (status != OZ_OK) {
        oz_page_close(p);
        *page = NULL;
    }
    return status;
}

const char *oz_page_address(const OzPage *page)
{
    return oz_page_server_address(page->server);
}

/* Until who looks has seen how the run ended, for a second and a half at most. */
static void linger(OzPage *page)
{
    for (int i = 0; i < 75; i++) {
        lock(page);
        bool waits = (page->status.done || page->status.stopped) && !page->last_seen &&
                     oz_clock_now() - page->looked < 2;
        unlock(page);
        if (!waits) {
            break;
        }
        nanosleep(&(struct timespec){.tv_nsec = 20000000}, NULL);
    }
}

void oz_page_close(OzPage *page)
{
    if (!page) {
        return;
    }
    linger(page);
    oz_page_server_close(page->server);
    oz_page_rows_free(&page->rows);
    free(page->keys);
    free(page->png);
    free(page->html);
    free(page->title);
    pthread_mutex_destroy(&page->lock);
    free(page);
}

void oz_page_show(OzPage *page, const OzPageStatus *status)
{
    lock(page);
    page->status = *status;
    unlock(page);
}

bool oz_page_wants_picture(OzPage *page)
{
    lock(page);
    bool wants = oz_clock_now() - page->picture_asked < 1;
    unlock(page);
    return wants;
}

void oz_page_show_picture(OzPage *page, char *png, size_t length)
{
    lock(page);
    free(page->png);
    page->png = png;
    page->png_length = length;
    page->png_number++;
    unlock(page);
}

void oz_page_say(OzPage *page, bool applied, const char *text)
{
    lock(page);
    Line *line = &page->lines[page->line_count++ % LINES];
    line->applied = applied;
    snprintf(line->text, sizeof line->text, "%s", text);
    unlock(page);
}

static void print_key(FILE *file, const OzPageKey *key)
{
    fputs("{\"key\": ", file);
    oz_page_json_text(file, key->key);
    fputs(", \"value\": ", file);
    oz_page_json_value(file, key->value);
    fputs(", \"unit\": ", file);
    oz_page_json_text(file, key->unit);
    fputs(", \"low\": ", file);
    oz_page_json_number(file, key->low);
    fputs(", \"high\": ", file);
    oz_page_json_number(file, key->high);
    fputs(", \"choices\": [", file);
    for (int i = 0; key->choices && key->choices[i]; i++) {
        fputs(i ? ", " : "", file);
        oz_page_json_text(file, key->choices[i]);
    }
    fputs("], \"help\": ", file);
    oz_page_json_text(file, key->help);
    fputc('}', file);
}

static OzStatus end_text(FILE *file, char **text)
{
    if (file && fclose(file) == 0) {
        return OZ_OK;
    }
    free(*text);
    *text = NULL;
    return oz_status_fail(OZ_ERR_MEMORY, "out of memory for the page");
}

OzStatus oz_page_show_keys(OzPage *page, const OzPageKey *keys, int count)
{
    char *text = NULL;
    size_t length = 0;
    FILE *file = open_memstream(&text, &length);
    for (int i = 0; file && i < count; i++) {
        fputs(i ? ", " : "[", file);
        print_key(file, &keys[i]);
    }
    if (file) {
        fputs(count ? "]" : "[]", file);
    }
    OZ_PASS(end_text(file, &text));
    lock(page);
    free(page->keys);
    page->keys = text;
    unlock(page);
    return OZ_OK;
}

OzStatus oz_page_show_columns(OzPage *page, const char *const *names, int count)
{
    lock(page);
    OzStatus status = oz_page_rows_open(&page->rows, names, count);
    unlock(page);
    return status;
}

void oz_page_show_row(OzPage *page, const double *values)
{
    lock(page);
    oz_page_rows_add(&page->rows, values);
    unlock(page);
}
