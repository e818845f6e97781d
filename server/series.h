/* server/series.h
 * Lossless coding of recorded series in chunks of up to 4096 samples.
 *
 * Codec 1: the bit patterns as integers, second differences (modulo 2^64, so exact), bytes of equal
 * weight brought together, zstd level 1. Codec 0: the samples as they are, used whenever codec 1
 * does not make them smaller. NaN payloads, infinities and denormals come back bit for bit.
 * Little-endian machines only. Pure functions, safe from any thread. */
#ifndef AEROM_SERVER_SERIES_H
#define AEROM_SERVER_SERIES_H

#include "core/status.h"

#include <stddef.h>
#include <stdint.h>

enum { SERIES_CHUNK = 4096 };
enum series_codec { SERIES_RAW = 0, SERIES_DELTA_ZSTD = 1 };

struct series_chunk {
    enum series_codec codec;
    int n;             /* samples, 1..SERIES_CHUNK */
    uint64_t checksum; /* xxh3-64 of the samples, so it also proves the decoding */
    size_t size;       /* bytes of data */
    const void *data;  /* owned by whoever filled the chunk */
};

/* Largest encoded size of one chunk. */
size_t series_bound(void);

/* Encodes value[0..n) into `buffer` of series_bound() bytes; out->data points into it. */
void series_encode(const double *value, int n, void *buffer, struct series_chunk *out);

/* Decodes into value[0..chunk->n). ST_CORRUPT when codec, size or checksum do not fit; the
 * contents of value are then undefined. */
MUST_CHECK enum status series_decode(const struct series_chunk *chunk, double *value);

/* Number of chunks of a series of n samples. */
static inline int series_chunks(int n)
{
    return (n + SERIES_CHUNK - 1) / SERIES_CHUNK;
}

#endif
