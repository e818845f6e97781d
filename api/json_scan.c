/* The iterative pre-scan: what it accepts, cJSON parses without surprise. */
#include "api/json.h"

#include "api/utf8.h"

#include <assert.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

/* An open array or object, and the entry being read. */
struct frame {
    bool object;
    bool has_key;
    int index;
    size_t key_at, key_size;
};

struct scan {
    const char *text;
    size_t size, at;
    int depth, values;
    struct frame frame[JSON_DEPTH_MAX];
    struct failure *fail;
};

/* JSON pointer of the value being read; keys as they stand in the text. */
static void scan_pointer(const struct scan *s, char *out, size_t size)
{
    size_t used = 0;
    out[0] = '\0';
    for (int i = 0; i < s->depth && used < size; i++) {
        const struct frame *f = &s->frame[i];
        int n = 0;
        if (!f->object) {
            n = snprintf(out + used, size - used, "/%d", f->index);
        } else if (f->has_key) {
            const int length = f->key_size < size ? (int)f->key_size : (int)size;
            n = snprintf(out + used, size - used, "/%.*s", length, s->text + f->key_at);
        }
        used += (size_t)n;
    }
}

static bool refuse(struct scan *s, const char *code, const char *expected, const char *detail)
{
    int line = 1;
    size_t start = 0;
    for (size_t i = 0; i < s->at && i < s->size; i++) {
        if (s->text[i] == '\n') {
            line++;
            start = i + 1;
        }
    }
    char pointer[sizeof s->fail->pointer];
    char got[16] = "end of text";
    scan_pointer(s, pointer, sizeof pointer);
    if (s->at < s->size) {
        const unsigned char c = (unsigned char)s->text[s->at];
        (void)snprintf(got, sizeof got, c > 0x20 && c < 0x7f ? "'%c'" : "byte 0x%02x", c);
    }
    failure_set(s->fail, ST_INVALID, pointer, code, expected, got, "%s at line %d, column %zu",
                detail, line, s->at - start + 1);
    return false;
}

static void skip_space(struct scan *s)
{
    while (s->at < s->size && s->text[s->at] != '\0' && strchr(" \t\n\r", s->text[s->at]) != NULL) {
        s->at++;
    }
}

/* The next character, or 0 at the end (a zero byte is no JSON either). */
static char peek(const struct scan *s)
{
    if (s->at >= s->size) {
        return '\0';
    }
    return s->text[s->at];
}

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

static bool scan_digits(struct scan *s)
{
    if (!is_digit(peek(s))) {
        return refuse(s, "bad_number", "a digit", "number is not of the JSON form");
    }
    while (is_digit(peek(s))) {
        s->at++;
    }
    return true;
}

static bool scan_number(struct scan *s)
{
    const size_t start = s->at;
    if (peek(s) == '-') {
        s->at++;
    }
    if (peek(s) == '0') {
        s->at++;
        if (is_digit(peek(s))) {
            return refuse(s, "bad_number", "no leading zero", "number is not of the JSON form");
        }
    } else if (!scan_digits(s)) {
        return false;
    }
    if (peek(s) == '.') {
        s->at++;
        if (!scan_digits(s)) {
            return false;
        }
    }
    if (peek(s) == 'e' || peek(s) == 'E') {
        s->at++;
        if (peek(s) == '+' || peek(s) == '-') {
            s->at++;
        }
        if (!scan_digits(s)) {
            return false;
        }
    }
    if (s->at - start > JSON_NUMBER_MAX) {
        return refuse(s, "bad_number", "at most 63 characters", "number is too long");
    }
    return true;
}

/* Four hexadecimal digits; -1 when they are not there. */
static int scan_hex4(struct scan *s)
{
    int value = 0;
    for (int i = 0; i < 4; i++) {
        static const char digits[] = "0123456789abcdefABCDEF";
        const char *found = peek(s) != '\0' ? strchr(digits, peek(s)) : NULL;
        if (found == NULL) {
            return -1;
        }
        const int digit = (int)(found - digits);
        value = value * 16 + (digit < 16 ? digit : digit - 6);
        s->at++;
    }
    return value;
}

static bool is_high_surrogate(int code)
{
    return code >= 0xd800 && code < 0xdc00;
}

static bool is_low_surrogate(int code)
{
    return code >= 0xdc00 && code < 0xe000;
}

static bool scan_escape(struct scan *s)
{
    s->at++; /* the backslash */
    const char c = peek(s);
    if (c != 'u') {
        if (c == '\0' || strchr("\"\\/bfnrt", c) == NULL) {
            return refuse(s, "bad_escape", "one of \"\\/bfnrtu", "unknown escape in a string");
        }
        s->at++;
        return true;
    }
    s->at++;
    const int code = scan_hex4(s);
    if (code < 0) {
        return refuse(s, "bad_escape", "four hexadecimal digits", "broken \\u escape");
    }
    if (code == 0) {
        return refuse(s, "bad_escape", "no zero character", "\\u0000 in a string");
    }
    if (is_high_surrogate(code)) {
        const bool pair = peek(s) == '\\' && s->at + 1 < s->size && s->text[s->at + 1] == 'u';
        s->at += pair ? 2 : 0;
        if (!pair || !is_low_surrogate(scan_hex4(s))) {
            return refuse(s, "bad_escape", "a surrogate pair", "lone surrogate in a string");
        }
    } else if (is_low_surrogate(code)) {
        return refuse(s, "bad_escape", "a surrogate pair", "lone surrogate in a string");
    }
    return true;
}

static bool scan_string(struct scan *s)
{
    s->at++; /* the opening quote */
    for (;;) {
        if (s->at >= s->size) {
            return refuse(s, "syntax", "\"", "string is not closed");
        }
        const unsigned char c = (unsigned char)s->text[s->at];
        if (c == '"') {
            s->at++;
            return true;
        }
        if (c < 0x20) {
            return refuse(s, "control_character", "an escape", "control character in a string");
        }
        if (c == '\\') {
            if (!scan_escape(s)) {
                return false;
            }
            continue;
        }
        const size_t length = utf8_sequence(s->text + s->at, s->size - s->at);
        if (length == 0) {
            return refuse(s, "bad_utf8", "UTF-8", "text is not UTF-8");
        }
        s->at += length;
    }
}

static bool scan_literal(struct scan *s)
{
    static const char *const literals[] = {"true", "false", "null"};
    for (size_t i = 0; i < sizeof literals / sizeof literals[0]; i++) {
        const size_t n = strlen(literals[i]);
        if (s->size - s->at >= n && memcmp(s->text + s->at, literals[i], n) == 0) {
            s->at += n;
            return true;
        }
    }
    return refuse(s, "syntax", "a value", "this is not JSON");
}

static bool scan_key(struct scan *s)
{
    struct frame *f = &s->frame[s->depth - 1];
    f->has_key = false;
    if (peek(s) != '"') {
        return refuse(s, "syntax", "a key in quotes", "this is not JSON");
    }
    const size_t start = s->at + 1;
    if (!scan_string(s)) {
        return false;
    }
    f->has_key = true;
    f->key_at = start;
    f->key_size = s->at - 1 - start;
    skip_space(s);
    if (peek(s) != ':') {
        return refuse(s, "syntax", "':'", "this is not JSON");
    }
    s->at++;
    return true;
}

/* Opens an array or object. *empty tells that it was closed at once. */
static bool scan_open(struct scan *s, bool *empty)
{
    if (s->depth == JSON_DEPTH_MAX) {
        return refuse(s, "too_deep", "at most 32 nested arrays and objects", "nested too deeply");
    }
    const bool object = peek(s) == '{';
    s->frame[s->depth++] = (struct frame){.object = object};
    s->at++;
    skip_space(s);
    *empty = peek(s) == (object ? '}' : ']');
    if (*empty) {
        s->at++;
        s->depth--;
        return true;
    }
    return !object || scan_key(s);
}

/* One value; arrays and objects only up to their first entry (*opened). */
static bool scan_value(struct scan *s, bool *opened)
{
    *opened = false;
    skip_space(s);
    if (++s->values > JSON_VALUES_MAX) {
        return refuse(s, "too_many_values", "at most 1000000 values", "text has too many values");
    }
    const char c = peek(s);
    if (c == '{' || c == '[') {
        bool empty = false;
        const bool ok = scan_open(s, &empty);
        *opened = ok && !empty;
        return ok;
    }
    if (c == '"') {
        return scan_string(s);
    }
    return c == '-' || is_digit(c) ? scan_number(s) : scan_literal(s);
}

/* What follows a complete value: commas and closing brackets, up to the next value (*more). */
static bool scan_after(struct scan *s, bool *more)
{
    *more = false;
    while (s->depth > 0) {
        struct frame *f = &s->frame[s->depth - 1];
        skip_space(s);
        const char c = peek(s);
        if (c == ',') {
            s->at++;
            f->index++;
            skip_space(s);
            *more = true;
            return !f->object || scan_key(s);
        }
        if (c != (f->object ? '}' : ']')) {
            return refuse(s, "syntax", f->object ? "',' or '}'" : "',' or ']'", "this is not JSON");
        }
        s->at++;
        s->depth--;
    }
    return true;
}

enum status json_scan(const char *text, size_t size, struct failure *fail)
{
    assert(text != NULL || size == 0);
    assert(fail != NULL);
    struct scan s = {.text = text, .size = size, .fail = fail};
    if (size >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0) {
        (void)refuse(&s, "byte_order_mark", "plain UTF-8", "byte order mark");
        return ST_INVALID;
    }
    bool more = true;
    while (more) {
        bool opened = false;
        if (!scan_value(&s, &opened)) {
            return ST_INVALID;
        }
        if (!opened && !scan_after(&s, &more)) {
            return ST_INVALID;
        }
    }
    skip_space(&s);
    if (s.at < s.size) {
        (void)refuse(&s, "trailing_text", "nothing after the value", "text after the JSON value");
        return ST_INVALID;
    }
    return ST_OK;
}
