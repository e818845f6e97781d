#include "api/hash.h"

#include <sodium.h>

enum { HASH_BYTES = 32 };
_Static_assert(2 * HASH_BYTES + 1 == LIMIT_HASH, "a hash fits its text");

void hash_text(const char *text, size_t size, char out[LIMIT_HASH])
{
    unsigned char digest[HASH_BYTES];
    (void)crypto_generichash(digest, sizeof digest, (const unsigned char *)text, size, NULL, 0);
    (void)sodium_bin2hex(out, LIMIT_HASH, digest, sizeof digest);
}
