#include "api/pack.h"

#include <stdlib.h>
#include <zstd.h>

void *pack_text(const char *text, size_t size, int level, size_t *packed_size)
{
    const size_t bound = ZSTD_compressBound(size);
    void *packed = malloc(bound);
    if (packed == NULL) {
        return NULL;
    }
    const size_t n = ZSTD_compress(packed, bound, text, size, level);
    if (ZSTD_isError(n)) {
        free(packed);
        return NULL;
    }
    *packed_size = n;
    return packed;
}

char *unpack_text(const void *packed, size_t packed_size, size_t size)
{
    char *text = malloc(size + 1);
    if (text == NULL) {
        return NULL;
    }
    const size_t n = ZSTD_decompress(text, size, packed, packed_size);
    if (ZSTD_isError(n) || n != size) {
        free(text);
        return NULL;
    }
    text[size] = '\0';
    return text;
}
