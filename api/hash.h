/* api/hash.h
 * Content hashes: BLAKE2b-256 as lower-case hexadecimal. Thread-safe. */
#ifndef AEROM_API_HASH_H
#define AEROM_API_HASH_H

#include "core/limits.h"

#include <stddef.h>

void hash_text(const char *text, size_t size, char out[LIMIT_HASH]);

#endif
