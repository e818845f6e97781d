#include "api/text.h"

#include "api/hash.h"

#include <math.h>
#include <sodium.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <time.h>

static int hex_digit(char c)
{
    static const char digits[] = "0123456789abcdefABCDEF";
    const char *found = c != '\0' ? strchr(digits, c) : NULL;
    if (found == NULL) {
        return -1;
    }
    const int digit = (int)(found - digits);
    return digit < 16 ? digit : digit - 6;
}

bool text_percent_decode(const char *text, size_t n, size_t size, char *out)
{
    size_t used = 0;
    for (size_t i = 0; i < n; i++) {
        char c = text[i];
        if (c == '%') {
            const int high = n - i > 2 ? hex_digit(text[i + 1]) : -1;
            const int low = n - i > 2 ? hex_digit(text[i + 2]) : -1;
            if (high < 0 || low < 0 || high + low == 0) {
                return false;
            }
            c = (char)(high * 16 + low);
            i += 2;
        }
        if (used + 1 >= size) {
            return false;
        }
        out[used++] = c;
    }
    out[used] = '\0';
    return true;
}

bool text_percent_encode(const char *text, size_t size, char *out)
{
    static const char unreserved[] =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~";
    size_t used = 0;
    for (const char *c = text; *c != '\0'; c++) {
        if (used + 4 > size) {
            return false;
        }
        if (strchr(unreserved, *c) != NULL) {
            out[used++] = *c;
        } else {
            used += (size_t)snprintf(out + used, size - used, "%%%02X", (unsigned char)*c);
        }
    }
    if (used >= size) {
        return false;
    }
    out[used] = '\0';
    return true;
}

bool text_number(const char *text, double *out)
{
    char *end = NULL;
    if (text[0] == '\0' || strspn(text, "+-.0123456789eE") != strlen(text)) {
        return false; /* strtod would also take blanks, hexadecimal, inf and nan */
    }
    const double value = strtod(text, &end);
    if (*end != '\0' || !isfinite(value)) {
        return false;
    }
    *out = value;
    return true;
}

enum { CURSOR_CHECK = 6, CURSOR_BYTES = 36 + CURSOR_CHECK };

/* Not a secret: it only keeps altered or foreign tokens from being taken for a place. */
static void cursor_check(const char *id, unsigned char out[CURSOR_CHECK])
{
    char hash[LIMIT_HASH];
    hash_text(id, strlen(id), hash);
    memcpy(out, hash, CURSOR_CHECK);
}

void text_cursor_make(const char *id, char out[TEXT_CURSOR_SIZE])
{
    unsigned char raw[CURSOR_BYTES];
    const size_t n = strnlen(id, CURSOR_BYTES - CURSOR_CHECK);
    memcpy(raw, id, n);
    cursor_check(id, raw + n);
    (void)sodium_bin2base64(out, TEXT_CURSOR_SIZE, raw, n + CURSOR_CHECK,
                            sodium_base64_VARIANT_URLSAFE_NO_PADDING);
}

bool text_cursor_read(const char *cursor, size_t size, char *id)
{
    unsigned char raw[CURSOR_BYTES];
    unsigned char check[CURSOR_CHECK];
    size_t n = 0;
    if (sodium_base642bin(raw, sizeof raw, cursor, strlen(cursor), NULL, &n, NULL,
                          sodium_base64_VARIANT_URLSAFE_NO_PADDING) != 0 ||
        n <= CURSOR_CHECK || n - CURSOR_CHECK >= size) {
        return false;
    }
    n -= CURSOR_CHECK;
    memcpy(id, raw, n);
    id[n] = '\0';
    cursor_check(id, check);
    return memcmp(check, raw + n, CURSOR_CHECK) == 0;
}

void text_time(int64_t us, char out[TEXT_TIME_SIZE])
{
    const time_t seconds = (time_t)(us / 1000000);
    struct tm t = {0};
    (void)gmtime_r(&seconds, &t);
    const size_t n = strftime(out, TEXT_TIME_SIZE, "%Y-%m-%dT%H:%M:%S", &t);
    (void)snprintf(out + n, TEXT_TIME_SIZE - n, ".%06dZ", (int)(us % 1000000));
}

/* Length of the text up to one of the stop characters, blanks at its end left out. */
static size_t token_length(const char *text, const char *stops)
{
    size_t n = strcspn(text, stops);
    while (n > 0 && (text[n - 1] == ' ' || text[n - 1] == '\t')) {
        n--;
    }
    return n;
}

bool text_is_media_type(const char *content_type, const char *type)
{
    return content_type != NULL && token_length(content_type, ";") == strlen(type) &&
           strncasecmp(content_type, type, strlen(type)) == 0;
}

/* How closely a media range names a type: 3 exactly, 2 by its major type, 1 as any, 0 not at all.
 */
static int range_match(const char *range, size_t n, const char *type)
{
    const size_t major = strcspn(type, "/") + 1;
    if (n == strlen(type) && strncasecmp(range, type, n) == 0) {
        return 3;
    }
    if (n == major + 1 && strncasecmp(range, type, major) == 0 && range[major] == '*') {
        return 2;
    }
    return n == 3 && strncmp(range, "*/*", 3) == 0 ? 1 : 0;
}

int text_accept_weight(const char *accept, const char *type)
{
    int best = 0, weight = 0;
    if (accept == NULL) {
        return 1000;
    }
    for (const char *range = accept; *range != '\0';) {
        range += strspn(range, " \t,");
        const size_t whole = strcspn(range, ",");
        const int match = range_match(range, token_length(range, ";,"), type);
        const char *q = strstr(range, "q=");
        const bool weighed = q != NULL && q < range + whole;
        if (match > best) {
            best = match;
            weight = weighed ? (int)(strtod(q + 2, NULL) * 1000.0) : 1000;
        }
        range += whole;
    }
    return weight;
}

bool text_etag_matches(const char *if_none_match, const char *etag)
{
    if (if_none_match == NULL) {
        return false;
    }
    for (const char *tag = if_none_match; *tag != '\0';) {
        tag += strspn(tag, " \t,");
        const size_t n = token_length(tag, ",");
        const size_t weak =
            strncmp(tag, "W/", 2) == 0 ? 2 : 0; /* weak comparison, RFC 9110 13.1.2 */
        if ((n == 1 && *tag == '*') ||
            (n - weak == strlen(etag) && strncmp(tag + weak, etag, n - weak) == 0)) {
            return true;
        }
        tag += strcspn(tag, ",");
    }
    return false;
}
