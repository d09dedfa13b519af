/* reloads.csv of a run that is repeated. Its changes are then settings of a scene, which fuzz_scene
 * and fuzz_page try. */
#include "fuzz_file.h"

#include "run/replay.h"

#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    OzReplay replay;
    char *rows = calloc(size + 1, 1);
    if (!rows) {
        abort();
    }
    memcpy(rows, bytes, size);
    if (oz_replay_parse(&replay, "reloads.csv", rows) == OZ_OK) {
        for (int i = 1; i < replay.count; i++) { /* or the later one would come at once */
            if (replay.changes[i].step <= replay.changes[i - 1].step) {
                abort();
            }
        }
    }
    oz_replay_free(&replay);
    free(rows);
    return 0;
}
