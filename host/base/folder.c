/* Markers, locks, and the removal of what markers name. Knows no file's meaning. */
#include "base/folder.h"

#include "base/file.h"
#include "base/log.h"
#include "base/marker.h"
#include "base/memory.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <fnmatch.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

bool oz_folder_names(const char *path, const char *name)
{
    OzMarker marker;
    bool named = oz_marker_read(&marker, path) == OZ_OK && oz_marker_has(&marker, name);
    free(marker.text);
    return named;
}

bool oz_folder_writes(const OzFolderUse *use, const char *name)
{
    for (const char *const *pattern = use->writes; pattern && *pattern; pattern++) {
        if (fnmatch(*pattern, name, FNM_PATHNAME | FNM_PERIOD) == 0) {
            return true;
        }
    }
    return false;
}

static OzStatus refuse_foreign(const char *folder, const char *name)
{
    return oz_status_fail(
        OZ_ERR_INPUT,
        "%s/%s is there and no run of orzo has written it; expected another folder "
        "(-o), or that you move it away",
        folder, name);
}

/* Looks at what lies in folder/below ("" for the folder itself). */
static OzStatus check_entries(const char *folder, const char *below, const OzFolderUse *use,
                              const OzMarker *marker)
{
    OzStatus status = OZ_OK;
    char *path = NULL, name[OZ_MARKER_NAME];
    OZ_TRY(oz_file_join(&path, folder, below));
    DIR *entries = opendir(path);
    for (struct dirent *e = entries ? readdir(entries) : NULL; e && status == OZ_OK;
         e = readdir(entries)) {
        int length = snprintf(name, sizeof name, "%s%s", below, e->d_name);
        bool fits = length > 0 && (size_t)length < sizeof name;
        if (fits && oz_folder_writes(use, name) && !oz_marker_has(marker, name)) {
            status = refuse_foreign(folder, name);
        }
    }
    if (entries) {
        closedir(entries);
    }
done:
    free(path);
    return status;
}

/* Patterns are of files in the folder, or in folders of one name in it. */
static OzStatus check_foreign(const char *folder, const OzFolderUse *use, const OzMarker *marker)
{
    char below[OZ_MARKER_NAME];
    OZ_PASS(check_entries(folder, "", use, marker));
    for (const char *const *pattern = use->writes; pattern && *pattern; pattern++) {
        size_t length = strcspn(*pattern, "/");
        if ((*pattern)[length] == '/' && length + 2 < sizeof below) {
            snprintf(below, sizeof below, "%.*s/", (int)length, *pattern);
            OZ_PASS(check_entries(folder, below, use, marker));
        }
    }
    return OZ_OK;
}

static bool holds(const char *folder, const char *name)
{
    char *path = NULL;
    bool there = oz_file_join(&path, folder, name) == OZ_OK && oz_file_exists(path);
    free(path);
    return there;
}

/* The first of the names that the marker names and the folder holds, or NULL. */
static const char *find_held(const char *folder, const char *const *names, const OzMarker *marker)
{
    for (; names && *names; names++) {
        if (oz_marker_has(marker, *names) && holds(folder, *names)) {
            return *names;
        }
    }
    return NULL;
}

/* A member's folder that is there. */
static bool holds_members(const char *folder, const OzMarker *marker)
{
    char name[OZ_MARKER_NAME];
    const char *at = marker->names;
    while (oz_marker_next(&at, name)) {
        if (name[strlen(name) - 1] == '/' && holds(folder, name)) {
            return true;
        }
    }
    return false;
}

static OzStatus check_results(const char *folder, const OzFolderUse *use, const OzMarker *marker)
{
    const char *found = NULL;
    if (use->overwrite || use->keep) {
        return OZ_OK;
    }
    if (find_held(folder, use->endings, marker)) {
        return oz_status_fail(
            OZ_ERR_INPUT,
            "%s holds a run that has ended; expected another folder (-o) or --overwrite", folder);
    }
    found = find_held(folder, use->results, marker);
    if (found || holds_members(folder, marker)) {
        return oz_status_fail(OZ_ERR_INPUT,
                              "%s holds %s of a run that did not reach its end; expected another "
                              "folder (-o) or --overwrite",
                              folder, found ? found : "members");
    }
    return OZ_OK;
}

static OzStatus refuse_used(const char *folder, long pid)
{
    char who[32] = "another process";
    if (pid > 0) {
        snprintf(who, sizeof who, "process %ld", pid);
    }
    return oz_status_fail(OZ_ERR_INPUT,
                          "%s is in use by %s; expected another folder, or to wait "
                          "for its end",
                          folder, who);
}

/* Whether the lock (LOCK_EX, LOCK_SH) can be had; what file systems without locks say counts as
 * yes. */
static bool try_lock(int descriptor, int lock, const char *path)
{
    if (flock(descriptor, lock | LOCK_NB) == 0) {
        return true;
    }
    if (errno != EWOULDBLOCK) {
        oz_log_line("warning: %s cannot be locked: %s", path, strerror(errno));
    }
    return errno != EWOULDBLOCK;
}

/* The folder's marker as it is; -1 where there is none. */
static OzStatus open_marker(const char *folder, int *descriptor)
{
    OzStatus status = OZ_OK;
    char *path = NULL;
    *descriptor = -1;
    OZ_TRY(oz_file_join(&path, folder, OZ_MARKER));
    *descriptor = open(path, O_RDONLY | O_CLOEXEC);
done:
    free(path);
    return status;
}

/* Refuses a folder in which this lock cannot be had for another process's; this one's own does not
 * count. */
static OzStatus check_lock(const char *folder, int lock)
{
    OzStatus status = OZ_OK;
    int descriptor = -1;
    OZ_PASS(open_marker(folder, &descriptor));
    if (descriptor < 0) {
        return OZ_OK;
    }
    if (flock(descriptor, lock | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
        long pid = oz_marker_holder(descriptor);
        status = pid == (long)getpid() ? OZ_OK : refuse_used(folder, pid);
    }
    close(descriptor);
    return status;
}

OzStatus oz_folder_read(OzFolder *folder, const char *path)
{
    OzStatus status = OZ_OK;
    int descriptor = -1;
    struct stat info;
    *folder = (OzFolder){0};
    if (stat(path, &info) == 0 && !S_ISDIR(info.st_mode)) {
        return oz_status_fail(
            OZ_ERR_INPUT, "%s is a file; expected the folder that a run has left, as runs/first",
            path);
    }
    OZ_TRY(open_marker(path, &descriptor));
    if (descriptor < 0) {
        return OZ_OK;
    }
    if (!try_lock(descriptor, LOCK_SH, path)) {
        status = refuse_used(path, oz_marker_holder(descriptor));
        goto done;
    }
    OZ_TRY(oz_memory_text(&folder->path, path));
    folder->lock = descriptor;
    descriptor = -1;
done:
    if (descriptor >= 0) {
        close(descriptor);
    }
    return status;
}

/* The name of the folder that this one lies in, also of one that is not there yet. */
static OzStatus parent_of(char **parent, const char *folder)
{
    if (oz_file_exists(folder)) {
        return oz_file_join(parent, folder, "..");
    }
    OzStatus status = oz_memory_text(parent, folder);
    char *end = status == OZ_OK ? *parent + strlen(*parent) : NULL;
    while (end && end > *parent && end[-1] == '/') {
        *--end = '\0';
    }
    char *slash = status == OZ_OK ? strrchr(*parent, '/') : NULL;
    if (slash) {
        slash[slash == *parent] = '\0';
    } else if (status == OZ_OK) {
        free(*parent);
        status = oz_memory_text(parent, ".");
    }
    return status;
}

/* It may be a run's, with members below it. */
static OzStatus check_parent(const char *folder)
{
    OzStatus status = OZ_OK;
    char *parent = NULL;
    OZ_TRY(parent_of(&parent, folder));
    OZ_TRY(check_lock(parent, LOCK_SH));
done:
    free(parent);
    return status;
}

/* Everything but the folder's own lock. */
static OzStatus check_contents(const char *path, const OzFolderUse *use, const OzMarker *marker)
{
    OZ_PASS(check_parent(path));
    OZ_PASS(check_foreign(path, use, marker));
    return check_results(path, use, marker);
}

OzStatus oz_folder_check(const char *path, const OzFolderUse *use)
{
    OzStatus status = OZ_OK;
    OzMarker marker = {0};
    if (path[0] == '\0') {
        return oz_status_fail(OZ_ERR_INPUT, "the folder's name is empty; expected -o DIR");
    }
    OZ_TRY(check_lock(path, LOCK_EX));
    OZ_TRY(oz_marker_read(&marker, path));
    OZ_TRY(check_contents(path, use, &marker));
done:
    free(marker.text);
    return status;
}

/* Opens and locks the marker, made if there is none. One that was removed by its owner meanwhile is
 * let go. */
static OzStatus lock_marker(OzFolder *folder, bool *made)
{
    OzStatus status = OZ_OK;
    char *path = NULL;
    struct stat here, there;
    OZ_TRY(oz_file_join(&path, folder->path, OZ_MARKER));
    for (;;) {
        *made = !oz_file_exists(path);
        int descriptor = open(path, O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
        if (descriptor < 0) {
            status = oz_status_fail(OZ_ERR_FILE, "cannot write %s: %s", path, strerror(errno));
            goto done;
        }
        if (!try_lock(descriptor, LOCK_EX, path)) {
            status = refuse_used(folder->path, oz_marker_holder(descriptor));
            close(descriptor);
            goto done;
        }
        if (fstat(descriptor, &here) == 0 && stat(path, &there) == 0 &&
            here.st_ino == there.st_ino && here.st_dev == there.st_dev) {
            folder->lock = descriptor;
            break;
        }
        close(descriptor);
    }
done:
    free(path);
    return status;
}

/* The marker's head with this process in it, and the names that stay. */
static OzStatus write_marker(const OzFolder *folder, const char *names)
{
    char *text = NULL;
    int length = asprintf(&text, "%s\npid %ld\n%s", OZ_MARKER_HEAD, (long)getpid(), names);
    if (length < 0) {
        return oz_status_fail(OZ_ERR_MEMORY, "out of memory for the names of a folder's files");
    }
    bool good = ftruncate(folder->lock, 0) == 0 &&
                pwrite(folder->lock, text, (size_t)length, 0) == (ssize_t)length;
    free(text);
    return good ? OZ_OK
                : oz_status_fail(OZ_ERR_FILE, "cannot write %s/" OZ_MARKER ": %s", folder->path,
                                 strerror(errno));
}

/* With the lock held: what may have come since the check, then the clean start. */
static OzStatus take_over(const OzFolder *folder, const OzFolderUse *use)
{
    OzStatus status = OZ_OK;
    OzMarker marker = {0};
    OZ_TRY(oz_marker_read(&marker, folder->path));
    OZ_TRY(check_contents(folder->path, use, &marker));
    if (!use->keep || use->replaces) {
        OZ_TRY(oz_marker_clean(folder->path, use->keep ? use->replaces : NULL));
    }
    const char *names = use->keep && marker.names ? marker.names : "";
    OZ_TRY(write_marker(folder, names + strspn(names, "\n")));
done:
    free(marker.text);
    return status;
}

OzStatus oz_folder_open(OzFolder *folder, const char *path, const OzFolderUse *use)
{
    OzStatus status = OZ_OK;
    bool made = false;
    *folder = (OzFolder){0};
    OZ_TRY(oz_folder_check(path, use));
    OZ_TRY(oz_file_make_folder(path));
    OZ_TRY(oz_memory_text(&folder->path, path));
    OZ_TRY(lock_marker(folder, &made));
    status = take_over(folder, use);
    if (status != OZ_OK && made) {
        char *marker = NULL;
        OZ_AFTER(status, oz_file_join(&marker, path, OZ_MARKER));
        unlink(marker ? marker : "");
        free(marker);
    }
done:
    if (status != OZ_OK) {
        oz_folder_close(folder);
    }
    return status;
}

void oz_folder_close(OzFolder *folder)
{
    if (folder->lock > 0) {
        close(folder->lock);
    }
    free(folder->path);
    *folder = (OzFolder){0};
}

/* Appends a line in one write, so that threads' lines do not mix. */
static OzStatus append(const char *folder, const char *marker, const char *name)
{
    char line[OZ_MARKER_NAME + 1];
    int length = snprintf(line, sizeof line, "%s\n", name);
    int descriptor = open(marker, O_WRONLY | O_APPEND | O_CLOEXEC);
    bool good = descriptor >= 0 && length < (int)sizeof line &&
                write(descriptor, line, (size_t)length) == (ssize_t)length;
    OzStatus status = good ? OZ_OK
                           : oz_status_fail(OZ_ERR_FILE, "cannot note %s in %s/" OZ_MARKER ": %s",
                                            name, folder, strerror(errno));
    if (descriptor >= 0) {
        close(descriptor);
    }
    return status;
}

OzStatus oz_folder_note(const char *path, const char *name)
{
    OzStatus status = OZ_OK;
    char *marker = NULL;
    OZ_TRY(oz_file_join(&marker, path, OZ_MARKER));
    if (!oz_file_exists(marker)) {
        goto done;
    }
    if (holds(path, name)) {
        bool is_folder = name[strlen(name) - 1] == '/';
        bool known = oz_folder_names(path, name);
        status = known || is_folder ? OZ_OK : refuse_foreign(path, name);
        if (known || !is_folder) {
            goto done;
        }
    }
    OZ_TRY(append(path, marker, name));
done:
    free(marker);
    return status;
}

OzStatus oz_folder_create_file(FILE **file, const char *path, const char *name)
{
    OzStatus status = OZ_OK;
    char *whole = NULL;
    *file = NULL;
    OZ_TRY(oz_folder_note(path, name));
    OZ_TRY(oz_file_join(&whole, path, name));
    *file = fopen(whole, "w");
    if (!*file) {
        status = oz_status_fail(OZ_ERR_FILE, "cannot write %s: %s", whole, strerror(errno));
    }
done:
    free(whole);
    return status;
}

OzStatus oz_folder_finish_file(FILE *file, const char *name)
{
    if (!file) {
        return OZ_OK;
    }
    bool good = fflush(file) == 0 && !ferror(file);
    int cause = errno;
    good = fclose(file) == 0 && good;
    return good ? OZ_OK : oz_status_fail(OZ_ERR_FILE, "cannot write %s: %s", name, strerror(cause));
}
