/* api/pack.h
 * Texts as zstd frames. Thread-safe; a struct packer belongs to one thread at a time. */
#ifndef AEROM_API_PACK_H
#define AEROM_API_PACK_H

#include <stddef.h>

/* A malloc'ed frame of a text, by a level of zstd (1 is fast); NULL when out of memory. */
void *pack_text(const char *text, size_t size, int level, size_t *packed_size);

/* What packs many texts after each other: its tables, larger than most texts, are made once. */
struct packer;
/* NULL when out of memory. */
struct packer *packer_create(void);
void packer_destroy(struct packer *p);
/* As pack_text. */
void *packer_text(struct packer *p, const char *text, size_t size, int level, size_t *packed_size);

/* The malloc'ed text with a terminating zero; NULL when the frame is damaged, is not of a text of
 * this size, or memory ran out. */
char *unpack_text(const void *packed, size_t packed_size, size_t size);

#endif
