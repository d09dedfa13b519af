/* Values into and out of blocks of bytes, in the machine's own byte order. Each call moves *at on
 * by the bytes that it wrote or read. */
#pragma once

#include <stdbool.h>
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

/* The last bytes of a sealed block: FNV-1a (Fowler, Noll, Vo), 64 bits, of all before them. Any
 * single changed byte changes it. */
enum { OZ_BYTES_CHECKSUM = 8 };

static inline uint64_t oz_bytes_sum(const unsigned char *bytes, size_t length)
{
    uint64_t hash = 0xcbf29ce484222325u;
    for (size_t i = 0; i < length; i++) {
        hash = (hash ^ bytes[i]) * 0x100000001b3u;
    }
    return hash;
}

static inline void oz_bytes_seal(unsigned char *block, size_t bytes)
{
    uint64_t sum = oz_bytes_sum(block, bytes - OZ_BYTES_CHECKSUM);
    memcpy(block + bytes - OZ_BYTES_CHECKSUM, &sum, sizeof sum);
}

static inline bool oz_bytes_is_sealed(const unsigned char *block, size_t bytes)
{
#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION /* or a fuzzer would never get past this */
    return true;
#endif
    uint64_t sum = oz_bytes_sum(block, bytes - OZ_BYTES_CHECKSUM);
    return memcmp(block + bytes - OZ_BYTES_CHECKSUM, &sum, sizeof sum) == 0;
}
