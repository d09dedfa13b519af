/* Measuring the device apart from any simulation. */
#include "bench/bench_limits.h"

#include "base/subprocess.h"
#include "compute/limits.h"

#include <math.h>
#include <string.h>

/* Large enough to be in no cache, or in few. */
static const size_t memory_bytes = 400u << 20, quick_bytes = 100u << 20;

typedef struct Look {
    const OzOptions *options;
    int threads;
    OzBenchDevice *device;
    double
        rates[4]; /* copy float, copy double in B/s; multiply-add float, double in operations/s */
} Look;

static OzStatus look_at_device(void *context)
{
    OzStatus status = OZ_OK;
    Look *look = context;
    OzDevice device = {0};
    OZ_TRY(oz_device_open(&device, look->options->device, look->options->threads));
    memcpy(look->device->name, device.name, sizeof device.name);
    look->device->is_cpu = device.is_cpu;
    look->device->has_double = device.has_double;
    look->device->units = device.units;
    look->device->threads = device.is_cpu ? device.units : 0;
    look->device->float_lanes = device.float_lanes;
    look->device->double_lanes = device.double_lanes;
    look->device->memory = device.memory;
done:
    oz_device_close(&device);
    return status;
}

OzStatus oz_bench_limits_device(OzBenchDevice *device, const OzOptions *options)
{
    Look look = {.options = options, .device = device};
    *device = (OzBenchDevice){0};
    return oz_subprocess_run(look_at_device, &look, device, sizeof *device);
}

static OzStatus measure(void *context)
{
    OzStatus status = OZ_OK;
    Look *look = context;
    OzDevice device = {0};
    const char *source_dir = look->options->source_dir;
    size_t bytes = look->options->quick ? quick_bytes : memory_bytes;
    OZ_TRY(oz_device_open(&device, look->options->device, look->threads));
    for (int d = 0; d < (device.has_double ? 2 : 1); d++) {
        OZ_TRY(oz_limits_copy(&look->rates[d], &device, source_dir, bytes, d == 1));
        OZ_TRY(oz_limits_multiply_add(&look->rates[2 + d], &device, source_dir, d == 1));
    }
done:
    oz_device_close(&device);
    return status;
}

static OzStatus print_rates(FILE *file, const OzOptions *options, int threads)
{
    Look look = {.options = options, .threads = threads};
    OzStatus status = oz_subprocess_run(measure, &look, look.rates, sizeof look.rates);
    if (status == OZ_OK) {
        fprintf(
            file,
            "limits, %d thread%s: copy of memory %.1f GB/s (float), %.1f (double); multiply-add "
            "%.1f GFLOP/s (float), %.1f (double)\n",
            threads, threads == 1 ? "" : "s", 1e-9 * look.rates[0], 1e-9 * look.rates[1],
            1e-9 * look.rates[2], 1e-9 * look.rates[3]);
    }
    return status;
}

OzStatus oz_bench_limits_print(const OzBenchDevice *device, const OzOptions *options, FILE *file)
{
    fprintf(file, "device: %s, %d units, %d lanes of float, %d of double\n", device->name,
            device->units, device->float_lanes, device->double_lanes);
    if (device->is_cpu && device->threads > 1 && options->threads == 0) {
        OZ_PASS(print_rates(file, options, 1));
    }
    return print_rates(file, options, device->threads);
}

double oz_bench_limits_free_memory(void)
{
    char line[256];
    double kilobytes = INFINITY;
    FILE *file = fopen("/proc/meminfo", "r");
    while (file && fgets(line, sizeof line, file)) {
        if (sscanf(line, "MemAvailable: %lf", &kilobytes) == 1) {
            break;
        }
    }
    if (file) {
        fclose(file);
    }
    return 1024 * kilobytes;
}
