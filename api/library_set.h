/* api/library_set.h
 * The entries behind a struct library, for the codecs. Inside api only. */
#ifndef AEROM_API_LIBRARY_SET_H
#define AEROM_API_LIBRARY_SET_H

#include "api/entry.h"
#include "api/library.h"

/* Borrowed; lives as long as the library. */
const struct entry_set *library_entries(const struct library *lib);

/* Copies what "name" or "name@version" refers to on the shelf into the set, under its plain name,
 * which goes to `name`. False when there is no such entry, or the set has one of that name. */
bool library_borrow(const struct library *lib, enum shelf_kind kind, const char *reference,
                    struct entry_set *into, char name[LIMIT_NAME]);

/* Name (borrowed), hash, head and whole text (malloc'ed, NULL when out of memory) of the first
 * entry of a set, as the shelf keeps them. */
const char *library_item(const struct entry_set *set, enum shelf_kind kind, char hash[LIMIT_HASH],
                         char **head, char **data);

/* "version" "built_in" "created" "job"; NULL for what is compiled in. */
void library_version_members(struct json_out *out, const struct shelf_entry *e);
/* Heads of all entries of a kind on the shelf, into a list already begun. */
enum service_status library_shelf_members(struct json_out *out, const struct library *lib,
                                          enum shelf_kind kind);

#endif
