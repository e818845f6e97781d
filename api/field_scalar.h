/* api/field_scalar.h
 * Reading of single values for api/field_read.c. Each reports what is wrong at the reader's place
 * and leaves its output unchanged then. No state; thread-safe. */
#ifndef AEROM_API_FIELD_SCALAR_H
#define AEROM_API_FIELD_SCALAR_H

#include "api/field.h"

/* Passes `fits` on; when false, reports that the value must be `what` ("a number"). */
bool field_expect(struct reader *r, bool fits, const char *what, const struct cJSON *got);

/* One number in SI, in its range. False when refused. */
bool field_read_number(struct reader *r, const struct field *f, const struct cJSON *json,
                       double *out);
void field_read_integer(struct reader *r, const struct field *f, const struct cJSON *json,
                        int *out);
/* Index of an enum's name, -1 when refused. */
int field_read_name(struct reader *r, const char *const *names, const struct cJSON *json);
/* A text of at most f->size bytes with its zero, not empty when required. */
void field_read_text(struct reader *r, const struct field *f, const struct cJSON *json, char *out);

#endif
