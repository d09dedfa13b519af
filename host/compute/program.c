/* Flattening and building kernel programs. */
#include "compute/program.h"

#include "base/embed.h"
#include "base/memory.h"
#include "base/stage.h"
#include "compute/cl_try.h"

#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

enum { FILES_MAX = 128, DEPTH_MAX = 16 };

typedef struct Flat {
    FILE *out;
    const char *source_dir;
    char *seen[FILES_MAX];
    int seen_count;
} Flat;

static bool seen_before(const Flat *flat, const char *name)
{
    for (int i = 0; i < flat->seen_count; i++) {
        if (strcmp(flat->seen[i], name) == 0) {
            return true;
        }
    }
    return false;
}

static OzStatus add_file(Flat *flat, const char *name, int depth);

/* One line of a file: an include of ours is replaced, anything else is copied. "#pragma once" is
 * done by then, and compilers warn of it in what is not included. */
static OzStatus add_line(Flat *flat, const char *file, int number, const char *line, int depth)
{
    char included[256];
    if (sscanf(line, " #include \"%255[^\"]\"", included) != 1) {
        fprintf(flat->out, "%s\n", strcmp(line, "#pragma once") == 0 ? "" : line);
        return OZ_OK;
    }
    OzStatus status = OZ_OK;
    if (!seen_before(flat, included)) {
        status = add_file(flat, included, depth + 1);
    }
    fprintf(flat->out, "#line %d \"%s\"\n", number + 1, file);
    return status;
}

static OzStatus add_file(Flat *flat, const char *name, int depth)
{
    OzStatus status = OZ_OK;
    char *text = NULL;
    if (depth > DEPTH_MAX || flat->seen_count == FILES_MAX) {
        return oz_status_fail(OZ_ERR_DEVICE, "kernel includes nest too deeply at %s", name);
    }
    OZ_TRY(oz_memory_text(&flat->seen[flat->seen_count], name));
    flat->seen_count++;
    OZ_TRY(oz_embed_read(&text, flat->source_dir, name));
    fprintf(flat->out, "#line 1 \"%s\"\n", name);
    int number = 1;
    for (char *line = text; line; number++) {
        char *end = strchr(line, '\n');
        if (end) {
            *end = '\0';
        }
        OZ_TRY(add_line(flat, name, number, line, depth));
        line = end ? end + 1 : NULL;
    }
done:
    free(text);
    return status;
}

static OzStatus flatten_file(char **text, const char *source_dir, const char *name)
{
    Flat flat = {.source_dir = source_dir};
    size_t size = 0;
    *text = NULL;
    flat.out = open_memstream(text, &size);
    if (!flat.out) {
        return oz_status_fail(OZ_ERR_MEMORY, "out of memory for kernel source");
    }
    OzStatus status = add_file(&flat, name, 0);
    fclose(flat.out);
    for (int i = 0; i < flat.seen_count; i++) {
        free(flat.seen[i]);
    }
    if (status != OZ_OK) {
        free(*text);
        *text = NULL;
    }
    return status;
}

/* A limit of files' size, which a driver's cache of kernels may have met: drivers do not say so. */
static void name_limit(char *text, size_t size)
{
    struct rlimit limit;
    if (getrlimit(RLIMIT_FSIZE, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) {
        snprintf(text, size,
                 "; files are limited to %.4g kB here (ulimit -f), which may be too little for "
                 "built kernels",
                 (double)limit.rlim_cur / 1024);
    }
}

static OzStatus build_failed(cl_program program, const OzDevice *device, cl_int code,
                             const char *name)
{
    static const size_t shown = 12000; /* the failure text holds 16 kB */
    size_t size = 0;
    clGetProgramBuildInfo(program, device->id, CL_PROGRAM_BUILD_LOG, 0, NULL, &size);
    char *log = calloc(size + 1, 1), limit[160] = "";
    name_limit(limit, sizeof limit);
    if (log) {
        clGetProgramBuildInfo(program, device->id, CL_PROGRAM_BUILD_LOG, size, log, NULL);
        log[size > shown ? shown : size] = '\0';
    }
    OzStatus status =
        oz_status_fail(OZ_ERR_DEVICE, "OpenCL: building %s for %s failed: %s%s\n%s", name,
                       device->name, oz_cl_try_name(code), limit, log ? log : "");
    free(log);
    return status;
}

OzStatus oz_program_build(cl_program *program, const OzDevice *device, const char *source_dir,
                          const char *name, const char *options)
{
    OzStatus status = OZ_OK;
    cl_int code = CL_SUCCESS;
    char *text = NULL, all[2048];
    *program = NULL;
    OZ_TRY(flatten_file(&text, source_dir, name));
    *program = clCreateProgramWithSource(device->context, 1, (const char **)&text, NULL, &code);
    CL_TRY(code);
    snprintf(all, sizeof all, "-cl-std=CL1.2 %s", options);
    OzStage stage;
    oz_stage_begin(&stage, "building kernels");
    code = clBuildProgram(*program, 1, &device->id, all, NULL, NULL);
    oz_stage_end(&stage);
    if (code != CL_SUCCESS) {
        status = build_failed(*program, device, code, name);
    }
done:
    if (status != OZ_OK && *program) {
        clReleaseProgram(*program);
        *program = NULL;
    }
    free(text);
    return status;
}

/* What the program itself says of the sizes in `layout`, in their order. */
static OzStatus ask_layout(cl_program program, const OzDevice *device, cl_int answer[5])
{
    OzStatus status = OZ_OK;
    cl_int code = CL_SUCCESS;
    cl_mem buffer = NULL;
    size_t one = 1, bytes = 5 * sizeof answer[0];
    cl_kernel kernel = clCreateKernel(program, "oz_layout", &code);
    CL_TRY(code);
    buffer = clCreateBuffer(device->context, CL_MEM_READ_WRITE, bytes, NULL, &code);
    CL_TRY(code);
    CL_TRY(clSetKernelArg(kernel, 0, sizeof buffer, &buffer));
    CL_TRY(clEnqueueNDRangeKernel(device->queue, kernel, 1, NULL, &one, &one, 0, NULL, NULL));
    CL_TRY(clEnqueueReadBuffer(device->queue, buffer, CL_TRUE, 0, bytes, answer, 0, NULL, NULL));
done:
    CL_RELEASE(MemObject, buffer);
    CL_RELEASE(Kernel, kernel);
    return status;
}

OzStatus oz_program_check(cl_program program, const OzDevice *device, const OzLayout *layout)
{
    cl_int answer[5] = {0};
    size_t scalar = layout->is_double ? 8 : 4;
    OZ_PASS(ask_layout(program, device, answer));
    if ((size_t)answer[0] != layout->parameters * scalar || (size_t)answer[1] != layout->control ||
        (size_t)answer[2] != layout->sizes || (size_t)answer[3] != scalar ||
        answer[4] != layout->lanes) {
        return oz_status_fail(OZ_ERR_DEVICE,
                              "host and %s disagree about struct sizes (parameters %d, control "
                              "%d, sizes %d bytes): rebuild orzo",
                              device->name, answer[0], answer[1], answer[2]);
    }
    return OZ_OK;
}
