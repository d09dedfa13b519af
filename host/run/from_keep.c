/* The copy, and the text beside it. */
#include "run/from_keep.h"

#include "base/file.h"
#include "base/folder.h"
#include "base/log.h"
#include "base/memory.h"
#include "run/state_file.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* One file; *bytes grows by its size. */
static OzStatus copy_file(const OzFromFile *file, const char *folder, double *bytes)
{
    OzStatus status = OZ_OK;
    char name[64], part[80], *path = NULL;
    struct stat made;
    const OzStateEntry *member = oz_state_find(&file->state, "worker/member_0/outputs/name");
    if (member && member->count > 1) { /* with its zero */
        snprintf(name, sizeof name, "from/state_%05lld.h5", (long long)file->head.first);
    } else {
        snprintf(name, sizeof name, "from/state.h5");
    }
    snprintf(part, sizeof part, "%s.part", name);
    OZ_TRY(oz_folder_note(folder, name));
    OZ_TRY(oz_folder_note(folder, part));
    OZ_TRY(oz_file_join(&path, folder, name));
    OZ_TRY(oz_state_file_write(&file->state, path));
    *bytes += stat(path, &made) == 0 ? (double)made.st_size : 0;
done:
    free(path);
    return status;
}

/* place: of the copy, seen from the folder. */
static OzStatus write_text(const OzFrom *from, const char *folder, const char *place,
                           const char *member)
{
    FILE *file = NULL;
    OZ_PASS(oz_folder_create_file(&file, folder, "from.txt"));
    bool good = fprintf(file, "%s\n%s%s%s\n", from->asked, place, member && member[0] ? "/" : "",
                        member ? member : "") > 0;
    return fclose(file) == 0 && good ? OZ_OK
                                     : oz_status_fail(OZ_ERR_FILE, "cannot write %s/from.txt: %s",
                                                      folder, strerror(errno));
}

OzStatus oz_from_keep_copy(const OzFrom *from, const char *folder)
{
    OzStatus status = OZ_OK;
    double bytes = 0;
    char *below = NULL;
    if (!from->asked) {
        return OZ_OK;
    }
    OZ_TRY(oz_file_join(&below, folder, "from"));
    OZ_TRY(oz_file_make_folder(below));
    for (int i = 0; i < from->count; i++) {
        OZ_TRY(copy_file(&from->files[i], folder, &bytes));
    }
    OZ_TRY(write_text(from, folder, "from", from->only));
    oz_log_line("what it begins from is kept in %s: %.3g MB", below, bytes / 1e6);
done:
    free(below);
    return status;
}

OzStatus oz_from_keep_note(const OzFrom *from, const OzFromMember *begun, const char *folder)
{
    return write_text(from, folder, "../from", begun->name);
}

OzStatus oz_from_keep_find(char **asked, const char *folder)
{
    OzStatus status = OZ_OK;
    char *path = NULL, *text = NULL;
    *asked = NULL;
    OZ_TRY(oz_file_join(&path, folder, "from.txt"));
    if (!oz_file_exists(path)) {
        goto done;
    }
    OZ_TRY(oz_file_read(&text, NULL, path));
    char *place = strchr(text, '\n');
    place = place ? place + 1 : text + strlen(text);
    place[strcspn(place, "\n")] = '\0';
    if (!place[0]) {
        status = oz_status_fail(OZ_ERR_INPUT,
                                "%s does not say where the state is that the run began from; "
                                "expected a second line, as this orzo writes it",
                                path);
        goto done;
    }
    OZ_TRY(oz_file_join(asked, folder, place));
done:
    free(path);
    free(text);
    return status;
}
