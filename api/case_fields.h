/* api/case_fields.h
 * The case document as field tables, and the struct they fill. Inside api only. */
#ifndef AEROM_API_CASE_FIELDS_H
#define AEROM_API_CASE_FIELDS_H

#include "api/case.h"
#include "api/entry.h"
#include "api/field.h"
#include "api/motion_fields.h"
#include "api/training_fields.h"

struct api_case {
    int schema_version;
    struct case_def def;
    struct station_def *station; /* (def.beam.n_station), owned; def.beam points here */
    struct entry_set local;      /* definitions inside the case */
    struct motion_entry motion;  /* kind loop; def.loop points here */
    struct training_entry training;
    const struct library *library;
    char *canonical;
    char hash[LIMIT_HASH];
};

/* Bits of `kinds`: one per enum case_kind, and one for what does not count for the identity. */
enum case_group {
    CASE_IN_SIMULATION = 1u << CASE_SIMULATION,
    CASE_IN_MODES = 1u << CASE_MODES,
    CASE_IN_SECTION = 1u << CASE_SECTION,
    CASE_IN_STATIC = 1u << CASE_STATIC,
    CASE_IN_STABILITY = 1u << CASE_STABILITY,
    CASE_IN_LOOP = 1u << CASE_LOOP,
    CASE_IN_TRAINING = 1u << CASE_TRAINING,
    CASE_WITH_BEAM = CASE_IN_SIMULATION | CASE_IN_MODES | CASE_IN_STATIC | CASE_IN_STABILITY,
    CASE_LABEL = 1u << 8,
    CASE_OF_NO_KIND = 1u << 9 /* only what every kind needs can be asked for */
};

extern const char *const case_kind_names[]; /* ends with NULL */
extern const char *const dynamic_names[];   /* of enum dynamic_type */
extern const struct field case_fields[];    /* of struct api_case; r->context is the case itself */

/* Section i of the beam: its only one, or those of its stations; NULL past the last. */
const struct section_def *case_section(const struct api_case *c, int i);

#endif
