/* JSON as the page speaks it: texts and numbers written, one flat object of a change read. */
#pragma once

#include <stdbool.h>
#include <stdio.h>

/* Quoted; bytes below a space and `<` become \u escapes. */
void oz_page_json_text(FILE *file, const char *text);

/* null for what is not finite. */
void oz_page_json_number(FILE *file, double value);

/* A key's value, written as YAML: null where it is empty, as it is where it is JSON too (a number, a bool, a list of
 * numbers), else quoted. */
void oz_page_json_value(FILE *file, const char *yaml);

/* Reads {"key": text, "value": anything flat}, in any order and nothing besides. The value is what
 * stands there (1e-3, true, [1, 2]), a text without its quotes. False where it is something else or
 * does not fit into `size` bytes each. */
bool oz_page_json_change(const char *body, char *key, char *value, size_t size);
