/* api/utf8.h
 * Validity of UTF-8, one sequence at a time. */
#ifndef AEROM_API_UTF8_H
#define AEROM_API_UTF8_H

#include <stddef.h>

/* Length of the well-formed sequence (RFC 3629: no overlong form, no surrogate, at most U+10FFFF)
 * the n > 0 bytes start with; 0 when they start with none. */
static inline size_t utf8_sequence(const char *text, size_t n)
{
    const unsigned char *s = (const unsigned char *)text;
    if (s[0] < 0x80) {
        return 1;
    }
    if (s[0] < 0xc2 || s[0] > 0xf4) {
        return 0;
    }
    const size_t length = s[0] < 0xe0 ? 2 : (s[0] < 0xf0 ? 3 : 4);
    if (n < length) {
        return 0;
    }
    /* Only the second byte has a narrower range, after four of the lead bytes. */
    const unsigned lo = s[0] == 0xe0 ? 0xa0 : (s[0] == 0xf0 ? 0x90 : 0x80);
    const unsigned hi = s[0] == 0xed ? 0x9f : (s[0] == 0xf4 ? 0x8f : 0xbf);
    if (s[1] < lo || s[1] > hi) {
        return 0;
    }
    for (size_t i = 2; i < length; i++) {
        if ((s[i] & 0xc0) != 0x80) {
            return 0;
        }
    }
    return length;
}

#endif
