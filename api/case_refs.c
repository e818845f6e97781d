/* Members of a case that define or refer to materials, polars and networks. What comes off the
 * shelf becomes a definition inside the case: a stored case needs nothing that can be deleted. */
#include "api/case_refs.h"
#include "api/case_fields.h"
#include "api/json.h"
#include "api/library_set.h"

#include <cjson/cJSON.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Names that could have been meant: those of the case first. */
enum { NAMES_MAX = 64 };
typedef int (*name_lister)(const struct entry_set *set, int n, const char **names);

static int material_names(const struct entry_set *set, int n, const char **names)
{
    for (int i = 0; i < set->n_material && n < NAMES_MAX; i++) {
        names[n++] = set->material[i].material.name;
    }
    return n;
}

static int polar_names(const struct entry_set *set, int n, const char **names)
{
    for (int i = 0; i < set->n_polar && n < NAMES_MAX; i++) {
        names[n++] = set->polar[i].def.name;
    }
    return n;
}

static int network_names(const struct entry_set *set, int n, const char **names)
{
    for (int i = 0; i < set->n_network && n < NAMES_MAX; i++) {
        names[n++] = set->network[i].def.name;
    }
    return n;
}

static void report_missing(struct reader *r, const struct api_case *c, const struct cJSON *json,
                           const char *what, name_lister list)
{
    const char *names[NAMES_MAX + 1] = {NULL};
    char expected[128];
    char detail[200];
    (void)list(library_entries(c->library), list(&c->local, 0, names), names);
    reader_join(names, sizeof expected, expected);
    reader_join(names, sizeof detail, detail);
    reader_problem(r, what, expected, json, "there is no such name; known are: %s",
                   detail[0] != '\0' ? detail : "none");
}

/* The text of a reference; NULL when it is none (reported). */
static const char *reference(struct reader *r, const struct cJSON *json)
{
    if (!cJSON_IsString(json)) {
        reader_problem(r, "wrong_type", "a name", json, "the value must be a name");
        return NULL;
    }
    return json->valuestring;
}

void case_read_ply_material(struct reader *r, const struct cJSON *json, void *base)
{
    struct api_case *c = r->context;
    const char *name = reference(r, json);
    if (name == NULL) {
        return;
    }
    const struct material_entry *e = entry_material(&c->local, name);
    if (e == NULL) {
        e = entry_material(library_entries(c->library), name);
    }
    char plain[LIMIT_NAME];
    if (e == NULL && library_borrow(c->library, SHELF_MATERIAL, name, &c->local, plain)) {
        e = entry_material(&c->local, plain);
    }
    if (e != NULL) {
        ((struct ply *)base)->material = e->material;
    } else {
        report_missing(r, c, json, "unknown_material", material_names);
    }
}

void case_write_ply_material(struct json_out *out, const void *base)
{
    json_string(out, ((const struct ply *)base)->material.name);
}

void case_read_polar(struct reader *r, const struct cJSON *json, void *base)
{
    struct api_case *c = base;
    const char *name = reference(r, json);
    if (name == NULL) {
        return;
    }
    const struct polar_entry *e = entry_polar(&c->local, name);
    if (e == NULL) {
        e = entry_polar(library_entries(c->library), name);
    }
    char plain[LIMIT_NAME];
    if (e == NULL && library_borrow(c->library, SHELF_POLAR, name, &c->local, plain)) {
        e = entry_polar(&c->local, plain);
    }
    if (e != NULL) {
        c->def.aero.polar = &e->def;
    } else {
        report_missing(r, c, json, "unknown_polar", polar_names);
    }
}

void case_write_polar(struct json_out *out, const void *base)
{
    json_string(out, ((const struct api_case *)base)->def.aero.polar->name);
}

void case_read_network(struct reader *r, const struct cJSON *json, void *base)
{
    struct api_case *c = base;
    const char *name = reference(r, json);
    if (name == NULL) {
        return;
    }
    const struct network_entry *e = entry_network(&c->local, name);
    if (e == NULL) {
        e = entry_network(library_entries(c->library), name);
    }
    char plain[LIMIT_NAME];
    if (e == NULL && library_borrow(c->library, SHELF_NETWORK, name, &c->local, plain)) {
        e = entry_network(&c->local, plain);
    }
    if (e != NULL) {
        c->def.aero.network = &e->def;
    } else {
        report_missing(r, c, json, "unknown_network", network_names);
    }
}

void case_write_network(struct json_out *out, const void *base)
{
    json_string(out, ((const struct api_case *)base)->def.aero.network->name);
}

void case_read_materials(struct reader *r, const struct cJSON *json, void *base)
{
    (void)entry_read_list(r, json, &((struct api_case *)base)->local, entry_read_material);
}

void case_read_polars(struct reader *r, const struct cJSON *json, void *base)
{
    (void)entry_read_list(r, json, &((struct api_case *)base)->local, entry_read_polar);
}

void case_read_networks(struct reader *r, const struct cJSON *json, void *base)
{
    (void)entry_read_list(r, json, &((struct api_case *)base)->local, entry_read_network);
}

const struct section_def *case_section(const struct api_case *c, int i)
{
    const struct beam_def *b = &c->def.beam;
    if (b->n_station > 0) {
        return i < b->n_station ? &b->station[i].section : NULL;
    }
    return i == 0 ? &b->section : NULL;
}

static bool layup_uses(const struct layup *l, const struct material *m)
{
    bool used = false;
    for (int i = 0; i < l->n_ply; i++) {
        used = used || strcmp(l->ply[i].material.name, m->name) == 0;
    }
    return used;
}

static bool uses_material(const struct api_case *c, const struct material *m)
{
    const struct section_def *s = NULL;
    bool used = false;
    for (int i = 0; (s = case_section(c, i)) != NULL; i++) {
        for (int l = 0; l < s->shape.n_layup; l++) {
            used = used || layup_uses(&s->shape.layup[l], m);
        }
    }
    return used;
}

bool case_has_no_own_material(const void *base)
{
    const struct api_case *c = base;
    for (int i = 0; i < c->local.n_material; i++) {
        if (uses_material(c, &c->local.material[i].material)) {
            return false;
        }
    }
    return true;
}

bool case_has_no_own_polar(const void *base)
{
    const struct api_case *c = base;
    const struct polar_def *used = c->def.aero.polar;
    return used == NULL || entry_polar(&c->local, used->name) == NULL;
}

bool case_has_no_own_network(const void *base)
{
    const struct api_case *c = base;
    const struct network_def *used = c->def.aero.network;
    return used == NULL || entry_network(&c->local, used->name) == NULL;
}

void case_write_materials(struct json_out *out, const void *base)
{
    const struct api_case *c = base;
    json_array_begin(out);
    for (int i = 0; i < c->local.n_material; i++) {
        if (uses_material(c, &c->local.material[i].material)) {
            material_write(out, &c->local.material[i].material);
        }
    }
    json_array_end(out);
}

void case_write_polars(struct json_out *out, const void *base)
{
    const struct api_case *c = base;
    json_array_begin(out);
    polar_write(out, entry_polar(&c->local, c->def.aero.polar->name));
    json_array_end(out);
}

void case_write_networks(struct json_out *out, const void *base)
{
    const struct api_case *c = base;
    json_array_begin(out);
    network_write(out, entry_network(&c->local, c->def.aero.network->name));
    json_array_end(out);
}
