/* Estimating what a member needs. */
#include "run/capacity.h"

#include "sim/batch_fit.h"

#include <math.h>
#include <sys/resource.h>
#include <unistd.h>

static double files_at_most(void)
{
    struct rlimit limit;
    if (getrlimit(RLIMIT_NOFILE, &limit) != 0) {
        return 256;
    }
    limit.rlim_cur = limit.rlim_max;
    setrlimit(RLIMIT_NOFILE, &limit);
    getrlimit(RLIMIT_NOFILE, &limit);
    return (double)limit.rlim_cur;
}

/* A grain's start, snapshot and scratch; a series; an encoder's pictures in flight. */
static double host_bytes(const OzOptions *options, const OzMember *member)
{
    const double grain = 1500, series = 1e5, pixel = 60;
    const OzMovieSettings *movie = &member->scene->movie;
    double pixels = movie->present && !options->no_video ? (double)movie->width * movie->height : 0;
    return grain * (double)member->grains->count + series + pixel * pixels;
}

OzStatus oz_capacity_most(const OzOptions *options, const OzDevice *device, const OzMember *member,
                          int64_t *most, double *bytes)
{
    const double other_files = 64, files = 4; /* series, frames, movie, its folder's lock */
    double here = host_bytes(options, member), there = 0;
    double spare = (double)sysconf(_SC_AVPHYS_PAGES) * (double)sysconf(_SC_PAGESIZE);
    OzStatus status = oz_batch_fit_most(device, member, most, &there);
    double room = 0.7 * spare / (here + (device->is_cpu ? there : 0));
    room = fmin(room, (files_at_most() - other_files) / files);
    *most = (int64_t)fmax(1, fmin((double)*most, room));
    *bytes = here + there;
    return status;
}
