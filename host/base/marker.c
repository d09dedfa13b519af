/* Reading markers, and removing what they name. Takes no lock. */
#include "base/marker.h"

#include "base/file.h"

#include <errno.h>
#include <fcntl.h>
#include <fnmatch.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

OzStatus oz_marker_read(OzMarker *marker, const char *folder)
{
    static const char head[] = OZ_MARKER_HEAD "\n";
    OzStatus status = OZ_OK;
    char *path = NULL;
    *marker = (OzMarker){0};
    OZ_TRY(oz_file_join(&path, folder, OZ_MARKER));
    if (!oz_file_exists(path)) {
        goto done;
    }
    OZ_TRY(oz_file_read(&marker->text, NULL, path));
    bool fresh = marker->text[0] == '\0'; /* just made, by whoever is about to write it */
    if (!fresh && strncmp(marker->text, head, sizeof head - 1) != 0) {
        free(marker->text);
        *marker = (OzMarker){0};
        status = oz_status_fail(OZ_ERR_INPUT, "%s is no marker of orzo's; expected another folder",
                                path);
        goto done;
    }
    marker->names = marker->text + (fresh ? 0 : sizeof head - 1);
    if (strncmp(marker->names, "pid ", 4) == 0) {
        marker->names += strcspn(marker->names, "\n");
    }
done:
    free(path);
    return status;
}

/* As /proc/locks has it: "3: FLOCK  ADVISORY  WRITE 5693 fe:00:1095 0 EOF". */
static long find_locker(int descriptor)
{
    struct stat own;
    char line[256];
    unsigned high = 0, low = 0;
    unsigned long inode = 0;
    long pid = 0, found = 0;
    FILE *locks = fopen("/proc/locks", "r");
    bool known = fstat(descriptor, &own) == 0;
    while (locks && known && !found && fgets(line, sizeof line, locks)) {
        bool read = sscanf(line, "%*s FLOCK %*s %*s %ld %x:%x:%lu", &pid, &high, &low, &inode) == 4;
        bool same = read && inode == own.st_ino && makedev(high, low) == own.st_dev;
        found = same && pid > 0 ? pid : 0;
    }
    if (locks) {
        fclose(locks);
    }
    return found;
}

long oz_marker_holder(int descriptor)
{
    static const char head[] = OZ_MARKER_HEAD "\npid %ld";
    char text[256] = "";
    long pid = find_locker(descriptor);
    if (pid > 0) {
        return pid;
    }
    bool read = pread(descriptor, text, sizeof text - 1, 0) > 0 && sscanf(text, head, &pid) == 1;
    return read && pid > 0 && kill((pid_t)pid, 0) == 0 ? pid : 0;
}

/* What is longer than a name of ours is passed over. */
bool oz_marker_next(const char **at, char name[OZ_MARKER_NAME])
{
    while (*at && **at) {
        size_t length = strcspn(*at, "\n");
        const char *line = *at;
        *at += length + (line[length] == '\n');
        if (length > 0 && length < OZ_MARKER_NAME) {
            memcpy(name, line, length);
            name[length] = '\0';
            return true;
        }
    }
    return false;
}

bool oz_marker_has(const OzMarker *marker, const char *name)
{
    char line[OZ_MARKER_NAME];
    const char *at = marker->names;
    while (oz_marker_next(&at, line)) {
        if (strcmp(line, name) == 0) {
            return true;
        }
    }
    return false;
}

/* Names that lead out of the folder, or to itself, are none of ours. */
static bool is_below(const char *name)
{
    return name[0] != '/' && name[0] != '.' && !strstr(name, "/../");
}

/* A file in the folder, or in one of its own folders: never through a link to somewhere else. */
static OzStatus remove_file(const char *folder, char *name)
{
    OzStatus status = OZ_OK;
    char *path = NULL, *slash = strchr(name, '/');
    if (slash) {
        *slash = '\0';
    }
    OZ_TRY(slash ? oz_file_join(&path, folder, name) : oz_file_join(&path, NULL, folder));
    int place = open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC | (slash ? O_NOFOLLOW : 0));
    const char *last = slash ? slash + 1 : name;
    if (place >= 0 && unlinkat(place, last, 0) != 0 && errno != ENOENT) {
        status =
            oz_status_fail(OZ_ERR_FILE, "cannot remove %s/%s: %s", path, last, strerror(errno));
    }
    if (place >= 0) {
        close(place);
    }
    if (slash && status == OZ_OK) {
        rmdir(path); /* stays when something else is in it */
    }
done:
    free(path);
    return status;
}

/* A folder with a marker of its own: what that names, the marker, and the folder if nothing else is
 * in it. */
static OzStatus remove_folder(const char *folder, char *name)
{
    OzStatus status = OZ_OK;
    char *path = NULL, *marker = NULL;
    struct stat info;
    name[strlen(name) - 1] = '\0';
    OZ_TRY(oz_file_join(&path, folder, name));
    if (lstat(path, &info) != 0 || !S_ISDIR(info.st_mode)) {
        goto done;
    }
    OZ_TRY(oz_marker_clean(path, NULL));
    OZ_TRY(oz_file_join(&marker, path, OZ_MARKER));
    unlink(marker);
    rmdir(path);
done:
    free(marker);
    free(path);
    return status;
}

/* Without patterns every name does. */
static bool fits(const char *name, const char *const *patterns)
{
    bool found = !patterns;
    for (; patterns && *patterns; patterns++) {
        found |= fnmatch(*patterns, name, 0) == 0;
    }
    return found;
}

OzStatus oz_marker_clean(const char *folder, const char *const *patterns)
{
    OzStatus status = OZ_OK;
    OzMarker marker = {0};
    char name[OZ_MARKER_NAME];
    OZ_TRY(oz_marker_read(&marker, folder));
    const char *at = marker.names;
    while (oz_marker_next(&at, name)) {
        bool is_folder = name[strlen(name) - 1] == '/';
        if (is_below(name) && fits(name, patterns)) {
            OZ_TRY(is_folder ? remove_folder(folder, name) : remove_file(folder, name));
        }
    }
done:
    free(marker.text);
    return status;
}
