/* Opening libav, its failures and its log. Knows nothing of movies. */
#include "draw/movie_libav.h"

#include "base/log.h"

#include <dlfcn.h>
#include <pthread.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

OzMovieLibav oz_movie_libav_table;

OzStatus oz_movie_libav_check(int code, const char *call, const char *file, int line)
{
    if (code >= 0) {
        return OZ_OK;
    }
    char reason[AV_ERROR_MAX_STRING_SIZE] = "unknown reason";
    const char *slash = strrchr(file, '/');
    av->av_strerror(code, reason, sizeof reason);
    return oz_status_fail(OZ_ERR_MOVIE, "movie: %s failed: %s (%d, draw/%s:%d)", call, reason, code,
                          slash ? slash + 1 : file, line);
}

/* libav's own words: warnings and worse go to the log of the thread that they come from, everything
 * else nowhere. */
static void take_log(void *source, int level, const char *format, va_list arguments)
{
    char line[1024];
    int starts_line = 1;
    if (level > AV_LOG_WARNING) {
        return;
    }
    av->av_log_format_line(source, level, format, arguments, line, sizeof line, &starts_line);
    line[strcspn(line, "\n")] = '\0';
    oz_log_detail("libav: %s", line);
}

/* Fills `into` with the address of name: ISO C has no cast from an object to a function pointer. */
static OzStatus find_function(void *library, const char *name, void *into)
{
    void *address = dlsym(library, name);
    if (!address) {
        return oz_status_fail(OZ_ERR_MOVIE, "movie: libav lacks %s: %s", name, dlerror());
    }
    memcpy(into, &address, sizeof address);
    return OZ_OK;
}

static OzStatus open_library(void **library, const char *name)
{
    *library = dlopen(name, RTLD_NOW | RTLD_LOCAL);
    if (!*library) {
        return oz_status_fail(OZ_ERR_MOVIE,
                              "movie: cannot open %s: %s; install FFmpeg's libraries, or run "
                              "without a movie",
                              name, dlerror());
    }
    return OZ_OK;
}

#define FIND(function)      OZ_PASS(find_function(library, #function, &oz_movie_libav_table.function));
#define SONAME(name, major) "lib" name ".so." AV_STRINGIFY(major)

/* The libraries stay open to the end of the process: they keep data of their own per thread. */
static OzStatus load_libraries(void)
{
    void *library = NULL;
    OZ_PASS(open_library(&library, SONAME("avutil", LIBAVUTIL_VERSION_MAJOR)));
    OZ_AVUTIL_FUNCTIONS(FIND)
    OZ_PASS(open_library(&library, SONAME("avcodec", LIBAVCODEC_VERSION_MAJOR)));
    OZ_AVCODEC_FUNCTIONS(FIND)
    OZ_PASS(open_library(&library, SONAME("avformat", LIBAVFORMAT_VERSION_MAJOR)));
    OZ_AVFORMAT_FUNCTIONS(FIND)
    av->av_log_set_callback(take_log);
    return OZ_OK;
}

OzStatus oz_movie_libav_load(void)
{
    static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
    static bool loaded;
    OzStatus status = OZ_OK;
    pthread_mutex_lock(&lock);
    if (!loaded) {
        status = load_libraries();
        loaded = status == OZ_OK;
    }
    pthread_mutex_unlock(&lock);
    return status;
}
