/* api/json.h
 * Strict reading of JSON over cJSON, which by itself accepts too much.
 *
 * json_parse refuses what is not JSON (RFC 8259) or too large; json_check reports, with places,
 * what is JSON but not admissible in any document of the contract. Both are free of state. */
#ifndef AEROM_API_JSON_H
#define AEROM_API_JSON_H

#include "core/status.h"

#include <stddef.h>

struct cJSON;
struct json_out;
struct reader;

enum {
    JSON_DEPTH_MAX = 32,       /* nested arrays and objects */
    JSON_VALUES_MAX = 1000000, /* values of one text: bounds the memory of the tree */
    JSON_NUMBER_MAX = 63,      /* characters of one number: cJSON cuts longer ones */
    JSON_MEMBER_NAME_MAX = 63, /* characters of a name that json_parse_members finds */
    JSON_MEMBERS_MAX = 128     /* members of one object: bounds the search for duplicates */
};

/* One pass without recursion over the text: grammar, depth, UTF-8, control characters, form of
 * numbers, lone surrogates, \u0000, byte order mark, text after the value. On failure *fail has
 * the pointer to the value being read, a code, and line and column in the detail. */
MUST_CHECK enum status json_scan(const char *text, size_t size, struct failure *fail);

/* Scans, then builds the tree, freed with json_free. ST_INVALID: not JSON; ST_NO_MEMORY. */
MUST_CHECK enum status json_parse(const char *text, size_t size, struct cJSON **out,
                                  struct failure *fail);
void json_free(struct cJSON *tree);

/* An object with the named members of the object that the text is, those that are there: many times
 * faster than the tree of a text of which little is wanted. For texts of our own writers, names
 * without escapes: what lies beside the members is not checked. NULL: broken, or no memory. */
struct cJSON *json_parse_members(const char *text, size_t size, int n, const char *const *name);

/* Reports duplicate keys, objects with too many members, and numbers that are not finite. */
void json_check(struct reader *r, const struct cJSON *tree);

/* Prints a tree, numbers exactly. */
void json_value(struct json_out *out, const struct cJSON *value);

/* A short description of a value for the `got` of a problem, e.g. `"abc"`, `-1`, `an object`. */
void json_describe(const struct cJSON *value, size_t size, char *out);

#endif
