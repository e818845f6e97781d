/* api/beam_fields.h
 * Beam and loads of the case document as field tables of struct api_case. Inside api only. */
#ifndef AEROM_API_BEAM_FIELDS_H
#define AEROM_API_BEAM_FIELDS_H

#include "api/field.h"

extern const struct field beam_fields[];
extern const struct field loads_fields[];

/* Exactly one of section and stations: `finish` of the beam. */
void beam_finish(struct reader *r, const struct cJSON *json, void *base);

#endif
