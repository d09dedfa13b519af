/* Removing the files of an earlier run by their names. */
#include "leftovers.h"

#include "base/file.h"

#include <dirent.h>
#include <errno.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static OzStatus remove_file(const char *folder, const char *name)
{
    OzStatus status = OZ_OK;
    char *path = NULL;
    OZ_TRY(oz_file_join(&path, folder, name));
    if (unlink(path) != 0 && errno != ENOENT && errno != ENOTDIR) {
        status = oz_status_fail(OZ_ERR_FILE, "cannot remove %s: %s", path, strerror(errno));
    }
done:
    free(path);
    return status;
}

static bool is_picture(const char *name)
{
    size_t length = strlen(name);
    return length > 4 && strcmp(name + length - 4, ".png") == 0;
}

static OzStatus remove_pictures(const char *folder)
{
    OzStatus status = OZ_OK;
    DIR *entries = opendir(folder);
    if (!entries) {
        return OZ_OK;
    }
    for (struct dirent *entry = readdir(entries); entry; entry = readdir(entries)) {
        if (is_picture(entry->d_name)) {
            OZ_TRY(remove_file(folder, entry->d_name));
        }
    }
    rmdir(folder); /* stays when something else is in it */
done:
    closedir(entries);
    return status;
}

OzStatus oz_leftovers_remove(const char *folder)
{
    static const char *const names[] = {
        "final.csv",          "members.csv", "ensemble.csv",
        "series.csv",         "frames.bin",  "movie.mp4",
        "scene.yaml",         "log.txt",     "inclination_spectrum.csv",
        "inclination_fit.csv"};
    OzStatus status = OZ_OK;
    char *snapshots = NULL;
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        OZ_TRY(remove_file(folder, names[i]));
    }
    OZ_TRY(oz_file_join(&snapshots, folder, "snapshots"));
    OZ_TRY(remove_pictures(snapshots));
done:
    free(snapshots);
    return status;
}
