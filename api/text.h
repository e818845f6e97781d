/* api/text.h
 * Small text codecs of HTTP: percent-encoding, numbers in queries, cursors, times, media types.
 * No state. */
#ifndef AEROM_API_TEXT_H
#define AEROM_API_TEXT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Decodes n bytes into a zero-terminated text; false when an escape is broken or is %00, or the
 * text does not fit. */
bool text_percent_decode(const char *text, size_t n, size_t size, char *out);
/* Encodes all but the unreserved characters of RFC 3986. False when it does not fit. */
bool text_percent_encode(const char *text, size_t size, char *out);

/* The whole text as a finite decimal number. */
bool text_number(const char *text, double *out);

enum { TEXT_CURSOR_SIZE = 72, TEXT_TIME_SIZE = 32 };
/* A job id as an opaque token that carries a check, and back; false when it is not such a token.
 * id has room for `size` bytes. */
void text_cursor_make(const char *id, char out[TEXT_CURSOR_SIZE]);
bool text_cursor_read(const char *cursor, size_t size, char *id);

/* Microseconds since 1970 UTC in RFC 3339, "2026-01-31T12:00:00.000001Z". */
void text_time(int64_t us, char out[TEXT_TIME_SIZE]);

/* Whether a Content-Type names the media type, parameters aside. */
bool text_is_media_type(const char *content_type, const char *type);
/* The weight an Accept header gives to a media type "type/subtype", 0..1000; NULL accepts all. */
int text_accept_weight(const char *accept, const char *type);
/* Whether an If-None-Match header names the entity tag (with its quotes), or any. */
bool text_etag_matches(const char *if_none_match, const char *etag);

#endif
