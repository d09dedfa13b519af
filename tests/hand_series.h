/* Reading a series.csv back. */
#ifndef TESTS_HAND_SERIES_H
#define TESTS_HAND_SERIES_H

#include "hand_folder.h"

#include "base/file.h"

/* The cell of the named column in the given row (1 is the first after the header). */
static inline void read_cell(const char *path, int row, const char *name, char cell[64])
{
    char *text = NULL;
    assert_int_equal(oz_file_read(&text, NULL, path), OZ_OK);
    char *rest = text, *line = strsep(&rest, "\n"), *head = NULL;
    int column = 0, index = -1;
    while ((head = strsep(&line, ","))) {
        index = strcmp(head, name) == 0 ? column : index;
        column++;
    }
    if (index < 0) {
        fail_msg("there is no column %s", name);
    }
    for (int i = 0; i < row; i++) {
        line = strsep(&rest, "\n");
    }
    assert_non_null(line);
    for (int i = 0; i <= index; i++) {
        head = strsep(&line, ",");
    }
    assert_non_null(head);
    snprintf(cell, 64, "%s", head);
    free(text);
}

/* -1e99, which no column can have, for an empty cell. */
static inline double number_in(const char *cell)
{
    return *cell ? strtod(cell, NULL) : -1e99;
}

#endif
