/* tests/api/schema_check.h
 * Checks values against the schemas of the OpenAPI document: the part of JSON Schema 2020-12 that
 * the document uses. An unknown keyword fails the check, so that none is passed over. */
#ifndef AEROM_TESTS_API_SCHEMA_CHECK_H
#define AEROM_TESTS_API_SCHEMA_CHECK_H

#include <stdbool.h>

struct cJSON;

/* The node a "#/a/b" reference names, NULL when there is none. */
const struct cJSON *schema_node(const struct cJSON *document, const char *reference);
/* The schema itself, references followed. */
const struct cJSON *schema_resolve(const struct cJSON *document, const struct cJSON *schema);

/* Whether the value fits the schema; otherwise `why` says what does not, and where. */
bool schema_check(const struct cJSON *document, const struct cJSON *schema,
                  const struct cJSON *value, char why[256]);

#endif
