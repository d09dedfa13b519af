/* Whole files and folders. */
#pragma once

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* *bytes receives the whole file plus a zero byte; the caller frees it. length may be NULL. Refuses
 * anything but a regular file, and files over 1 GiB. Fails with OZ_ERR_FILE, naming path. */
OzStatus oz_file_read(char **bytes, size_t *length, const char *path);

/* Makes the folder and its missing parents. */
OzStatus oz_file_make_folder(const char *path);

/* Writes out what file holds in its buffer. *whole is the size up to which path is whole: it
 * becomes the file's size; on failure (OZ_ERR_FILE) the file is cut back to it, so that no half row
 * or frame is left. */
OzStatus oz_file_commit(FILE *file, int64_t *whole, const char *path);

/* Cuts a file that is open for writing to its first `whole` bytes and goes on there. Fails with
 * OZ_ERR_FILE when it is shorter. */
OzStatus oz_file_go_on(FILE *file, int64_t whole, const char *path);

bool oz_file_exists(const char *path);

/* "folder/name" in a new text that the caller frees; name alone when it is absolute or folder is
 * NULL. */
OzStatus oz_file_join(char **path, const char *folder, const char *name);
