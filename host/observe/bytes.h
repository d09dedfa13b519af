/* Values into and out of blocks of bytes, in the machine's own byte order. Each call moves *at on by the
 * bytes that it wrote or read. */
#pragma once

#include <stddef.h>
#include <stdint.h>
#include <string.h>

typedef unsigned char *OzBytes;

static inline void oz_bytes_pack(OzBytes *at, const void *value, size_t bytes)
{
    memcpy(*at, value, bytes);
    *at += bytes;
}

static inline void oz_bytes_unpack(OzBytes *at, void *value, size_t bytes)
{
    memcpy(value, *at, bytes);
    *at += bytes;
}

/* Doubles kept as floats. */
static inline void oz_bytes_pack_floats(OzBytes *at, const double *values, int64_t count)
{
    for (int64_t i = 0; i < count; i++) {
        float value = (float)values[i];
        oz_bytes_pack(at, &value, sizeof value);
    }
}

static inline void oz_bytes_unpack_floats(OzBytes *at, double *values, int64_t count)
{
    for (int64_t i = 0; i < count; i++) {
        float value;
        oz_bytes_unpack(at, &value, sizeof value);
        values[i] = (double)value;
    }
}
