/* Whole files and folders. */
#include "base/file.h"

#include "base/memory.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdio_ext.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { LARGEST_FILE = 1 << 30 };

OzStatus oz_file_read(char **bytes, size_t *length, const char *path)
{
    OzStatus status = OZ_OK;
    struct stat info;
    *bytes = NULL;
    /* Without O_NONBLOCK a pipe that nobody writes to would hold us here. */
    int descriptor = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    FILE *file = descriptor < 0 ? NULL : fdopen(descriptor, "rb");
    if (!file || fstat(descriptor, &info) != 0) {
        status = oz_status_fail(OZ_ERR_FILE, "cannot read %s: %s", path, strerror(errno));
        if (!file && descriptor >= 0) {
            close(descriptor);
        }
        goto done;
    }
    if (!S_ISREG(info.st_mode) || info.st_size > LARGEST_FILE) {
        status = oz_status_fail(OZ_ERR_FILE, "cannot read %s: %s", path,
                                S_ISREG(info.st_mode)    ? "larger than 1 GiB"
                                : S_ISFIFO(info.st_mode) ? "a pipe, not a file"
                                                         : "not a file");
        goto done;
    }
    OZ_TRY(oz_memory_new((void **)bytes, (size_t)info.st_size + 1, 1, path));
    size_t got = fread(*bytes, 1, (size_t)info.st_size, file);
    if (ferror(file)) {
        status = oz_status_fail(OZ_ERR_FILE, "cannot read %s: %s", path, strerror(errno));
        goto done;
    }
    if (length) {
        *length = got;
    }
done:
    if (file) {
        fclose(file);
    }
    if (status != OZ_OK) {
        free(*bytes);
        *bytes = NULL;
    }
    return status;
}

OzStatus oz_file_make_folder(const char *path)
{
    char part[4096];
    if (strlen(path) >= sizeof part) {
        return oz_status_fail(OZ_ERR_FILE, "folder name too long: %s", path);
    }
    strcpy(part, path);
    for (char *slash = part + 1;; slash++) {
        char kept = *slash;
        if (kept == '/' || kept == '\0') {
            *slash = '\0';
            if (mkdir(part, 0777) != 0 && errno != EEXIST) {
                return oz_status_fail(OZ_ERR_FILE, "cannot make folder %s: %s", part,
                                      strerror(errno));
            }
            *slash = kept;
        }
        if (kept == '\0') {
            return OZ_OK;
        }
    }
}

OzStatus oz_file_commit(FILE *file, int64_t *whole, const char *path)
{
    if (fflush(file) == 0 && !ferror(file)) {
        *whole = (int64_t)ftello(file);
        return OZ_OK;
    }
    int why = errno;
    __fpurge(file); /* else closing would write the rest */
    const char *cut = ftruncate(fileno(file), (off_t)*whole) == 0 ? "" : "; its end may be cut";
    fseeko(file, (off_t)*whole, SEEK_SET);
    return oz_status_fail(OZ_ERR_FILE, "cannot write %s: %s%s", path, strerror(why), cut);
}

OzStatus oz_file_go_on(FILE *file, int64_t whole, const char *path)
{
    struct stat info;
    if (fstat(fileno(file), &info) != 0 || info.st_size < (off_t)whole) {
        return oz_status_fail(OZ_ERR_FILE, "%s is shorter than the %lld bytes that it had", path,
                              (long long)whole);
    }
    if (ftruncate(fileno(file), (off_t)whole) != 0 || fseeko(file, (off_t)whole, SEEK_SET) != 0) {
        return oz_status_fail(OZ_ERR_FILE, "cannot write %s: %s", path, strerror(errno));
    }
    return OZ_OK;
}

bool oz_file_exists(const char *path)
{
    struct stat info;
    return stat(path, &info) == 0;
}

OzStatus oz_file_join(char **path, const char *folder, const char *name)
{
    if (!folder || name[0] == '/') {
        return oz_memory_text(path, name);
    }
    if (asprintf(path, "%s/%s", folder, name) < 0) {
        *path = NULL;
        return oz_status_fail(OZ_ERR_MEMORY, "out of memory for a file name");
    }
    return OZ_OK;
}
