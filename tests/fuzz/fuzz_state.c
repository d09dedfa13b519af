/* state.h5: what the head does not vouch for must not reach libhdf5. */
#include "fuzz_file.h"

#include "run/state_file.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    OzState state = {0};
    char path[64];
    int file = file_of(bytes, size, path);
    oz_state_file_read(&state, path);
    oz_state_free(&state);
    close(file);
    return 0;
}
