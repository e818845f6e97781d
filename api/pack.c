#include "api/pack.h"

#include <stdlib.h>
#include <zstd.h>

struct packer {
    ZSTD_CCtx *context;
};

struct packer *packer_create(void)
{
    struct packer *p = calloc(1, sizeof *p);
    if (p != NULL) {
        p->context = ZSTD_createCCtx();
    }
    if (p != NULL && p->context == NULL) {
        free(p);
        p = NULL;
    }
    return p;
}

void packer_destroy(struct packer *p)
{
    if (p != NULL) {
        (void)ZSTD_freeCCtx(p->context);
        free(p);
    }
}

void *packer_text(struct packer *p, const char *text, size_t size, int level, size_t *packed_size)
{
    const size_t bound = ZSTD_compressBound(size);
    void *packed = malloc(bound);
    if (packed == NULL) {
        return NULL;
    }
    const size_t n = ZSTD_compressCCtx(p->context, packed, bound, text, size, level);
    if (ZSTD_isError(n)) {
        free(packed);
        return NULL;
    }
    *packed_size = n;
    return packed;
}

void *pack_text(const char *text, size_t size, int level, size_t *packed_size)
{
    struct packer *p = packer_create();
    void *packed = p != NULL ? packer_text(p, text, size, level, packed_size) : NULL;
    packer_destroy(p);
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
