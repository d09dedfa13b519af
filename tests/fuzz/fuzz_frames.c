/* frames.bin, for orzo draw; its checksums are not looked at in this build, or nothing would get
 * past them. */
#include "fuzz_file.h"

#include "observe/frame_reader.h"

static void read_all(OzFrames *frames, const OzGrains *grains)
{
    OzScene scene = {.model = grains->elements ? OZ_MODEL_TRIGRAINS : OZ_MODEL_RODS};
    OzSnapshot snapshot;
    int purpose = 0;
    bool more = true;
    OzStatus status = oz_snapshot_create(&snapshot, &scene, grains);
    while (status == OZ_OK && more) {
        status = oz_frame_reader_next(frames, &snapshot, &purpose, &more);
    }
    oz_snapshot_free(&snapshot);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    OzFrames *frames = NULL;
    OzGrains grains = {0};
    char path[64];
    int file = file_of(bytes, size, path);
    if (oz_frame_reader_open(&frames, path, &grains) == OZ_OK) {
        read_all(frames, &grains);
    }
    oz_frames_finish(frames);
    oz_grains_free(&grains);
    close(file);
    return 0;
}
