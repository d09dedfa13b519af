/* Files beside. */
#include "export/part_file.h"

#include "base/file.h"
#include "base/folder.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

OzStatus oz_part_file_create(FILE **file, const char *folder, const char *part)
{
    return oz_folder_create_file(file, folder, part);
}

OzStatus oz_part_file_place(FILE *file, const char *folder, const char *part, const char *name)
{
    OzStatus status = OZ_OK;
    char *from = NULL, *to = NULL;
    if (!file) {
        return OZ_OK;
    }
    OZ_TRY(oz_folder_finish_file(file, name));
    OZ_TRY(oz_folder_note(folder, name));
    OZ_TRY(oz_file_join(&from, folder, part));
    OZ_TRY(oz_file_join(&to, folder, name));
    if (rename(from, to) != 0) {
        status = oz_status_fail(OZ_ERR_FILE, "cannot write %s: %s", to, strerror(errno));
    }
done:
    free(from);
    free(to);
    return status;
}
