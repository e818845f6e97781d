/* api/case_refs.h
 * The field tables' own functions for definitions inside a case and references to them: the base is
 * a struct api_case (a struct ply for the material of a ply, whose case is r->context). */
#ifndef AEROM_API_CASE_REFS_H
#define AEROM_API_CASE_REFS_H

#include "api/json_out.h"
#include "api/reader.h"

#include <stdbool.h>

/* References: the name must be that of a definition of the case or of the library. */
void case_read_ply_material(struct reader *r, const struct cJSON *json, void *base);
void case_write_ply_material(struct json_out *out, const void *base);
void case_read_polar(struct reader *r, const struct cJSON *json, void *base);
void case_write_polar(struct json_out *out, const void *base);
void case_read_network(struct reader *r, const struct cJSON *json, void *base);
void case_write_network(struct json_out *out, const void *base);
/* true or false: take a network that was trained on another polar. */

/* Definitions; only those that are used are printed. */
void case_read_materials(struct reader *r, const struct cJSON *json, void *base);
void case_write_materials(struct json_out *out, const void *base);
bool case_has_no_own_material(const void *base);
void case_read_polars(struct reader *r, const struct cJSON *json, void *base);
void case_write_polars(struct json_out *out, const void *base);
bool case_has_no_own_polar(const void *base);
void case_read_networks(struct reader *r, const struct cJSON *json, void *base);
void case_write_networks(struct json_out *out, const void *base);
bool case_has_no_own_network(const void *base);

#endif
