/* Finding embedded files by name. */
#include "base/embed.h"

#include "base/file.h"
#include "base/memory.h"

#include <stdio.h>
#include <string.h>

OzStatus oz_embed_read(char **text, const char *source_dir, const char *name)
{
    *text = NULL;
    if (source_dir) {
        char path[4096];
        snprintf(path, sizeof path, "%s/%s", source_dir, name);
        return oz_file_read(text, NULL, path);
    }
    for (const OzEmbeddedFile *file = oz_embed_files; file->name; file++) {
        if (strcmp(file->name, name) == 0) {
            return oz_memory_text(text, (const char *)file->bytes);
        }
    }
    return oz_status_fail(OZ_ERR_FILE, "%s is not embedded in this program", name);
}
