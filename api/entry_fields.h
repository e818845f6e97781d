/* api/entry_fields.h
 * The field tables of materials, polars and networks. */
#ifndef AEROM_API_ENTRY_FIELDS_H
#define AEROM_API_ENTRY_FIELDS_H

#include "api/field.h"

/* Groups of members of a polar or network document. */
enum entry_group {
    ENTRY_NAME = 1,
    ENTRY_NOTES = 2, /* description, provenance */
    ENTRY_TABLE = 4  /* what a result depends on: the content hash covers these */
};

extern const struct field material_fields[];           /* of struct material */
extern const struct field polar_fields[];              /* of struct polar_entry */
extern const struct field network_fields[];            /* of struct network_entry */
extern const struct field network_oscillator_fields[]; /* of struct network_oscillator */
/* Of an element of them, before it is read: what is missing is named once, not its zero as well. */
void network_oscillator_start(const struct reader *r, void *element);

/* By the enums of core; they end with NULL. */
extern const char *const network_input_names[];
extern const char *const network_output_names[];
extern const char *const network_base_names[];

#endif
