#include "api/study.h"

#include "api/hash.h"
#include "api/json.h"
#include "api/study_axes.h"
#include "api/study_fields.h"

#include <assert.h>
#include <cjson/cJSON.h>
#include <stdlib.h>
#include <string.h>

/* Field tables read and print enums as int. */
_Static_assert(sizeof(enum study_type) == sizeof(int), "an enum is an int");

bool study_is_one(const struct cJSON *tree)
{
    const cJSON *kind = cJSON_GetObjectItemCaseSensitive(tree, "kind");
    return cJSON_IsString(kind) && strcmp(kind->valuestring, study_kind_names[0]) == 0;
}

void study_destroy(struct study *s)
{
    if (s == NULL) {
        return;
    }
    for (int i = 0; i < STUDY_AXES_MAX; i++) {
        struct study_axis *a = &s->axis[i];
        for (int k = 0; a->label != NULL && k < a->n; k++) {
            free(a->label[k]);
        }
        free(a->label);
        free(a->value);
        free(a->own_label);
    }
    json_free(s->tree);
    free(s->base);
    free(s->canonical);
    free(s);
}

/* Canonical text; and over it without the label, and what the cells have given to `identity`, the
 * hash. */
static enum status identify(struct study *s, struct json_out *identity)
{
    struct json_out text = {0};
    field_write(&text, study_fields, STUDY_BODY | STUDY_LABEL, s);
    s->canonical = json_out_take(&text, NULL);
    field_write(identity, study_fields, STUDY_BODY, s);
    json_string(identity, s->base_hash);
    json_string(identity, AEROM_CORE_VERSION);
    if (identity->failed || s->canonical == NULL) {
        return ST_NO_MEMORY;
    }
    hash_text(identity->text, identity->size, s->hash);
    return ST_OK;
}

/* The case as a tree, in which the pointers are looked up: with every default filled in. */
static enum status plant_case(struct study *s)
{
    struct failure fail;
    return json_parse(s->base, strlen(s->base), &s->tree, &fail);
}

static enum status build(struct study *s, struct reader *r, bool try_cells)
{
    struct json_out identity = {0};
    enum status st = plant_case(s);
    study_search_define(s);
    if (st == ST_OK) {
        st = study_search_axes(s) ? study_axes_check(s, r) : ST_NO_MEMORY;
    }
    if (st == ST_OK) {
        st = study_search_check(s, r);
    }
    if (st == ST_OK && r->problems->total == 0) {
        st = study_search_fill(s);
    }
    if (st == ST_OK && r->problems->total == 0 && try_cells) {
        st = study_axes_try(s, r, &identity);
    }
    if (st == ST_OK && r->problems->total > 0) {
        st = ST_INVALID;
    }
    if (st == ST_OK) {
        st = identify(s, &identity);
    }
    json_out_done(&identity);
    return st;
}

static enum status read_study(const struct library *lib, const struct cJSON *tree, bool try_cells,
                              struct study **out, struct failure_list *problems)
{
    struct reader r;
    reader_init(&r, "", problems);
    struct study *s = calloc(1, sizeof *s);
    if (s == NULL) {
        reader_no_memory(&r);
        return ST_NO_MEMORY;
    }
    const cJSON *type = cJSON_GetObjectItemCaseSensitive(tree, "type");
    const int index =
        cJSON_IsString(type) ? field_name_index(study_type_names, type->valuestring) : -1;
    s->library = lib;
    study_search_defaults(&s->search);
    r.kind = index >= 0 ? STUDY_BODY : STUDY_LABEL; /* without a type only what all need */
    r.context = s;
    field_read(&r, study_fields, tree, s);
    enum status st = ST_INVALID;
    if (s->base != NULL && index >= 0) {
        st = build(s, &r, try_cells);
    }
    if (st == ST_NO_MEMORY) {
        reader_no_memory(&r);
    }
    if (st == ST_OK) {
        *out = s;
    } else {
        study_destroy(s);
    }
    return st;
}

enum status study_from_tree(const struct library *lib, const struct cJSON *tree, struct study **out,
                            struct failure_list *problems)
{
    return read_study(lib, tree, true, out, problems);
}

static enum status from_text(const struct library *lib, const char *json, size_t size,
                             bool try_cells, struct study **out, struct failure_list *problems)
{
    struct cJSON *tree = NULL;
    struct failure fail;
    struct reader r;
    enum status st = json_parse(json, size, &tree, &fail);
    if (st != ST_OK) {
        *failure_add(problems) = fail;
        return st;
    }
    reader_init(&r, "", problems);
    json_check(&r, tree);
    st = problems->total > 0 ? ST_INVALID : read_study(lib, tree, try_cells, out, problems);
    json_free(tree);
    return st;
}

enum status study_parse(const struct library *lib, const char *json, size_t size,
                        struct study **out, struct failure_list *problems)
{
    return from_text(lib, json, size, true, out, problems);
}

enum status study_open(const struct library *lib, const char *canonical, struct study **out,
                       struct failure_list *problems)
{
    return from_text(lib, canonical, strlen(canonical), false, out, problems);
}

const char *study_name(const struct study *s)
{
    return s->name;
}

enum study_type study_type_of(const struct study *s)
{
    return (enum study_type)s->type;
}

enum case_kind study_case_kind(const struct study *s)
{
    return s->case_kind;
}

const char *study_canonical(const struct study *s)
{
    return s->canonical;
}

char *study_take_canonical(struct study *s)
{
    char *text = s->canonical;
    s->canonical = NULL;
    return text;
}

const char *study_hash(const struct study *s)
{
    return s->hash;
}

int study_cells(const struct study *s)
{
    return s->n_cell;
}

enum status study_case(struct study *s, int cell, struct api_case **out,
                       struct failure_list *problems)
{
    assert(cell >= 0);
    assert(cell < s->n_cell);
    if (!study_axes_set(s, cell)) {
        return ST_NO_MEMORY;
    }
    return api_case_from_tree(s->library, s->tree, "", out, problems);
}

const char *study_main_value(const struct study *s)
{
    return s->type == STUDY_OPTIMUM  ? "objective"
           : study_seeks_boundary(s) ? study_boundary_name
                                     : "verdict";
}

const char *study_field_pointer(const struct study *s)
{
    return s->type == STUDY_BOUNDARY ? s->search.field.pointer : NULL;
}

void study_map_axes(const struct study *s, struct study_map *out)
{
    out->n_dimension = s->n_dimension;
    memcpy(out->shape, s->shape, sizeof out->shape);
    out->n_axis = s->n_axis;
    for (int i = 0; i < s->n_axis; i++) {
        const struct study_axis *a = &s->axis[i];
        out->axis[i] = (struct study_axis_view){.pointer = a->pointer,
                                                .dimension = a->dimension,
                                                .n = a->n,
                                                .value = a->value,
                                                .label = (const char *const *)a->label};
    }
}

void study_point(struct json_out *out, const struct study *s, int cell)
{
    struct study_map m = {.n_cell = 0};
    study_map_axes(s, &m);
    json_key_integer(out, "cell", cell);
    json_key(out, "point");
    json_object_begin(out);
    study_map_point(out, &m, cell);
    json_object_end(out);
}
