/* api/entry.h
 * Materials, polars and networks as documents: the same reading and printing for the library's
 * files and for the definitions inside a case.
 *
 * An entry_set owns its entries. The addresses of entries hold once the set is complete: reading
 * another one may move them. */
#ifndef AEROM_API_ENTRY_H
#define AEROM_API_ENTRY_H

#include "api/json_out.h"
#include "api/reader.h"
#include "core/aero/network.h"
#include "core/aero/polar.h"
#include "core/structure/material.h"

#include <stdbool.h>

struct material_entry {
    struct material material;
    char *provenance; /* JSON text of the file it came from, NULL when there is none */
};

/* description and provenance say what the numbers are and do not count for the hash; both are JSON
 * text or NULL. */
struct polar_entry {
    struct polar_def def; /* hash filled in */
    char *description;
    char *provenance;
};

struct network_entry {
    struct network_def def; /* hash filled in */
    int activation;         /* index of the known activations: only tanh */
    char *description;
    char *provenance;
};

struct entry_set {
    int n_material, n_polar, n_network;
    struct material_entry *material;
    struct polar_entry *polar;
    struct network_entry *network;
};

enum { ENTRIES_MAX = 256 }; /* of one kind in one set */

/* Each reads one document into a new entry of the set and checks it; false when it has a problem.
 * json is what the reader points at. */
bool entry_read_material(struct reader *r, const struct cJSON *json, struct entry_set *set);
bool entry_read_polar(struct reader *r, const struct cJSON *json, struct entry_set *set);
bool entry_read_network(struct reader *r, const struct cJSON *json, struct entry_set *set);

typedef bool (*entry_reader)(struct reader *r, const struct cJSON *json, struct entry_set *set);
/* One entry from the text of a document into an own set. ST_INVALID with *problems filled. */
MUST_CHECK enum status entry_parse(const char *text, size_t size, entry_reader read_one,
                                   struct entry_set *set, struct failure_list *problems);
/* Reads an array of documents; false when one of them has a problem. */
bool entry_read_list(struct reader *r, const struct cJSON *json, struct entry_set *set,
                     entry_reader read_one);

/* NULL when there is none of this name. */
const struct material_entry *entry_material(const struct entry_set *set, const char *name);
const struct polar_entry *entry_polar(const struct entry_set *set, const char *name);
const struct network_entry *entry_network(const struct entry_set *set, const char *name);

/* The whole document, canonical; for material_write without the provenance of its file. */
void material_write(struct json_out *out, const struct material *m);
void polar_write(struct json_out *out, const struct polar_entry *p);
void network_write(struct json_out *out, const struct network_entry *n);
/* Members of the document into an object already begun. */
void material_write_members(struct json_out *out, const struct material *m);
void polar_write_members(struct json_out *out, const struct polar_entry *p);
void network_write_members(struct json_out *out, const struct network_entry *n);

/* "cl" "cm" "cd". */
const char *network_output_name(enum network_output output);

void entry_set_done(struct entry_set *set);

#endif
