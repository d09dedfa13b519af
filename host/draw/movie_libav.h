/* libav, opened at run time by the names of the versions that this program was compiled against, so
 * that a process that makes no movie never maps it. For the movie's files alone. */
#pragma once

#include "base/status.h"

#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/imgutils.h>
#include <libavutil/opt.h>

/* clang-format off */
/* Every function of libav that is called, by library; the table below and its filling walk these. */
#define OZ_AVUTIL_FUNCTIONS(F)                                                                     \
    F(av_d2q) F(av_dict_copy) F(av_dict_free) F(av_dict_get) F(av_dict_set) F(av_frame_alloc)      \
    F(av_frame_free) F(av_frame_get_buffer) F(av_frame_make_writable) F(av_freep)                  \
    F(av_log_format_line) F(av_log_set_callback) F(av_mallocz) F(av_rescale_q) F(av_strerror)
#define OZ_AVCODEC_FUNCTIONS(F)                                                                    \
    F(av_packet_alloc) F(av_packet_free) F(av_packet_rescale_ts) F(av_packet_unref)                \
    F(avcodec_alloc_context3) F(avcodec_find_encoder_by_name) F(avcodec_free_context)              \
    F(avcodec_open2) F(avcodec_parameters_alloc) F(avcodec_parameters_copy)                        \
    F(avcodec_parameters_free) F(avcodec_parameters_from_context) F(avcodec_receive_packet)        \
    F(avcodec_send_frame)
#define OZ_AVFORMAT_FUNCTIONS(F)                                                                   \
    F(av_find_input_format) F(av_read_frame) F(av_write_frame) F(av_write_trailer)                 \
    F(avformat_alloc_output_context2) F(avformat_close_input) F(avformat_free_context)             \
    F(avformat_new_stream) F(avformat_open_input) F(avformat_write_header)                         \
    F(avio_alloc_context) F(avio_closep) F(avio_context_free) F(avio_flush) F(avio_open)           \
    F(avio_seek)
/* clang-format on */

/* What the libraries export, the same for every movie of the process: a constant once loaded. */
typedef struct OzMovieLibav {
#define OZ_AV_MEMBER(function) __typeof__(function) *function;
    OZ_AVUTIL_FUNCTIONS(OZ_AV_MEMBER)
    OZ_AVCODEC_FUNCTIONS(OZ_AV_MEMBER)
    OZ_AVFORMAT_FUNCTIONS(OZ_AV_MEMBER)
#undef OZ_AV_MEMBER
} OzMovieLibav;

extern OzMovieLibav oz_movie_libav_table;

/* Fills the table, once a process whatever the thread. Fails with OZ_ERR_MOVIE, naming what is
 * missing. */
OzStatus oz_movie_libav_load(void);

/* OZ_OK unless the code is negative; else fails with OZ_ERR_MOVIE, with libav's reason for it. */
OzStatus oz_movie_libav_check(int code, const char *call, const char *file, int line);

static const OzMovieLibav *const av = &oz_movie_libav_table;

/* As OZ_TRY and OZ_PASS, for a call that returns its code. */
#define AV_TRY(call)  OZ_TRY(oz_movie_libav_check((call), #call, __FILE__, __LINE__))
#define AV_PASS(call) OZ_PASS(oz_movie_libav_check((call), #call, __FILE__, __LINE__))
/* For what returns a pointer, NULL for out of memory. */
#define AV_TRY_NEW(pointer, call)  AV_TRY(((pointer) = (call)) ? 0 : AVERROR(ENOMEM))
#define AV_PASS_NEW(pointer, call) AV_PASS(((pointer) = (call)) ? 0 : AVERROR(ENOMEM))
