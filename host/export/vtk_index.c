/* Entries, and the end behind the last one, over which the next one is written. */
#include "export/vtk_index.h"

#include "base/file.h"
#include "base/folder.h"

#include <errno.h>
#include <stdbool.h>
#include <string.h>

static const char END[] = "</Collection>\n</VTKFile>\n";

/* Text, which ends with the end, in one piece. */
static bool write_ended(FILE *index, const char *text)
{
    size_t length = strlen(text);
    bool good = fwrite(text, 1, length, index) == length && fflush(index) == 0;
    return good && fseeko(index, -(off_t)strlen(END), SEEK_CUR) == 0;
}

OzStatus oz_vtk_index_create(FILE **index, const char *folder, const char *name)
{
    OZ_PASS(oz_folder_create_file(index, folder, name));
    fputs("<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n<Collection>\n",
          *index);
    return OZ_OK;
}

OzStatus oz_vtk_index_go_on(FILE **index, const char *path, int64_t whole)
{
    *index = fopen(path, "r+");
    if (!*index) {
        return oz_status_fail(OZ_ERR_FILE, "cannot write %s: %s", path, strerror(errno));
    }
    OZ_PASS(oz_file_go_on(*index, whole, path));
    return write_ended(*index, END) ? OZ_OK : oz_status_fail(OZ_ERR_FILE, "cannot write %s", path);
}

int64_t oz_vtk_index_whole(FILE *index)
{
    return (int64_t)ftello(index);
}

OzStatus oz_vtk_index_add(FILE *index, double time, const char *name)
{
    char text[256];
    snprintf(text, sizeof text, "<DataSet timestep=\"%.17g\" file=\"%s\"/>\n%s", time, name, END);
    return write_ended(index, text)
               ? OZ_OK
               : oz_status_fail(OZ_ERR_FILE, "cannot write the .pvd of %s", name);
}
