/* api/library.h
 * The library a case refers to by name: materials, polars, networks.
 *
 * Built once at start from the files compiled into the program, then immutable and shared by all
 * threads. Entries live as long as the library. */
#ifndef AEROM_API_LIBRARY_H
#define AEROM_API_LIBRARY_H

#include "core/aero/network.h"
#include "core/aero/polar.h"
#include "core/structure/material.h"

#include <stddef.h>

struct library;

/* Parses every embedded data file. A faulty file is reported in *fail with its path. */
MUST_CHECK enum status library_create_builtin(struct library **out, struct failure *fail);
void library_destroy(struct library *lib);

/* NULL when there is none of this name. */
const struct material *library_material(const struct library *lib, const char *name);
const struct polar_def *library_polar(const struct library *lib, const char *name);
const struct network_def *library_network(const struct library *lib, const char *name);

/* The lists and entries GET /v1/materials, /v1/polars, /v1/networks show, as malloc'ed JSON text.
 * `name` NULL: the list (without the tables of numbers); otherwise one whole entry, NULL when
 * unknown. */
char *library_materials_json(const struct library *lib, const char *name);
char *library_polars_json(const struct library *lib, const char *name);
char *library_networks_json(const struct library *lib, const char *name);

/* Path and text of a shipped example case ("cases/…json"), NULL past the last. */
const char *library_example_case(int index, const char **text, size_t *size);

#endif
