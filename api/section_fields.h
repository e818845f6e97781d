/* api/section_fields.h
 * A section of the case document as field tables, one for each type. Inside api only. */
#ifndef AEROM_API_SECTION_FIELDS_H
#define AEROM_API_SECTION_FIELDS_H

#include "api/field.h"

extern const char *const section_type_names[]; /* of enum section_type; ends with NULL */
/* Tables of struct section_def, by enum section_type. */
extern const struct field *const section_variants[];

/* Sets the defaults of a section of a type: `choose` of a FIELD_VARIANT. */
void section_choose(void *section, int type);
/* What a section says twice or not at all: `finish` of a FIELD_VARIANT. */
void section_finish(struct reader *r, const struct cJSON *json, void *section);

#endif
