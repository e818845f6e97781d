/* api/drive_fields.h
 * The members of a gust and of a prescribed motion as field tables. Inside api only. */
#ifndef AEROM_API_DRIVE_FIELDS_H
#define AEROM_API_DRIVE_FIELDS_H

#include "api/field.h"

/* Of struct drive_def: the motion of the root in pitch and in plunge. */
extern const char *const drive_type_names[];
extern const struct field *const pitch_variants[];
extern const struct field *const plunge_variants[];
void drive_choose(void *drive, int type);
void drive_finish(struct reader *r, const struct cJSON *json, void *drive);

/* Of struct gust_def. */
extern const char *const gust_type_names[];
extern const struct field *const gust_variants[];
void gust_choose(void *gust, int type);
void gust_finish(struct reader *r, const struct cJSON *json, void *gust);

#endif
