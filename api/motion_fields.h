/* api/motion_fields.h
 * The "motion" of a case of kind loop as field tables, and the struct they fill. Inside api only.
 */
#ifndef AEROM_API_MOTION_FIELDS_H
#define AEROM_API_MOTION_FIELDS_H

#include "api/field.h"
#include "core/loop_def.h"

enum motion_type { MOTION_SINE, MOTION_TABLE, MOTION_TYPES };

/* What the document says, and the definition made of it. Owns its rows and the table. */
struct motion_entry {
    enum motion_type type;
    int n;                    /* samples of each row that is given */
    int n_row[MOTION_ROWS];   /* the same, 0 for a row that is not */
    double *row[MOTION_ROWS]; /* in the units of the document */
    struct loop_motion table; /* all rows, SI */
    struct loop_def def;      /* without polar and dynamic part */
};

extern const char *const motion_type_names[]; /* ends with NULL */
extern const struct field *const motion_variants[];

/* FIELD_VARIANT: part is a struct motion_entry, r->context the struct api_case. */
void motion_choose(void *part, int type);
void motion_finish(struct reader *r, const struct cJSON *json, void *part);
/* Accepts a zeroed struct. */
void motion_entry_done(struct motion_entry *m);

#endif
