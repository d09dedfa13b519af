/* A study of figures. */
#include "fuzz_file.h"

#include "figures/study_read.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    OzStudy study = {0};
    char path[64];
    int file = file_of(bytes, size, path);
    oz_study_read_file(&study, path);
    oz_study_read_free(&study);
    close(file);
    return 0;
}
