/* Mp4 files, written and copied packet by packet. Knows no picture and no encoder. */
#include "draw/movie_file.h"

#include "base/log.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* The index of a chain comes with its first packet, which says by how much decoding is ahead.
 * use_metadata_tags keeps keys that mp4 has no name for, such as the device. */
static const char *const CHAIN =
    "+frag_custom+delay_moov+default_base_moof+skip_trailer+use_metadata_tags";
static const char *const DONE = "+faststart+use_metadata_tags";

OzStatus oz_movie_file_create(OzMovieFile *file, const char *path, bool is_chain,
                              const AVCodecParameters *parameters, AVRational rate,
                              const AVDictionary *metadata)
{
    OzStatus status = OZ_OK;
    AVDictionary *options = NULL;
    *file = (OzMovieFile){.rate = rate, .is_chain = is_chain};
    AV_TRY(av->avformat_alloc_output_context2(&file->format, NULL, "mp4", path));
    AV_TRY_NEW(file->stream, av->avformat_new_stream(file->format, NULL));
    file->stream->time_base = (AVRational){rate.den, rate.num};
    file->stream->avg_frame_rate = rate;
    AV_TRY(av->avcodec_parameters_copy(file->stream->codecpar, parameters));
    file->stream->codecpar->codec_tag = 0; /* the writer chooses: readers name some differently */
    AV_TRY(av->av_dict_copy(&file->format->metadata, metadata, 0));
    AV_TRY(av->av_dict_set(&options, "movflags", is_chain ? CHAIN : DONE, 0));
    AV_TRY(av->avio_open(&file->format->pb, path, AVIO_FLAG_WRITE));
    AV_TRY(av->avformat_write_header(file->format, &options));
done:
    if (options) {
        av->av_dict_free(&options);
    }
    if (status != OZ_OK && file->format && file->format->pb) {
        remove(path);
    }
    if (status != OZ_OK) {
        oz_movie_file_close(file, path);
    }
    return status;
}

/* Ends a fragment with what was written since the last one: the first call of a file writes its
 * head only. */
static OzStatus cut_fragment(OzMovieFile *file)
{
    for (int calls = file->whole == 0 ? 2 : 1; calls > 0; calls--) {
        AV_PASS(av->av_write_frame(file->format, NULL));
    }
    av->avio_flush(file->format->pb);
    AV_PASS(file->format->pb->error);
    file->whole = av->avio_seek(file->format->pb, 0, SEEK_CUR);
    return OZ_OK;
}

OzStatus oz_movie_file_add(OzMovieFile *file, AVPacket *packet)
{
    AVRational frame = {file->rate.den, file->rate.num};
    packet->stream_index = file->stream->index;
    av->av_packet_rescale_ts(packet, frame, file->stream->time_base);
    AV_PASS(av->av_write_frame(file->format, packet));
    if (file->is_chain) {
        OZ_PASS(cut_fragment(file));
    }
    file->packets++;
    return OZ_OK;
}

OzStatus oz_movie_file_sync(const char *path)
{
    int handle = open(path, O_RDONLY | O_CLOEXEC);
    bool good = handle >= 0 && fsync(handle) == 0;
    OzStatus status =
        good ? OZ_OK
             : oz_status_fail(OZ_ERR_MOVIE, "movie: cannot write %s: %s", path, strerror(errno));
    if (handle >= 0) {
        close(handle);
    }
    return status;
}

OzStatus oz_movie_file_end(OzMovieFile *file, const char *path)
{
    OzStatus status = OZ_OK;
    AV_TRY(av->av_write_trailer(file->format));
    AV_TRY(av->avio_closep(&file->format->pb));
    OZ_TRY(oz_movie_file_sync(path));
done:
    oz_movie_file_close(file, path);
    return status;
}

void oz_movie_file_close(OzMovieFile *file, const char *path)
{
    bool was_open = file->format && file->format->pb;
    if (was_open) {
        av->avio_closep(&file->format->pb);
    }
    if (file->format) {
        av->avformat_free_context(file->format);
    }
    if (was_open && file->is_chain && truncate(path, file->whole) != 0 && errno != ENOENT) {
        oz_log_detail("movie: cannot cut %s: %s", path, strerror(errno));
    }
    file->format = NULL;
    file->stream = NULL;
}

/* The bytes of an open file up to the end of its last box of data that is whole; boxes of 64-bit
 * sizes are none of a fragment's. */
static int64_t count_whole(int handle)
{
    int64_t whole = 0, at = 0, bytes = lseek(handle, 0, SEEK_END);
    uint8_t head[8];
    while (pread(handle, head, sizeof head, at) == (ssize_t)sizeof head) {
        int64_t size = (int64_t)head[0] << 24 | head[1] << 16 | head[2] << 8 | head[3];
        if (size < (int64_t)sizeof head || size > bytes - at) {
            break;
        }
        at += size;
        whole = memcmp(head + 4, "mdat", 4) == 0 ? at : whole;
    }
    return whole;
}

OzStatus oz_movie_file_mend(const char *path)
{
    int handle = open(path, O_RDWR | O_CLOEXEC);
    int64_t whole = handle < 0 ? 0 : count_whole(handle);
    bool good = handle >= 0 && (whole == 0 || ftruncate(handle, whole) == 0);
    OzStatus status =
        good ? OZ_OK
             : oz_status_fail(OZ_ERR_MOVIE, "movie: cannot read %s: %s", path, strerror(errno));
    if (handle >= 0) {
        close(handle);
    }
    return status;
}

/* What the mp4 reader and writer add to a file's own metadata. */
static bool is_formats_own(const char *key)
{
    static const char *const names[] = {"major_brand", "minor_version", "compatible_brands",
                                        "encoder"};
    bool found = false;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        found |= strcmp(key, names[i]) == 0;
    }
    return found;
}

/* The others, in their order. */
static OzStatus copy_metadata(AVDictionary **metadata, const AVDictionary *all)
{
    const AVDictionaryEntry *entry = NULL;
    while ((entry = av->av_dict_get(all, "", entry, AV_DICT_IGNORE_SUFFIX))) {
        if (!is_formats_own(entry->key)) {
            AV_PASS(av->av_dict_set(metadata, entry->key, entry->value, 0));
        }
    }
    return OZ_OK;
}

/* The head of the stream in the form in which the encoder gives it. */
static OzStatus replace_head(AVCodecParameters *parameters, const OzMovieCodec *codec)
{
    uint8_t *head = NULL;
    AV_PASS_NEW(head, av->av_mallocz((size_t)codec->head_bytes + AV_INPUT_BUFFER_PADDING_SIZE));
    memcpy(head, codec->head, (size_t)codec->head_bytes);
    av->av_freep(&parameters->extradata);
    parameters->extradata = head;
    parameters->extradata_size = (int)codec->head_bytes;
    return OZ_OK;
}

/* H.264 in an mp4 counts the bytes of each of a packet's parts before it; encoders put a mark there
 * (ITU-T H.264, annex B), which the writer of mp4 expects of all packets once it does of one. Both
 * are four bytes. */
static OzStatus mark_parts(AVPacket *packet, const char *source)
{
    static const uint8_t mark[4] = {0, 0, 0, 1};
    for (int64_t at = 0; at < packet->size;) {
        uint8_t *part = packet->data + at;
        int64_t left = packet->size - at - 4;
        int64_t bytes = left < 0 ? 0
                                 : (int64_t)part[0] << 24 | (int64_t)part[1] << 16 |
                                       (int64_t)part[2] << 8 | part[3];
        if (bytes <= 0 || bytes > left) {
            return oz_status_fail(OZ_ERR_MOVIE, "movie: %s is damaged", source);
        }
        memcpy(part, mark, sizeof mark);
        at += 4 + bytes;
    }
    return OZ_OK;
}

/* A movie that is read, and the packet in hand. */
typedef struct Source {
    const char *path;
    AVFormatContext *format;
    AVStream *stream;
    AVPacket *packet;
} Source;

static OzStatus fail_to_read(const Source *source, int code)
{
    char reason[AV_ERROR_MAX_STRING_SIZE] = "unknown reason";
    av->av_strerror(code, reason, sizeof reason);
    return oz_status_fail(OZ_ERR_MOVIE, "movie: cannot read %s: %s", source->path, reason);
}

static OzStatus open_source(Source *source)
{
    const AVInputFormat *mp4 = av->av_find_input_format("mp4");
    AV_PASS_NEW(source->packet, av->av_packet_alloc());
    int code = av->avformat_open_input(&source->format, source->path, mp4, NULL);
    if (code < 0 || source->format->nb_streams != 1) {
        return fail_to_read(source, code < 0 ? code : AVERROR_INVALIDDATA);
    }
    source->stream = source->format->streams[0];
    return OZ_OK;
}

static void close_source(Source *source)
{
    av->av_packet_free(&source->packet);
    av->avformat_close_input(&source->format);
}

static OzStatus fail_short(const OzMovieFile *file, const Source *source, int64_t count)
{
    return oz_status_fail(OZ_ERR_MOVIE, "movie: %s holds %lld frames; expected the first %lld",
                          source->path, (long long)file->packets, (long long)count);
}

/* Times in frames; where others will follow, one that is none of the first count fails. */
static OzStatus count_in_frames(const OzMovieFile *file, const Source *source, int64_t count)
{
    AVRational frame = {file->rate.den, file->rate.num};
    AVPacket *packet = source->packet;
    packet->pts = av->av_rescale_q(packet->pts, source->stream->time_base, frame);
    packet->dts = av->av_rescale_q(packet->dts, source->stream->time_base, frame);
    packet->duration = 1;
    packet->pos = -1;
    bool fits = !file->is_chain || (packet->pts >= 0 && packet->pts < count);
    return fits ? OZ_OK : fail_short(file, source, count);
}

static OzStatus copy_packets(OzMovieFile *file, Source *source, int64_t count)
{
    OzStatus status = OZ_OK;
    bool has_parts = file->is_chain && source->stream->codecpar->codec_id == AV_CODEC_ID_H264;
    while (file->packets < count) {
        int code = av->av_read_frame(source->format, source->packet);
        if (code < 0) {
            status =
                code == AVERROR_EOF ? fail_short(file, source, count) : fail_to_read(source, code);
            goto done;
        }
        OZ_TRY(count_in_frames(file, source, count));
        if (has_parts) {
            OZ_TRY(mark_parts(source->packet, source->path));
        }
        OZ_TRY(oz_movie_file_add(file, source->packet));
        av->av_packet_unref(source->packet);
    }
done:
    return status;
}

/* What the reader leaves to a decoder is known here. */
static OzStatus describe(AVCodecParameters **parameters, const Source *source,
                         const OzMovieCodec *codec, bool goes_on)
{
    AV_PASS_NEW(*parameters, av->avcodec_parameters_alloc());
    AV_PASS(av->avcodec_parameters_copy(*parameters, source->stream->codecpar));
    (*parameters)->width = codec->width;
    (*parameters)->height = codec->height;
    (*parameters)->bit_rate =
        0; /* for the writer to count: of a chain it is that of a few frames */
    if (goes_on) {
        OZ_PASS(replace_head(*parameters, codec));
    }
    return OZ_OK;
}

OzStatus oz_movie_file_copy(OzMovieFile *file, const char *path, const char *source, int64_t count,
                            const OzMovieCodec *codec, bool goes_on)
{
    OzStatus status = OZ_OK;
    Source from = {.path = source};
    AVCodecParameters *parameters = NULL;
    AVDictionary *metadata = NULL;
    *file = (OzMovieFile){0};
    OZ_TRY(open_source(&from));
    OZ_TRY(copy_metadata(&metadata, from.format->metadata));
    OZ_TRY(describe(&parameters, &from, codec, goes_on));
    OZ_TRY(oz_movie_file_create(file, path, goes_on, parameters, codec->rate, metadata));
    OZ_TRY(copy_packets(file, &from, count));
done:
    if (status != OZ_OK) {
        oz_movie_file_close(file, path);
    }
    av->av_dict_free(&metadata);
    av->avcodec_parameters_free(&parameters);
    close_source(&from);
    return status;
}
