/* api/json_out.h
 * Text under construction, and the only place that prints JSON: strings, numbers, punctuation.
 *
 * A json_out owns its text. When memory runs out, or the text would grow past JSON_OUT_MAX, it is
 * marked failed and every later call does nothing: ask once, with json_out_take. */
#ifndef AEROM_API_JSON_OUT_H
#define AEROM_API_JSON_OUT_H

#include "api/number_text.h"

#include <stdbool.h>
#include <stddef.h>

enum { JSON_OUT_MAX = 1 << 29 };

struct json_out {
    char *text; /* zero-terminated once there is any */
    size_t size, capacity;
    bool separate; /* the next value or key is preceded by a comma */
    bool failed;
};

/* Raw text. */
void json_out_bytes(struct json_out *out, const char *bytes, size_t size);
void json_out_text(struct json_out *out, const char *text);

/* Commas are set by the writer: inside an array call values one after the other, inside an object
 * json_key before each value. */
void json_object_begin(struct json_out *out);
void json_object_end(struct json_out *out);
void json_array_begin(struct json_out *out);
void json_array_end(struct json_out *out);
void json_key(struct json_out *out, const char *key);
/* NULL prints null. Bytes that are not UTF-8 become U+FFFD. */
void json_string(struct json_out *out, const char *text);
/* The text that reads back bit-equal; null when the number is not finite. */
void json_number(struct json_out *out, double value);
void json_integer(struct json_out *out, long long value);
void json_boolean(struct json_out *out, bool value);
void json_null(struct json_out *out);
/* A value that already is JSON text; NULL prints null. */
void json_raw(struct json_out *out, const char *json);
/* Members of an object that already are JSON text. */
void json_members(struct json_out *out, const char *text, size_t size);

/* Key and value in one call. */
void json_key_string(struct json_out *out, const char *key, const char *text);
void json_key_number(struct json_out *out, const char *key, double value);
void json_key_integer(struct json_out *out, const char *key, long long value);
/* Key and an array of n numbers, each times `scale`; a stride of 1 reads neighbours. */
void json_key_numbers(struct json_out *out, const char *key, int n, const double *value, int stride,
                      double scale);

/* Number of a document whose unit is `unit` in SI: the shortest text t with t * unit == si to the
 * bit, so that a value survives reading and printing in both directions. */
void json_number_in_unit(struct json_out *out, double si, double unit);

/* Hands the text over (malloc'ed) and empties the writer; NULL when it failed. */
char *json_out_take(struct json_out *out, size_t *size);
void json_out_done(struct json_out *out);

#endif
