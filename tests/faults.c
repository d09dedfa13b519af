/* Makes the n-th call of a kind fail, of those that the program itself makes: a library that is put
 * before others by LD_PRELOAD (tests/faults.sh). What libraries call among themselves is left
 * alone: they are not ours to mend.
 *
 * ORZO_FAULT=KIND:N, N from 1, says which; KIND is memory, write, open, sync, rename, opencl,
 * libav, gl or hdf5. The file $ORZO_FAULT_COUNT then receives "failed" when the call came. With N =
 * 0 it receives, at the end, how many such calls there were. The file $ORZO_FAULT_HELD receives at
 * the end what the program had not given back (leaks.h). */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <link.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>
#include <unistd.h>

#define CL_TARGET_OPENCL_VERSION 120
#define CL_USE_DEPRECATED_OPENCL_1_2_APIS
#include <CL/cl.h>

#include "leaks.h"

static atomic_long calls;
static uintptr_t base, text_begin, text_end; /* of the program */

/* The first object that is listed is the program itself. */
static int note_text(struct dl_phdr_info *info, size_t size, void *unused)
{
    (void)size;
    (void)unused;
    base = info->dlpi_addr;
    for (int i = 0; i < info->dlpi_phnum; i++) {
        const ElfW(Phdr) *part = &info->dlpi_phdr[i];
        if (part->p_type == PT_LOAD && part->p_flags & PF_X) {
            text_begin = info->dlpi_addr + part->p_vaddr;
            text_end = text_begin + part->p_memsz;
        }
    }
    return 1;
}

static void tell(const char *text)
{
    const char *path = getenv("ORZO_FAULT_COUNT");
    FILE *file = path ? fopen(path, "w") : NULL;
    if (file) {
        fputs(text, file);
        fclose(file);
    }
}

static int is_ours(void *caller)
{
    if (!text_begin) {
        dl_iterate_phdr(note_text, NULL);
    }
    return (uintptr_t)caller >= text_begin && (uintptr_t)caller < text_end;
}

/* What a call of the program's own was given. */
static void *given(void *what, void *caller)
{
    if (what && is_ours(caller)) {
        hold(what, (uintptr_t)caller - base);
    }
    return what;
}

/* Whether this call of the kind, returning to `caller`, is the one. */
static int fails(const char *kind, void *caller)
{
    static _Thread_local int inside;
    const char *fault = getenv("ORZO_FAULT");
    size_t length = strlen(kind);
    if (inside || !fault || !is_ours(caller) || strncmp(fault, kind, length) != 0 ||
        fault[length] != ':') {
        return 0;
    }
    int failing = atomic_fetch_add(&calls, 1) + 1 == atol(fault + length + 1);
    if (failing) {
        inside = 1;
        tell("failed\n");
        inside = 0;
    }
    return failing;
}

__attribute__((destructor)) static void tell_count(void)
{
    const char *fault = getenv("ORZO_FAULT");
    char text[32];
    if (fault && strstr(fault, ":0")) {
        snprintf(text, sizeof text, "%ld\n", atomic_load(&calls));
        unsetenv("ORZO_FAULT");
        tell(text);
    }
    tell_held(getenv("ORZO_FAULT_HELD"));
}

static void *next(const char *name)
{
    static void *(*real)(void *, const char *);
    if (!real) {
        *(void **)&real = dlvsym(RTLD_NEXT, "dlsym", "GLIBC_2.34");
    }
    return real(RTLD_NEXT, name);
}

/* A function of libc: what it gives when it fails, and errno. */
#define FAULT(kind, result, name, parameters, arguments, failure, code)                            \
    result name parameters                                                                         \
    {                                                                                              \
        static result(*real) parameters;                                                           \
        if (!real) {                                                                               \
            *(void **)&real = next(#name);                                                         \
        }                                                                                          \
        if (fails(kind, __builtin_return_address(0))) {                                            \
            errno = code;                                                                          \
            return failure;                                                                        \
        }                                                                                          \
        return real arguments;                                                                     \
    }

/* The same of one that gives something to be given back. */
#define FAULT_GIVEN(kind, result, name, parameters, arguments, code)                               \
    result name parameters                                                                         \
    {                                                                                              \
        static result(*real) parameters;                                                           \
        if (!real) {                                                                               \
            *(void **)&real = next(#name);                                                         \
        }                                                                                          \
        if (fails(kind, __builtin_return_address(0))) {                                            \
            errno = code;                                                                          \
            return NULL;                                                                           \
        }                                                                                          \
        return given(real arguments, __builtin_return_address(0));                                 \
    }

FAULT_GIVEN("memory", void *, malloc, (size_t size), (size), ENOMEM)
FAULT_GIVEN("memory", char *, strdup, (const char *text), (text), ENOMEM)
FAULT_GIVEN("memory", char *, strndup, (const char *text, size_t size), (text, size), ENOMEM)
FAULT_GIVEN("memory", FILE *, open_memstream, (char **text, size_t *size), (text, size), ENOMEM)
FAULT_GIVEN("open", FILE *, fopen, (const char *path, const char *mode), (path, mode), EMFILE)
FAULT("open", int, mkdir, (const char *path, mode_t mode), (path, mode), -1, EACCES)
/* A failure leaves its mark on the stream, as glibc's own does. */
size_t fwrite(const void *items, size_t size, size_t count, FILE *file)
{
    enum { ERROR_SEEN = 0x20 };
    static size_t (*real)(const void *, size_t, size_t, FILE *);
    if (!real) {
        *(void **)&real = next("fwrite");
    }
    if (fails("write", __builtin_return_address(0))) {
        errno = ENOSPC;
        file->_flags |= ERROR_SEEN;
        return 0;
    }
    return real(items, size, count, file);
}
FAULT("write", int, fflush, (FILE * file), (file), EOF, ENOSPC)
/* A stream is gone also when closing fails. */
int fclose(FILE *file)
{
    static int (*real)(FILE *);
    if (!real) {
        *(void **)&real = next("fclose");
    }
    let_go(file);
    int closed = real(file);
    if (fails("write", __builtin_return_address(0))) {
        errno = ENOSPC;
        return EOF;
    }
    return closed;
}
FAULT("write", ssize_t, write, (int file, const void *bytes, size_t size), (file, bytes, size), -1,
      ENOSPC)
FAULT("sync", int, fsync, (int file), (file), -1, EIO)
FAULT("rename", int, rename, (const char *from, const char *to), (from, to), -1, EACCES)

static char early[4096]; /* what was given before there was a calloc */

static int is_early(const void *what)
{
    return (uintptr_t)what >= (uintptr_t)early && (uintptr_t)what < (uintptr_t)early + sizeof early;
}

void *realloc(void *old, size_t size)
{
    static void *(*real)(void *, size_t);
    if (!real) {
        *(void **)&real = next("realloc");
    }
    if (fails("memory", __builtin_return_address(0))) {
        errno = ENOMEM;
        return NULL;
    }
    let_go(old);
    return given(real(old, size), __builtin_return_address(0));
}

void free(void *what)
{
    static void (*real)(void *);
    if (!real) {
        *(void **)&real = next("free");
    }
    let_go(what);
    if (!is_early(what)) {
        real(what);
    }
}

/* dlsym itself calls calloc before there is one to call: that is served from here. */
void *calloc(size_t count, size_t size)
{
    static void *(*real)(size_t, size_t);
    static _Thread_local int looking;
    static size_t used;
    if (!real) {
        if (looking) {
            void *block = early + used;
            used += (count * size + 15) / 16 * 16;
            return used <= sizeof early ? block : NULL;
        }
        looking = 1;
        *(void **)&real = next("calloc");
        looking = 0;
    }
    if (fails("memory", __builtin_return_address(0))) {
        errno = ENOMEM;
        return NULL;
    }
    return given(real(count, size), __builtin_return_address(0));
}

FAULT("opencl", cl_int, clEnqueueNDRangeKernel,
      (cl_command_queue q, cl_kernel k, cl_uint d, const size_t *o, const size_t *g,
       const size_t *l, cl_uint n, const cl_event *w, cl_event *e),
      (q, k, d, o, g, l, n, w, e), CL_OUT_OF_RESOURCES, 0)
FAULT("opencl", cl_int, clEnqueueReadBuffer,
      (cl_command_queue q, cl_mem b, cl_bool h, size_t o, size_t s, void *p, cl_uint n,
       const cl_event *w, cl_event *e),
      (q, b, h, o, s, p, n, w, e), CL_OUT_OF_RESOURCES, 0)
FAULT("opencl", cl_int, clEnqueueWriteBuffer,
      (cl_command_queue q, cl_mem b, cl_bool h, size_t o, size_t s, const void *p, cl_uint n,
       const cl_event *w, cl_event *e),
      (q, b, h, o, s, p, n, w, e), CL_OUT_OF_RESOURCES, 0)
FAULT("opencl", cl_int, clEnqueueFillBuffer,
      (cl_command_queue q, cl_mem b, const void *p, size_t ps, size_t o, size_t s, cl_uint n,
       const cl_event *w, cl_event *e),
      (q, b, p, ps, o, s, n, w, e), CL_OUT_OF_RESOURCES, 0)
FAULT("opencl", cl_int, clFinish, (cl_command_queue q), (q), CL_OUT_OF_RESOURCES, 0)
FAULT("opencl", cl_int, clSetKernelArg, (cl_kernel k, cl_uint i, size_t s, const void *p),
      (k, i, s, p), CL_OUT_OF_RESOURCES, 0)
FAULT("opencl", cl_int, clBuildProgram,
      (cl_program p, cl_uint n, const cl_device_id *d, const char *o,
       void(CL_CALLBACK *f)(cl_program, void *), void *u),
      (p, n, d, o, f, u), CL_BUILD_PROGRAM_FAILURE, 0)

#define FAULT_MADE(result, name, parameters, arguments)                                            \
    result name parameters                                                                         \
    {                                                                                              \
        static result(*real) parameters;                                                           \
        if (!real) {                                                                               \
            *(void **)&real = next(#name);                                                         \
        }                                                                                          \
        if (fails("opencl", __builtin_return_address(0))) {                                        \
            *code = CL_OUT_OF_HOST_MEMORY;                                                         \
            return NULL;                                                                           \
        }                                                                                          \
        return given(real arguments, __builtin_return_address(0));                                 \
    }
FAULT_MADE(cl_mem, clCreateBuffer, (cl_context c, cl_mem_flags f, size_t s, void *h, cl_int *code),
           (c, f, s, h, code))
FAULT_MADE(cl_kernel, clCreateKernel, (cl_program p, const char *name, cl_int *code),
           (p, name, code))
FAULT_MADE(cl_command_queue, clCreateCommandQueue,
           (cl_context c, cl_device_id d, cl_command_queue_properties f, cl_int *code),
           (c, d, f, code))
FAULT_MADE(cl_program, clCreateProgramWithSource,
           (cl_context c, cl_uint n, const char **t, const size_t *l, cl_int *code),
           (c, n, t, l, code))
FAULT_MADE(cl_context, clCreateContext,
           (const cl_context_properties *p, cl_uint n, const cl_device_id *d,
            void(CL_CALLBACK *f)(const char *, const void *, size_t, void *), void *u,
            cl_int *code),
           (p, n, d, f, u, code))

#define RELEASE(name, type)                                                                        \
    cl_int name(type what)                                                                         \
    {                                                                                              \
        static cl_int (*real)(type);                                                               \
        if (!real) {                                                                               \
            *(void **)&real = next(#name);                                                         \
        }                                                                                          \
        if (is_ours(__builtin_return_address(0))) {                                                \
            let_go(what);                                                                          \
        }                                                                                          \
        return real(what);                                                                         \
    }
RELEASE(clReleaseMemObject, cl_mem)
RELEASE(clReleaseKernel, cl_kernel)
RELEASE(clReleaseProgram, cl_program)
RELEASE(clReleaseCommandQueue, cl_command_queue)
RELEASE(clReleaseContext, cl_context)

#include "by_name.h"

void *dlsym(void *library, const char *name)
{
    static void *(*real)(void *, const char *);
    if (!real) {
        *(void **)&real = dlvsym(RTLD_NEXT, "dlsym", "GLIBC_2.34");
    }
    void *found = real(library, name);
    return found && is_ours(__builtin_return_address(0)) ? stand_in(name, found) : found;
}
