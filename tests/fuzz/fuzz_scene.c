/* Scene files with --set: the text to the first zero byte, then a setting to each further one. What
 * is accepted must be written as a scene that is accepted again. */
#include "fuzz_file.h"

#include "scene/scene.h"

#include <string.h>

enum { SETTINGS = 8 };

static void check_written(const OzScene *scene)
{
    char *text = NULL;
    size_t length = 0;
    OzScene again;
    FILE *file = open_memstream(&text, &length);
    if (!file || oz_scene_write(scene, file) != OZ_OK || fclose(file) != 0) {
        abort();
    }
    if (oz_scene_parse(&again, "again.yaml", text, NULL, 0) != OZ_OK) {
        fprintf(stderr, "%s\n%s", oz_status_text(), text);
        abort();
    }
    oz_scene_free(&again);
    free(text);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    OzScene scene;
    char *settings[SETTINGS];
    int count = 0;
    char *text = calloc(size + 1, 1);
    if (!text) {
        abort();
    }
    memcpy(text, bytes, size);
    for (char *at = text + strlen(text) + 1; at < text + size && count < SETTINGS;
         at += strlen(at) + 1) {
        if (strchr(at, '=')) { /* the command line sees to that */
            settings[count++] = at;
        }
    }
    if (oz_scene_parse(&scene, "fuzz.yaml", text, settings, count) == OZ_OK) {
        check_written(&scene);
    }
    oz_scene_free(&scene);
    free(text);
    return 0;
}
