#include "server/id.h"

#include <ctype.h>
#include <sodium.h>
#include <stdio.h>
#include <string.h>

enum { COUNTER_BITS = 12 };

void id_next(struct id_generator *g, int64_t now_us, char out[JOB_ID_SIZE])
{
    const uint64_t now = ((uint64_t)now_us / 1000) << COUNTER_BITS;
    g->last = now > g->last ? now : g->last + 1;

    const uint64_t ms = g->last >> COUNTER_BITS;
    const unsigned counter = (unsigned)(g->last & ((1U << COUNTER_BITS) - 1));
    uint64_t random = 0;
    randombytes_buf(&random, sizeof random);
    const unsigned variant = 0x8000U | ((unsigned)(random >> 48) & 0x3fffU);
    (void)snprintf(out, JOB_ID_SIZE, "%08x-%04x-7%03x-%04x-%012llx", (unsigned)(ms >> 16),
                   (unsigned)(ms & 0xffff), counter, variant,
                   (unsigned long long)(random & 0xffffffffffffULL));
}

bool id_continue(struct id_generator *g, const char *id)
{
    if (strlen(id) != JOB_ID_SIZE - 1 || id[14] != '7') {
        return false;
    }
    uint64_t value = 0;
    for (int i = 0; i < 18; i++) {
        if (i == 8 || i == 13 || i == 14) {
            continue;
        }
        if (!isxdigit((unsigned char)id[i])) {
            return false;
        }
        const int c = tolower((unsigned char)id[i]);
        value = value << 4 | (uint64_t)(c <= '9' ? c - '0' : c - 'a' + 10);
    }
    if (value > g->last) {
        g->last = value;
    }
    return true;
}
