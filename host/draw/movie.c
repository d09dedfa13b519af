/* The life of a movie: begun, gone on with, ended. Knows nothing of what the pictures show. */
#include "draw/movie.h"

#include "base/file.h"
#include "base/log.h"
#include "base/memory.h"
#include "draw/movie_file.h"

#include <errno.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct OzMovie {
    char *path, *part, *fresh; /* where it will stand, is written, is written once more */
    OzMovieCodec codec;
    OzMovieFile file; /* part */
    int64_t frame_count;
};

OzStatus oz_movie_encoder(const char **name)
{
    OzMovieCodec codec = {0};
    OZ_PASS(oz_movie_libav_load());
    OZ_PASS(oz_movie_codec_choose(&codec, NULL));
    *name = oz_movie_codec_name(&codec);
    return OZ_OK;
}

/* Sizes and rates that no encoder takes, told in our words. */
static OzStatus check_request(int width, int height, double fps)
{
    if (width <= 0 || height <= 0 || width % 2 || height % 2 || width > 16384 || height > 16384) {
        return oz_status_fail(
            OZ_ERR_MOVIE, "movie: size %d x %d; expected even numbers up to 16384", width, height);
    }
    if (!(fps >= 0.01 && fps <= 1000)) {
        return oz_status_fail(OZ_ERR_MOVIE, "movie: %g frames a second; expected 0.01-1000", fps);
    }
    return OZ_OK;
}

static void free_movie(OzMovie *movie)
{
    oz_movie_codec_free(&movie->codec);
    oz_movie_file_close(&movie->file, movie->part);
    free(movie->path);
    free(movie->part);
    free(movie->fresh);
    free(movie);
}

/* A movie without a file. */
static OzStatus new_movie(OzMovie **movie, const char *path)
{
    OZ_PASS(OZ_NEW(movie, 1));
    OZ_PASS(oz_memory_text(&(*movie)->path, path));
    if (asprintf(&(*movie)->part, "%s.part", path) < 0 ||
        asprintf(&(*movie)->fresh, "%s.new", path) < 0) {
        return oz_status_fail(OZ_ERR_MEMORY, "out of memory for a file name");
    }
    return OZ_OK;
}

/* The metadata and the head of the file. */
static OzStatus open_file(OzMovie *movie, const char *const *metadata)
{
    OzStatus status = OZ_OK;
    AVDictionary *words = NULL;
    AVCodecParameters *parameters = NULL;
    for (; metadata && *metadata; metadata += 2) {
        AV_TRY(av->av_dict_set(&words, metadata[0], metadata[1], 0));
    }
    AV_TRY_NEW(parameters, av->avcodec_parameters_alloc());
    AV_TRY(av->avcodec_parameters_from_context(parameters, movie->codec.context));
    OZ_TRY(oz_movie_file_create(&movie->file, movie->part, true, parameters, movie->codec.rate,
                                words));
done:
    av->av_dict_free(&words);
    av->avcodec_parameters_free(&parameters);
    return status;
}

OzStatus oz_movie_create_with(OzMovie **movie, const char *path, int width, int height, double fps,
                              const char *const *metadata, const char *encoder)
{
    OzStatus status = OZ_OK;
    OzMovie *made = NULL;
    *movie = NULL;
    OZ_TRY(oz_movie_libav_load());
    OZ_TRY(new_movie(&made, path));
    OZ_TRY(check_request(width, height, fps));
    made->codec = (OzMovieCodec){.width = width, .height = height};
    made->codec.rate = av->av_d2q(fps, 60000); /* MPEG-4 allows neither part of it above 65535 */
    OZ_TRY(oz_movie_codec_choose(&made->codec, encoder));
    OZ_TRY(oz_movie_codec_open(&made->codec));
    OZ_TRY(open_file(made, metadata));
    *movie = made;
done:
    if (status != OZ_OK && made) {
        free_movie(made);
    }
    return status;
}

OzStatus oz_movie_create(OzMovie **movie, const char *path, int width, int height, double fps,
                         const char *const *metadata)
{
    return oz_movie_create_with(movie, path, width, height, fps, metadata, NULL);
}

/* Writes every packet that the encoder has ready. Packets come one a frame, so decoding goes on by
 * one a packet, from an encoder to the next. */
static OzStatus drain(OzMovie *movie)
{
    for (bool any = true;;) {
        OZ_PASS(oz_movie_codec_receive(&movie->codec, &any));
        if (!any) {
            break;
        }
        movie->codec.packet->dts = movie->file.packets - movie->codec.delay;
        OZ_PASS(oz_movie_file_add(&movie->file, movie->codec.packet));
    }
    return OZ_OK;
}

OzStatus oz_movie_add(OzMovie *movie, const OzImage *image)
{
    const OzMovieCodec *codec = &movie->codec;
    if (image->width != codec->width || image->height != codec->height) {
        return oz_status_fail(OZ_ERR_MOVIE, "movie: a picture of %d x %d for a movie of %d x %d",
                              image->width, image->height, codec->width, codec->height);
    }
    OZ_PASS(oz_movie_codec_open(&movie->codec));
    OZ_PASS(oz_movie_codec_send(&movie->codec, image, movie->frame_count));
    movie->frame_count++;
    return drain(movie);
}

/* All frames so far into the file; the next one will open another encoder. */
static OzStatus flush(OzMovie *movie)
{
    OzStatus status = OZ_OK;
    if (movie->codec.context) {
        OZ_TRY(oz_movie_codec_send(&movie->codec, NULL, 0));
        OZ_TRY(drain(movie));
    }
    if (movie->file.packets != movie->frame_count) {
        status = oz_status_fail(OZ_ERR_MOVIE, "movie: %lld packets from %lld frames",
                                (long long)movie->file.packets, (long long)movie->frame_count);
    }
done:
    oz_movie_codec_end(&movie->codec);
    return status;
}

static OzStatus give_name(const char *from, const char *to)
{
    return rename(from, to) == 0 ? OZ_OK
                                 : oz_status_fail(OZ_ERR_MOVIE, "movie: cannot rename %s to %s: %s",
                                                  from, to, strerror(errno));
}

/* Once more, with the index in front. */
static OzStatus rewrite(OzMovie *movie)
{
    OzStatus status = OZ_OK;
    OzMovieFile whole = {0};
    OZ_TRY(oz_movie_file_copy(&whole, movie->fresh, movie->part, movie->file.packets, &movie->codec,
                              false));
    OZ_TRY(oz_movie_file_end(&whole, movie->fresh));
    OZ_TRY(give_name(movie->fresh, movie->path));
    remove(movie->part);
done:
    if (status != OZ_OK) {
        remove(movie->fresh);
    }
    return status;
}

/* Closes the file and gives it its name. */
static OzStatus publish(OzMovie *movie)
{
    oz_movie_file_close(&movie->file, movie->part);
    if (movie->file.packets == 0) {
        remove(movie->part);
        return OZ_OK;
    }
    if (rewrite(movie) == OZ_OK) {
        return OZ_OK;
    }
    oz_log_line("%s; %s stays in fragments, which most players take", oz_status_text(),
                movie->path);
    return give_name(movie->part, movie->path);
}

OzStatus oz_movie_finish(OzMovie *movie)
{
    OzStatus status = OZ_OK;
    if (!movie) {
        return OZ_OK;
    }
    if (movie->frame_count > 0) {
        status = flush(movie);
    }
    OZ_AFTER(status, publish(movie));
    free_movie(movie);
    return status;
}

static OzStatus copy_first(OzMovie *movie, const char *source)
{
    return oz_movie_file_copy(&movie->file, movie->fresh, source, movie->frame_count, &movie->codec,
                              true);
}

/* The first frames, from wherever they are, as the part. */
static OzStatus go_on(OzMovie *movie)
{
    OzStatus status = oz_movie_file_mend(movie->part);
    status = status == OZ_OK ? copy_first(movie, movie->part) : status;
    if (status != OZ_OK && oz_file_exists(movie->path)) {
        status = copy_first(movie, movie->path);
    }
    OZ_TRY(status);
    OZ_TRY(oz_movie_file_sync(movie->fresh));
    OZ_TRY(give_name(movie->fresh, movie->part));
done:
    if (status != OZ_OK) {
        remove(movie->fresh);
    }
    return status;
}

/* All that an encoder must be told and must tell again. */
static OzStatus codec_state(OzMovieCodec *codec, OzStateVisit *visit)
{
    OzStatus status = OZ_OK;
    char *name = NULL;
    if (!visit->is_loading) {
        OZ_TRY(oz_memory_text(&name, oz_movie_codec_name(codec)));
    }
    OZ_TRY(oz_state_text(visit, "encoder", &name));
    OZ_TRY(oz_state_int(visit, "width", "1", &codec->width));
    OZ_TRY(oz_state_int(visit, "height", "1", &codec->height));
    OZ_TRY(oz_state_int(visit, "rate_numerator", "1/s", &codec->rate.num));
    OZ_TRY(oz_state_int(visit, "rate_denominator", "1", &codec->rate.den));
    OZ_TRY(oz_state_int(visit, "delay", "frame", &codec->delay));
    OZ_TRY(oz_state_array(visit, "head", "1", OZ_STATE_BYTES, &codec->head, &codec->head_bytes));
    if (visit->is_loading) {
        OZ_TRY(check_request(codec->width, codec->height, av_q2d(codec->rate)));
        OZ_TRY(oz_movie_codec_choose(codec, name));
    }
done:
    free(name);
    return status;
}

static OzStatus load(OzMovie **movie, const char *path, int64_t frame_count, OzStateVisit *visit)
{
    OzStatus status = OZ_OK;
    OzMovie *made = NULL;
    OZ_TRY(oz_movie_libav_load());
    OZ_TRY(new_movie(&made, path));
    OZ_TRY(codec_state(&made->codec, visit));
    made->frame_count = frame_count;
    OZ_TRY(go_on(made));
    *movie = made;
done:
    if (status != OZ_OK && made) {
        free_movie(made);
    }
    return status;
}

static OzStatus save(OzMovie *movie, OzStateVisit *visit)
{
    OZ_PASS(flush(movie));
    OZ_PASS(oz_movie_file_sync(movie->part));
    return codec_state(&movie->codec, visit);
}

OzStatus oz_movie_state(OzMovie **movie, const char *path, OzStateVisit *visit)
{
    int64_t frame_count = *movie ? (*movie)->frame_count : 0;
    OZ_PASS(oz_state_enter(visit, "movie", 1));
    OZ_PASS(oz_state_index(visit, "frame_count", &frame_count, 0, INT64_MAX));
    if (frame_count > 0) {
        OZ_PASS(visit->is_loading ? load(movie, path, frame_count, visit) : save(*movie, visit));
    }
    oz_state_leave(visit);
    return OZ_OK;
}
