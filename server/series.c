#include "server/series.h"

#include <assert.h>
#include <string.h>
#include <xxhash.h>
#include <zstd.h>

_Static_assert(sizeof(double) == 8, "chunks hold IEEE doubles");
_Static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "chunks are stored little-endian");

enum { LEVEL = 1, BYTES_MAX = SERIES_CHUNK * 8 };

/* Second differences; the inverse adds them up again, both modulo 2^64. */
static void difference(uint64_t *bits, int n)
{
    uint64_t previous = 0, slope = 0;
    for (int i = 0; i < n; i++) {
        const uint64_t d = bits[i] - previous;
        previous = bits[i];
        bits[i] = d - slope;
        slope = d;
    }
}

static void accumulate(uint64_t *bits, int n)
{
    uint64_t previous = 0, slope = 0;
    for (int i = 0; i < n; i++) {
        slope += bits[i];
        previous += slope;
        bits[i] = previous;
    }
}

static void shuffle(const uint64_t *bits, int n, unsigned char *out)
{
    for (int b = 0; b < 8; b++) {
        for (int i = 0; i < n; i++) {
            *out++ = (unsigned char)(bits[i] >> (8 * b));
        }
    }
}

static void unshuffle(const unsigned char *in, int n, uint64_t *bits)
{
    memset(bits, 0, (size_t)n * sizeof *bits);
    for (int b = 0; b < 8; b++) {
        for (int i = 0; i < n; i++) {
            bits[i] |= (uint64_t)*in++ << (8 * b);
        }
    }
}

size_t series_bound(void)
{
    return ZSTD_compressBound(BYTES_MAX);
}

void series_encode(const double *value, int n, void *buffer, struct series_chunk *out)
{
    assert(n >= 1);
    assert(n <= SERIES_CHUNK);
    const size_t bytes = (size_t)n * sizeof *value;
    uint64_t bits[SERIES_CHUNK];
    unsigned char planes[BYTES_MAX];

    memcpy(bits, value, bytes);
    difference(bits, n);
    shuffle(bits, n, planes);
    size_t size = ZSTD_compress(buffer, series_bound(), planes, bytes, LEVEL);
    enum series_codec codec = SERIES_DELTA_ZSTD;
    if (ZSTD_isError(size) || size >= bytes) {
        memcpy(buffer, value, bytes);
        codec = SERIES_RAW;
        size = bytes;
    }
    *out = (struct series_chunk){.codec = codec,
                                 .n = n,
                                 .checksum = XXH3_64bits(value, bytes),
                                 .size = size,
                                 .data = buffer};
}

enum status series_decode(const struct series_chunk *chunk, double *value)
{
    if (chunk->n < 1 || chunk->n > SERIES_CHUNK) {
        return ST_CORRUPT;
    }
    const size_t bytes = (size_t)chunk->n * sizeof *value;
    if (chunk->codec == SERIES_RAW) {
        if (chunk->size != bytes) {
            return ST_CORRUPT;
        }
        memcpy(value, chunk->data, bytes);
    } else if (chunk->codec == SERIES_DELTA_ZSTD) {
        uint64_t bits[SERIES_CHUNK];
        unsigned char planes[BYTES_MAX];
        if (ZSTD_decompress(planes, sizeof planes, chunk->data, chunk->size) != bytes) {
            return ST_CORRUPT;
        }
        unshuffle(planes, chunk->n, bits);
        accumulate(bits, chunk->n);
        memcpy(value, bits, bytes);
    } else {
        return ST_CORRUPT;
    }
    return XXH3_64bits(value, bytes) == chunk->checksum ? ST_OK : ST_CORRUPT;
}
