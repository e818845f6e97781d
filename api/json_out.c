#include "api/json_out.h"

#include "api/utf8.h"
#include "core/num.h"

#include <assert.h>
#include <limits.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool reserve(struct json_out *out, size_t more)
{
    if (out->failed || more > JSON_OUT_MAX - out->size) {
        out->failed = true;
        return false;
    }
    const size_t need = out->size + more + 1;
    if (need <= out->capacity) {
        return true;
    }
    size_t capacity = out->capacity > 0 ? out->capacity : 256;
    while (capacity < need) {
        capacity *= 2;
    }
    char *text = realloc(out->text, capacity);
    if (text == NULL) {
        out->failed = true;
        return false;
    }
    out->text = text;
    out->capacity = capacity;
    return true;
}

void json_out_bytes(struct json_out *out, const char *bytes, size_t size)
{
    assert(out != NULL);
    if (reserve(out, size)) {
        memcpy(out->text + out->size, bytes, size);
        out->size += size;
        out->text[out->size] = '\0';
    }
}

void json_out_text(struct json_out *out, const char *text)
{
    json_out_bytes(out, text, strlen(text));
}

/* Every value starts here: the comma in front, and one due before the next. */
static void value_begin(struct json_out *out)
{
    if (out->separate) {
        json_out_bytes(out, ",", 1);
    }
    out->separate = true;
}

static void open_bracket(struct json_out *out, const char *bracket)
{
    value_begin(out);
    json_out_bytes(out, bracket, 1);
    out->separate = false;
}

static void close_bracket(struct json_out *out, const char *bracket)
{
    json_out_bytes(out, bracket, 1);
    out->separate = true;
}

void json_object_begin(struct json_out *out)
{
    open_bracket(out, "{");
}

void json_object_end(struct json_out *out)
{
    close_bracket(out, "}");
}

void json_array_begin(struct json_out *out)
{
    open_bracket(out, "[");
}

void json_array_end(struct json_out *out)
{
    close_bracket(out, "]");
}

static void quote(struct json_out *out, const char *text)
{
    static const char hex[] = "0123456789abcdef";
    const size_t size = strlen(text);
    json_out_bytes(out, "\"", 1);
    for (size_t i = 0; i < size;) {
        const unsigned char c = (unsigned char)text[i];
        const size_t length = utf8_sequence(text + i, size - i);
        if (length == 0) {
            json_out_text(out, "\xef\xbf\xbd");
        } else if (c == '"' || c == '\\') {
            json_out_bytes(out, (const char[]){'\\', (char)c}, 2);
        } else if (c == '\n') {
            json_out_bytes(out, "\\n", 2);
        } else if (c < 0x20) {
            json_out_bytes(out, (const char[]){'\\', 'u', '0', '0', hex[c >> 4], hex[c & 15]}, 6);
        } else {
            json_out_bytes(out, text + i, length);
        }
        i += length > 0 ? length : 1;
    }
    json_out_bytes(out, "\"", 1);
}

void json_key(struct json_out *out, const char *key)
{
    value_begin(out);
    quote(out, key);
    json_out_bytes(out, ":", 1);
    out->separate = false;
}

void json_string(struct json_out *out, const char *text)
{
    value_begin(out);
    if (text == NULL) {
        json_out_text(out, "null");
    } else {
        quote(out, text);
    }
}

void json_number(struct json_out *out, double value)
{
    char text[NUMBER_TEXT_SIZE];
    value_begin(out);
    if (isfinite(value)) {
        const size_t length = number_text(value, text);
        json_out_bytes(out, text, length);
    } else {
        json_out_text(out, "null");
    }
}

void json_number_in_unit(struct json_out *out, double si, double unit)
{
    assert(unit > 0.0);
    const double near = si / unit;
    if (!isfinite(near)) {
        json_null(out);
        return;
    }
    /* The division is off by an ulp or two at most; one of the neighbours multiplies back. */
    enum { NEIGHBOURS = 5 };
    double candidate[NEIGHBOURS] = {near};
    candidate[1] = nextafter(near, INFINITY);
    candidate[2] = nextafter(near, -INFINITY);
    candidate[3] = nextafter(candidate[1], INFINITY);
    candidate[4] = nextafter(candidate[2], -INFINITY);
    double best = near;
    int fewest = INT_MAX;
    for (int i = 0; i < NEIGHBOURS; i++) {
        const bool same = isfinite(candidate[i]) && num_same_bits(candidate[i] * unit, si);
        const int digits = same ? number_digits(candidate[i]) : INT_MAX;
        if (digits < fewest) {
            fewest = digits;
            best = candidate[i];
        }
    }
    json_number(out, best);
}

void json_integer(struct json_out *out, long long value)
{
    char text[NUMBER_TEXT_SIZE];
    value_begin(out);
    const int length = snprintf(text, sizeof text, "%lld", value);
    json_out_bytes(out, text, (size_t)length);
}

void json_boolean(struct json_out *out, bool value)
{
    value_begin(out);
    json_out_text(out, value ? "true" : "false");
}

void json_null(struct json_out *out)
{
    json_string(out, NULL);
}

void json_raw(struct json_out *out, const char *json)
{
    value_begin(out);
    json_out_text(out, json != NULL ? json : "null");
}

void json_members(struct json_out *out, const char *text, size_t size)
{
    value_begin(out);
    json_out_bytes(out, text, size);
}

void json_key_string(struct json_out *out, const char *key, const char *text)
{
    json_key(out, key);
    json_string(out, text);
}

void json_key_number(struct json_out *out, const char *key, double value)
{
    json_key(out, key);
    json_number(out, value);
}

void json_key_integer(struct json_out *out, const char *key, long long value)
{
    json_key(out, key);
    json_integer(out, value);
}

void json_key_numbers(struct json_out *out, const char *key, int n, const double *value, int stride,
                      double scale)
{
    json_key(out, key);
    json_array_begin(out);
    for (int i = 0; i < n; i++) {
        json_number(out, value[(ptrdiff_t)i * stride] * scale);
    }
    json_array_end(out);
}

char *json_out_take(struct json_out *out, size_t *size)
{
    char *text = NULL;
    if (!out->failed && out->text != NULL) {
        text = out->text;
        if (size != NULL) {
            *size = out->size;
        }
        out->text = NULL;
    }
    json_out_done(out);
    return text;
}

void json_out_done(struct json_out *out)
{
    free(out->text);
    *out = (struct json_out){.failed = out->failed};
}
