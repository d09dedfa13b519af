/* Stand-ins for functions that the program finds by name, of libav, EGL, OSMesa, OpenGL and
 * libhdf5: one may fail, and what they give and take back is counted (leaks.h). For tests/faults.c,
 * whose `fails`, `given` and `base` it uses.
 *
 * All are called alike, with ten words, which is more than any of them has: on x86-64 and AArch64
 * Linux a function does not look at words beyond its own. None has a floating argument. */
#pragma once

#include <stdint.h>
#include <string.h>

#include "leaks.h"

#define WORDS  long a, long b, long c, long d, long e, long f, long g, long h, long i, long j
#define PASSED a, b, c, d, e, f, g, h, i, j
typedef long Any(WORDS);

#define NO_SPACE  (-28L) /* AVERROR(ENOSPC) */
#define OUT_OF_GL 0x505L /* GL_OUT_OF_MEMORY */
#define WHERE     ((uintptr_t)__builtin_return_address(0) - base)

/* X(function, kind, what it returns when it fails). */
#define FAILING(X)                                                                                 \
    X(avcodec_open2, "libav", NO_SPACE)                                                            \
    X(avcodec_send_frame, "libav", NO_SPACE)                                                       \
    X(avcodec_receive_packet, "libav", NO_SPACE)                                                   \
    X(avcodec_parameters_copy, "libav", NO_SPACE)                                                  \
    X(avcodec_parameters_from_context, "libav", NO_SPACE)                                          \
    X(avformat_new_stream, "libav", 0)                                                             \
    X(avformat_write_header, "libav", NO_SPACE)                                                    \
    X(av_write_frame, "libav", NO_SPACE)                                                           \
    X(av_write_trailer, "libav", NO_SPACE)                                                         \
    X(av_read_frame, "libav", NO_SPACE)                                                            \
    X(av_dict_set, "libav", NO_SPACE)                                                              \
    X(av_dict_copy, "libav", NO_SPACE)                                                             \
    X(av_frame_get_buffer, "libav", NO_SPACE)                                                      \
    X(av_frame_make_writable, "libav", NO_SPACE)                                                   \
    X(av_mallocz, "libav", 0)                                                                      \
    X(sws_setColorspaceDetails, "libav", -1)                                                       \
    X(sws_scale, "libav", NO_SPACE)                                                                \
    X(eglGetPlatformDisplayEXT, "gl", 0)                                                           \
    X(eglInitialize, "gl", 0)                                                                      \
    X(eglBindAPI, "gl", 0)                                                                         \
    X(eglChooseConfig, "gl", 0)                                                                    \
    X(OSMesaMakeCurrent, "gl", 0)                                                                  \
    X(glGetError, "gl", OUT_OF_GL)                                                                 \
    X(glCheckFramebufferStatus, "gl", 0)                                                           \
    X(H5Pcreate, "hdf5", -1)                                                                       \
    X(H5Fcreate, "hdf5", -1)                                                                       \
    X(H5Fopen, "hdf5", -1)                                                                         \
    X(H5Fflush, "hdf5", -1)                                                                        \
    X(H5Fget_file_image, "hdf5", -1)                                                               \
    X(H5Screate, "hdf5", -1)                                                                       \
    X(H5Screate_simple, "hdf5", -1)                                                                \
    X(H5Tcopy, "hdf5", -1)                                                                         \
    X(H5Acreate2, "hdf5", -1)                                                                      \
    X(H5Awrite, "hdf5", -1)                                                                        \
    X(H5Dcreate2, "hdf5", -1)                                                                      \
    X(H5Dwrite, "hdf5", -1)

/* X(function, kind): returns what is to be given back, NULL when it fails. */
#define GIVING(X)                                                                                  \
    X(av_frame_alloc, "libav")                                                                     \
    X(av_packet_alloc, "libav")                                                                    \
    X(avcodec_alloc_context3, "libav")                                                             \
    X(avcodec_parameters_alloc, "libav")                                                           \
    X(avio_alloc_context, "libav")                                                                 \
    X(sws_getContext, "libav")                                                                     \
    X(eglCreateContext, "gl")                                                                      \
    X(OSMesaCreateContextAttribs, "gl")

/* Of libav: puts it where its first word points. */
#define PUTTING(X) X(avformat_alloc_output_context2) X(avformat_open_input) X(avio_open)

/* X(function, the word that it takes back); and those that take back what a word points at. */
#define TAKING(X)                                                                                  \
    X(avformat_free_context, a)                                                                    \
    X(sws_freeContext, a)                                                                          \
    X(OSMesaDestroyContext, a)
#define TAKING_AT(X)                                                                               \
    X(av_frame_free)                                                                               \
    X(av_packet_free)                                                                              \
    X(avcodec_free_context)                                                                        \
    X(avcodec_parameters_free)                                                                     \
    X(avformat_close_input)                                                                        \
    X(avio_closep)                                                                                 \
    X(avio_context_free)

/* OpenGL's objects are numbers, of one row each for its makers and what deletes them. */
#define GL_NUMBERED(X)                                                                             \
    X(Buffers, 1)                                                                                  \
    X(Framebuffers, 2)                                                                             \
    X(Textures, 3)                                                                                 \
    X(VertexArrays, 4)
#define GL_BUILT(X) X(Shader, 5) X(Program, 6)

static const void *gl_object(long row, unsigned number)
{
    return number ? (const void *)(((uintptr_t)row << 48) + ((uintptr_t)number << 4)) : NULL;
}

/* clang-format off */
#define FAIL(name, kind, failure)                                                                  \
    static Any *real_##name;                                                                       \
    static long other_##name(WORDS)                                                                \
    {                                                                                              \
        return fails(kind, __builtin_return_address(0)) ? failure : real_##name(PASSED);           \
    }
#define GIVE(name, kind)                                                                           \
    static Any *real_##name;                                                                       \
    static long other_##name(WORDS)                                                                \
    {                                                                                              \
        void *caller = __builtin_return_address(0);                                                \
        return fails(kind, caller) ? 0 : (long)given((void *)real_##name(PASSED), caller);         \
    }
#define PUT(name)                                                                                  \
    static Any *real_##name;                                                                       \
    static long other_##name(WORDS)                                                                \
    {                                                                                              \
        void *caller = __builtin_return_address(0);                                                \
        int code = fails("libav", caller) ? (int)NO_SPACE : (int)real_##name(PASSED);              \
        given(code >= 0 ? *(void **)a : NULL, caller);                                             \
        return code;                                                                               \
    }
#define TAKE(name, word)                                                                           \
    static Any *real_##name;                                                                       \
    static long other_##name(WORDS)                                                                \
    {                                                                                              \
        let_go((void *)word);                                                                      \
        return real_##name(PASSED);                                                                \
    }
#define TAKE_AT(name)                                                                              \
    static Any *real_##name;                                                                       \
    static long other_##name(WORDS)                                                                \
    {                                                                                              \
        let_go(*(void **)a);                                                                       \
        return real_##name(PASSED);                                                                \
    }
#define GL_NUMBER(name, row)                                                                       \
    static Any *real_glGen##name, *real_glDelete##name;                                            \
    static long other_glGen##name(WORDS)                                                           \
    {                                                                                              \
        long result = real_glGen##name(PASSED);                                                    \
        for (int k = 0; k < (int)a; k++) {                                                         \
            hold(gl_object(row, ((unsigned *)b)[k]), WHERE);                                       \
        }                                                                                          \
        return result;                                                                             \
    }                                                                                              \
    static long other_glDelete##name(WORDS)                                                        \
    {                                                                                              \
        for (int k = 0; k < (int)a; k++) {                                                         \
            let_go(gl_object(row, ((unsigned *)b)[k]));                                            \
        }                                                                                          \
        return real_glDelete##name(PASSED);                                                        \
    }
#define GL_BUILD(name, row)                                                                        \
    static Any *real_glCreate##name, *real_glDelete##name;                                         \
    static long other_glCreate##name(WORDS)                                                        \
    {                                                                                              \
        int failing = fails("gl", __builtin_return_address(0));                                    \
        unsigned number = failing ? 0 : (unsigned)real_glCreate##name(PASSED);                     \
        if (number) {                                                                              \
            hold(gl_object(row, number), WHERE);                                                   \
        }                                                                                          \
        return number;                                                                             \
    }                                                                                              \
    static long other_glDelete##name(WORDS)                                                        \
    {                                                                                              \
        let_go(gl_object(row, (unsigned)a));                                                       \
        return real_glDelete##name(PASSED);                                                        \
    }
FAILING(FAIL)
GIVING(GIVE)
PUTTING(PUT)
TAKING(TAKE)
TAKING_AT(TAKE_AT)
GL_NUMBERED(GL_NUMBER)
GL_BUILT(GL_BUILD)
/* clang-format on */

/* A function of the real library by name, or ours before it. */
static void *stand_in(const char *name, void *found);

/* A context that cannot be made current takes its objects with it when it goes. */
static atomic_int is_lost;
static Any *real_eglMakeCurrent, *real_eglDestroyContext;

static long other_eglMakeCurrent(WORDS)
{
    int failing = fails("gl", __builtin_return_address(0));
    if (failing) {
        atomic_store(&is_lost, 1);
    }
    return failing ? 0 : real_eglMakeCurrent(PASSED);
}

static long other_eglDestroyContext(WORDS)
{
    let_go((void *)b);
    if (atomic_load(&is_lost)) {
        let_go_numbered();
    }
    return real_eglDestroyContext(PASSED);
}

/* Of EGL and OSMesa: a function that it does not find is missing. */
static Any *real_eglGetProcAddress, *real_OSMesaGetProcAddress;

static void *find_gl(Any *find, long name, void *caller)
{
    void *found = fails("gl", caller) ? NULL : (void *)find(name, 0, 0, 0, 0, 0, 0, 0, 0, 0);
    return found ? stand_in((const char *)name, found) : NULL;
}

static long other_eglGetProcAddress(WORDS)
{
    (void)b, (void)c, (void)d, (void)e, (void)f, (void)g, (void)h, (void)i, (void)j;
    return (long)find_gl(real_eglGetProcAddress, a, __builtin_return_address(0));
}

static long other_OSMesaGetProcAddress(WORDS)
{
    (void)b, (void)c, (void)d, (void)e, (void)f, (void)g, (void)h, (void)i, (void)j;
    return (long)find_gl(real_OSMesaGetProcAddress, a, __builtin_return_address(0));
}

static void *stand_in(const char *name, void *found)
{
#define ROW(known)                                                                                 \
    if (strcmp(name, #known) == 0) {                                                               \
        *(void **)&real_##known = found;                                                           \
        return (void *)other_##known;                                                              \
    }
#define ROW_2(known, second)       ROW(known)
#define ROW_3(known, second, last) ROW(known)
#define ROW_NUMBERED(known, row)   ROW(glGen##known) ROW(glDelete##known)
#define ROW_BUILT(known, row)      ROW(glCreate##known) ROW(glDelete##known)
    FAILING(ROW_3)
    GIVING(ROW_2)
    PUTTING(ROW)
    TAKING(ROW_2)
    TAKING_AT(ROW)
    GL_NUMBERED(ROW_NUMBERED)
    GL_BUILT(ROW_BUILT)
    ROW(eglMakeCurrent)
    ROW(eglDestroyContext)
    ROW(eglGetProcAddress)
    ROW(OSMesaGetProcAddress)
    return found;
}
