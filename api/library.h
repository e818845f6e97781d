/* api/library.h
 * The library a case refers to by name: materials, polars, networks.
 *
 * What is compiled into the program is read once at start, then immutable and shared by all
 * threads; these entries live as long as the library. What users added is on a shelf and is copied
 * out of it into whatever asks. */
#ifndef AEROM_API_LIBRARY_H
#define AEROM_API_LIBRARY_H

#include "api/shelf.h"
#include "core/aero/network.h"
#include "core/aero/polar.h"
#include "core/structure/material.h"

#include <stddef.h>

struct library;

/* Parses every embedded data file. A faulty file is reported in *fail with its path. */
MUST_CHECK enum status library_create_builtin(struct library **out, struct failure *fail);
void library_destroy(struct library *lib);

/* The shelf with the entries of users, borrowed; NULL, as at first, for none. Before any other
 * thread uses the library. */
void library_attach(struct library *lib, const struct shelf *shelf);
const struct shelf *library_shelf(const struct library *lib);

/* NULL when there is none of this name. */
const struct material *library_material(const struct library *lib, const char *name);
const struct polar_def *library_polar(const struct library *lib, const char *name);
const struct network_def *library_network(const struct library *lib, const char *name);

/* What GET /v1/materials, /v1/polars, /v1/networks show: the list (without the tables of numbers)
 * and one entry, version 0 the newest, as malloc'ed JSON text; NULL in *json when out of memory.
 * Not for datasets (api/dataset.h). */
enum service_status library_list_json(const struct library *lib, enum shelf_kind kind, char **json);
enum service_status library_entry_json(const struct library *lib, enum shelf_kind kind,
                                       const char *name, int version, char **json);
/* Whether an entry of this name is compiled in, which no user can replace. */
bool library_is_built_in(const struct library *lib, enum shelf_kind kind, const char *name);

/* Path and text of a shipped example case ("cases/…json"), NULL past the last. */
const char *library_example_case(int index, const char **text, size_t *size);

#endif
