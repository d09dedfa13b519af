/* A row twice, with nothing kept before the first. */
#include "bench/bench_start.h"

#include "base/file.h"
#include "base/memory.h"

#include <errno.h>
#include <ftw.h>
#include <stdlib.h>
#include <string.h>

static int remove_one(const char *path, const struct stat *info, int kind, struct FTW *at)
{
    (void)info;
    (void)kind;
    (void)at;
    return remove(path);
}

static OzStatus measure_both(double *cold, double *warm, const OzBenchJob *job)
{
    OzBenchRow row;
    OZ_PASS(oz_bench_row_measure(&row, job));
    *cold = row.value[OZ_BENCH_START];
    OZ_PASS(oz_bench_row_measure(&row, job));
    *warm = row.value[OZ_BENCH_START];
    return OZ_OK;
}

static OzStatus measure(double *cold, double *warm, const OzBenchJob *job)
{
    OzStatus status = OZ_OK;
    char *folder = NULL, *before = NULL;
    const char *own = getenv("POCL_CACHE_DIR"), *temporary = getenv("TMPDIR");
    OZ_TRY(oz_file_join(&folder, temporary && *temporary ? temporary : "/tmp",
                        "orzo_bench_kernels_XXXXXX"));
    OZ_TRY(own ? oz_memory_text(&before, own) : OZ_OK);
    if (!mkdtemp(folder)) {
        status = oz_status_fail(OZ_ERR_FILE, "cannot make %s: %s", folder, strerror(errno));
        goto done;
    }
    setenv("POCL_CACHE_DIR", folder, 1);
    status = measure_both(cold, warm, job);
    if (before) {
        setenv("POCL_CACHE_DIR", before, 1);
    } else {
        unsetenv("POCL_CACHE_DIR");
    }
    nftw(folder, remove_one, 16, FTW_DEPTH | FTW_PHYS);
done:
    free(folder);
    free(before);
    return status;
}

OzStatus oz_bench_start_print(double *cold, double *warm, OzBenchBed *bed, const OzOptions *options,
                              FILE *text)
{
    const OzBenchJob job = {
        .options = options, .bed = bed, .name = "start", .members = 1, .seconds = 0.01};
    OZ_PASS(measure(cold, warm, &job));
    fprintf(text,
            "first step after %.2f s where kernels are built, %.2f s where the driver has kept "
            "them\n",
            *cold, *warm);
    return OZ_OK;
}
