/* final.csv as a bed to start from. */
#include "fuzz_file.h"

#include "model/restart_csv.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    OzGrains grains = {0};
    char path[64];
    int file = file_of(bytes, size, path);
    oz_restart_csv_read(&grains, path);
    oz_grains_free(&grains);
    close(file);
    return 0;
}
