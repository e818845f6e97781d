/* api/case.h
 * A case document (contract, "A case"): JSON -> checked case_def, canonical text and identity.
 *
 * An api_case owns its stations, materials, local polars and networks; library entries are
 * borrowed, so the library must outlive it. Immutable after parsing. */
#ifndef AEROM_API_CASE_H
#define AEROM_API_CASE_H

#include "api/library.h"
#include "core/case_def.h"

struct api_case;
struct cJSON;

/* "simulation" "modes" "section" "static" "stability" "loop" "training". */
const char *case_kind_name(enum case_kind kind);
bool case_kind_parse(const char *name, enum case_kind *out);
/* "none" "network" "attached" "dynamic_stall". */
bool dynamic_type_parse(const char *name, enum dynamic_type *out);

/* Parses, fills defaults, checks. On failure *out is unchanged and *problems holds every problem
 * found (at most FAILURE_LIST_MAX), each with its JSON pointer prefixed by `prefix` ("" for a
 * single case, "/jobs/3" in a batch). */
MUST_CHECK enum status api_case_parse(const struct library *lib, const char *json, size_t size,
                                      const char *prefix, struct api_case **out,
                                      struct failure_list *problems);
/* The same from a tree that json_parse and json_check have passed (api/json.h). */
MUST_CHECK enum status api_case_from_tree(const struct library *lib, const struct cJSON *tree,
                                          const char *prefix, struct api_case **out,
                                          struct failure_list *problems);
void api_case_destroy(struct api_case *c);

const struct case_def *api_case_def(const struct api_case *c);
/* Canonical JSON: every default filled in, fixed key order, no white space, local materials, polars
 * and networks that are used included. Parsing it again gives the same case and the same hash. */
const char *api_case_canonical(const struct api_case *c);
/* The same text handed over to the caller, who frees it; the case has none from then on. */
char *api_case_take_canonical(struct api_case *c);
/* BLAKE2b-256, hexadecimal, over the canonical case without its name, the core version and the
 * content hashes of polar and network: equal hash = equal result. */
const char *api_case_hash(const struct api_case *c);

#endif
