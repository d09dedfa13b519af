/* The order of places is PoCL's own (its documentation of environment variables, version 3.1). */
#include "compute/kernel_cache.h"

#include "base/log.h"

#include <pthread.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

enum { PATH_SIZE = 4096 };

static char trouble[2 * PATH_SIZE];

/* Whether a folder of this name can be written or made: its deepest part that is there decides. */
static bool is_usable(const char *path)
{
    char part[PATH_SIZE];
    struct stat info;
    size_t length = strlen(path);
    if (length == 0 || length >= sizeof part) {
        return false;
    }
    memcpy(part, path, length + 1);
    while (lstat(part, &info) != 0) {
        char *slash = strrchr(part, '/');
        if (!slash) {
            strcpy(part, ".");
        } else if (slash == part) {
            strcpy(part, "/");
        } else {
            *slash = '\0';
        }
    }
    return stat(part, &info) == 0 && S_ISDIR(info.st_mode) && access(part, W_OK | X_OK) == 0;
}

/* What PoCL would take, and the variable that says so. */
static const char *usual_place(char path[PATH_SIZE])
{
    static const struct {
        const char *variable, *below;
    } rows[] = {{"POCL_CACHE_DIR", ""},
                {"XDG_CACHE_HOME", "/pocl/kcache"},
                {"HOME", "/.cache/pocl/kcache"}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const char *value = getenv(rows[i].variable);
        if (value) {
            snprintf(path, PATH_SIZE, "%s%s", value, value[0] ? rows[i].below : "");
            return rows[i].variable;
        }
    }
    snprintf(path, PATH_SIZE, "/tmp/pocl/kcache");
    return "no variable";
}

/* A folder among the temporary ones that is this user's and nobody else's. */
static bool make_own(char path[PATH_SIZE])
{
    struct stat info;
    const char *temporary = getenv("TMPDIR");
    snprintf(path, PATH_SIZE, "%s/orzo-kernels-%ld", temporary ? temporary : "/tmp",
             (long)getuid());
    mkdir(path, 0700); /* or it is there: what it is decides */
    return lstat(path, &info) == 0 && S_ISDIR(info.st_mode) && info.st_uid == getuid() &&
           (info.st_mode & 077) == 0 && access(path, W_OK | X_OK) == 0;
}

/* A built kernel takes some hundred kB; the compiler ends the process when it cannot write one. */
static void warn_of_limit(void)
{
    const double enough = 16e6;
    struct rlimit limit;
    if (getrlimit(RLIMIT_FSIZE, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY &&
        (double)limit.rlim_cur < enough) {
        oz_log_line(
            "warning: files are limited to %.4g kB here (ulimit -f): building kernels, movies "
            "and frames may fail by it",
            (double)limit.rlim_cur / 1024);
    }
}

/* Intel's vectorizer takes a minute for a program that is built in three seconds without, keeps
 * nothing of it, and makes steps slower: what there is to do side by side is in lanes already. */
static void forgo_vectorizer(void)
{
    setenv("CL_CONFIG_CPU_VECTORIZER_MODE", "1", 0);
}

static void choose(void)
{
    warn_of_limit();
    forgo_vectorizer();
    char usual[PATH_SIZE], own[PATH_SIZE];
    const char *variable = usual_place(usual);
    if (is_usable(usual)) {
        return;
    }
    if (make_own(own)) {
        oz_log_line(
            "warning: kernels cannot be kept in '%s' (by %s), which cannot be written; they "
            "are kept in %s",
            usual, variable, own);
        setenv("POCL_CACHE_DIR", own, 1);
    } else {
        snprintf(trouble, sizeof trouble,
                 "PoCL needs a folder to keep kernels in, and neither '%s' (by %s) nor %s can be "
                 "written; set POCL_CACHE_DIR to one that can",
                 usual, variable, own);
        unsetenv("POCL_CACHE_DIR"); /* an empty one would end the process */
    }
}

void oz_kernel_cache_choose(void)
{
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, choose);
}

const char *oz_kernel_cache_trouble(void)
{
    return trouble;
}
