/* api/training_fields.h
 * The "training" of a case as a field table, and the struct it fills. Inside api only. */
#ifndef AEROM_API_TRAINING_FIELDS_H
#define AEROM_API_TRAINING_FIELDS_H

#include "api/field.h"
#include "core/network/training.h"

enum { TRAINING_REFERENCE = LIMIT_NAME + 16 };

struct training_entry {
    char dataset[TRAINING_REFERENCE]; /* "name@version" */
    char dataset_hash[LIMIT_HASH];
    int seed;
    struct training_def def; /* polar: that of the case's aero */
};

extern const struct field training_fields[]; /* of struct api_case, which r->context is too */
void training_finish(struct reader *r, const struct cJSON *json, void *base);

#endif
