/* api/study_axes.h
 * What is varied in a study: checks, order of the cells, values of a cell. Inside api only. */
#ifndef AEROM_API_STUDY_AXES_H
#define AEROM_API_STUDY_AXES_H

#include "api/study_fields.h"

/* The member of the tree a pointer leads to; NULL when there is none (reported). */
struct cJSON *study_resolve(struct reader *r, struct cJSON *tree, const char *pointer);
/* Does a member decide anything of section, beam and modes? When in doubt it does. */
bool study_is_structural(const char *pointer);
/* The member of the document that lists the axes: "vary" "over" ... */
const char *study_axes_key(const struct study *s);

/* Pointers, ranges, zipped axes, number of cells; problems go to the reader's list. Sets the
 * dimensions. ST_NO_MEMORY or ST_OK. */
MUST_CHECK enum status study_axes_check(struct study *s, struct reader *r);

/* Tries each value alone in the case, then the corners; the identities of the cases tried are added
 * to `identity`. ST_NO_MEMORY or ST_OK. */
MUST_CHECK enum status study_axes_try(struct study *s, struct reader *r, struct json_out *identity);

/* Tries the ends of the field whose boundary is sought. ST_NO_MEMORY or ST_OK. */
MUST_CHECK enum status study_try_field(struct study *s, struct reader *r);

/* Sets value k of an axis in the tree; false when out of memory. */
bool study_axis_set(const struct study_axis *a, int k);

/* Sets the values of a cell in the tree; false when out of memory. */
bool study_axes_set(struct study *s, int cell);

#endif
