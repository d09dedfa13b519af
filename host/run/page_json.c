/* Writing goes to a stream; reading is by hand, for one small object. */
#include "run/page_json.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

void oz_page_json_text(FILE *file, const char *text)
{
    fputc('"', file);
    for (; *text; text++) {
        unsigned char c = (unsigned char)*text;
        if (c < ' ' || c == '<') {
            fprintf(file, "\\u%04x", c);
        } else {
            fprintf(file, c == '"' || c == '\\' ? "\\%c" : "%c", c);
        }
    }
    fputc('"', file);
}

void oz_page_json_number(FILE *file, double value)
{
    fprintf(file, isfinite(value) ? "%.10g" : "null", value);
}

static const char *skip_spaces(const char *at)
{
    return at + strspn(at, " \t\r\n");
}

static const char *skip_digits(const char *at)
{
    return at + strspn(at, "0123456789");
}

/* What follows a JSON number; NULL where there is none. */
static const char *skip_number(const char *at)
{
    at += *at == '-';
    const char *digits = at;
    at = skip_digits(at);
    if (at == digits || (*digits == '0' && at > digits + 1)) {
        return NULL;
    }
    if (*at == '.') {
        digits = ++at;
        at = skip_digits(at);
        if (at == digits) {
            return NULL;
        }
    }
    if (*at == 'e' || *at == 'E') {
        at += 1 + (at[1] == '+' || at[1] == '-');
        digits = at;
        at = skip_digits(at);
    }
    return at == digits && !isdigit((unsigned char)at[-1]) ? NULL : at;
}

static const char *skip_plain(const char *at)
{
    static const char *const words[] = {"true", "false", "null"};
    for (int i = 0; i < 3; i++) {
        if (strncmp(at, words[i], strlen(words[i])) == 0) {
            return at + strlen(words[i]);
        }
    }
    return skip_number(at);
}

/* What follows a quoted text; NULL where it does not end. */
static const char *skip_text(const char *at)
{
    for (at++; *at && *at != '"'; at++) {
        at += *at == '\\' && at[1];
    }
    return *at ? at + 1 : NULL;
}

/* What follows a list without lists in it; texts: they may be among its items. */
static const char *skip_list(const char *at, bool texts)
{
    at = skip_spaces(at + 1);
    while (*at != ']') {
        at = texts && *at == '"' ? skip_text(at) : skip_plain(at);
        at = at ? skip_spaces(at) : NULL;
        if (!at || (*at != ',' && *at != ']')) {
            return NULL;
        }
        at = *at == ',' ? skip_spaces(at + 1) : at;
    }
    return at + 1;
}

void oz_page_json_value(FILE *file, const char *yaml)
{
    if (!*yaml) {
        fputs("null", file);
        return;
    }
    const char *end = *yaml == '[' ? skip_list(yaml, false) : skip_plain(yaml);
    if (end && *end == '\0') {
        fputs(yaml, file);
    } else {
        oz_page_json_text(file, yaml);
    }
}

/* One character of a text, escapes of ASCII among them; '\0' for others. */
static char read_escape(const char **at)
{
    static const char names[] = "\"\\/nt", values[] = "\"\\/\n\t";
    const char *found = **at ? strchr(names, **at) : NULL;
    if (found) {
        (*at)++;
        return values[found - names];
    }
    char digits[5] = "";
    if (**at == 'u' && strspn(*at + 1, "0123456789abcdefABCDEF") >= 4) {
        memcpy(digits, *at + 1, 4);
        *at += 5;
    }
    long code = strtol(digits, NULL, 16);
    return code > 0 && code < 128 ? (char)code : '\0';
}

static const char *read_text(const char *at, char *text, size_t size)
{
    size_t length = 0;
    if (*at++ != '"') {
        return NULL;
    }
    while (*at != '"') {
        char c = *at ? *at++ : '\0';
        c = c == '\\' ? read_escape(&at) : c;
        if (c == '\0' || length + 1 >= size) {
            return NULL;
        }
        text[length++] = c;
    }
    text[length] = '\0';
    return at + 1;
}

static const char *read_value(const char *at, char *text, size_t size)
{
    if (*at == '"') {
        return read_text(at, text, size);
    }
    const char *end = *at == '[' ? skip_list(at, true) : skip_plain(at);
    if (!end || (size_t)(end - at) >= size) {
        return NULL;
    }
    memcpy(text, at, (size_t)(end - at));
    text[end - at] = '\0';
    return end;
}

bool oz_page_json_change(const char *body, char *key, char *value, size_t size)
{
    bool has_key = false, has_value = false;
    const char *at = skip_spaces(body);
    if (*at != '{') {
        return false;
    }
    do {
        char name[8];
        at = read_text(skip_spaces(at + 1), name, sizeof name);
        at = at ? skip_spaces(at) : NULL;
        if (!at || *at != ':') {
            return false;
        }
        at = skip_spaces(at + 1);
        if (strcmp(name, "key") == 0 && !has_key) {
            has_key = true;
            at = read_text(at, key, size);
        } else if (strcmp(name, "value") == 0 && !has_value) {
            has_value = true;
            at = read_value(at, value, size);
        } else {
            return false;
        }
        at = at ? skip_spaces(at) : NULL;
    } while (at && *at == ',');
    return at && *at == '}' && *skip_spaces(at + 1) == '\0' && has_key && has_value;
}
