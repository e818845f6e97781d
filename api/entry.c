#include "api/entry.h"

#include "api/entry_fields.h"
#include "api/hash.h"
#include "api/json.h"

#include <assert.h>
#include <cjson/cJSON.h>
#include <stdlib.h>
#include <string.h>

/* Room for one more entry of `size` bytes, zeroed; NULL when there is none (reported). */
static void *add(struct reader *r, void **array, int *n, size_t size)
{
    if (*n >= ENTRIES_MAX) {
        reader_problem(r, "too_many", "at most 256 entries", NULL, "there are too many entries");
        return NULL;
    }
    void *grown = realloc(*array, ((size_t)*n + 1) * size);
    if (grown == NULL) {
        reader_no_memory(r);
        return NULL;
    }
    *array = grown;
    void *entry = (char *)grown + (size_t)*n * size;
    memset(entry, 0, size);
    (*n)++;
    return entry;
}

static bool unique(struct reader *r, bool twin)
{
    if (twin) {
        const size_t mark = reader_enter_key(r, "name");
        reader_problem(r, "duplicate_name", "distinct names", NULL, "the name stands twice");
        reader_leave(r, mark);
    }
    return !twin;
}

/* Reads the members, all of them asked for whatever the kind of the case around. */
static bool read_members(struct reader *r, const struct field *fields, const struct cJSON *json,
                         void *base)
{
    const unsigned kind = r->kind;
    const int before = r->problems->total;
    r->kind = (unsigned)READER_ALL;
    field_read(r, fields, json, base);
    r->kind = kind;
    return r->problems->total == before;
}

/* Content hash of the members that are numbers the result depends on. */
static bool hash_table(struct reader *r, const struct field *fields, const void *base,
                       char hash[LIMIT_HASH])
{
    struct json_out out = {0};
    field_write(&out, fields, ENTRY_TABLE, base);
    const bool ok = !out.failed;
    if (ok) {
        hash_text(out.text, out.size, hash);
    } else {
        reader_no_memory(r);
    }
    json_out_done(&out);
    return ok;
}

bool entry_read_material(struct reader *r, const struct cJSON *json, struct entry_set *set)
{
    void *array = set->material;
    struct material_entry *e = add(r, &array, &set->n_material, sizeof *e);
    set->material = array;
    if (e == NULL || !read_members(r, material_fields, json, &e->material)) {
        return false;
    }
    const int before = r->problems->total;
    material_check(&e->material, r->pointer, r->problems);
    return unique(r, entry_material(set, e->material.name) != e) && r->problems->total == before;
}

bool entry_read_polar(struct reader *r, const struct cJSON *json, struct entry_set *set)
{
    void *array = set->polar;
    struct polar_entry *e = add(r, &array, &set->n_polar, sizeof *e);
    set->polar = array;
    if (e == NULL) {
        return false;
    }
    /* The default: one row, at plunge zero. */
    e->def.plunge = calloc(1, sizeof *e->def.plunge);
    e->def.n_plunge = e->def.plunge != NULL ? 1 : 0;
    e->def.stall = stall_def_default();
    const int before = r->problems->total;
    if (e->def.plunge == NULL) {
        reader_no_memory(r);
        return false;
    }
    if (!read_members(r, polar_fields, json, e)) {
        return false;
    }
    polar_def_check(&e->def, r->pointer, r->problems);
    return unique(r, entry_polar(set, e->def.name) != e) && r->problems->total == before &&
           hash_table(r, polar_fields, e, e->def.hash);
}

enum status entry_parse(const char *text, size_t size, entry_reader read_one, struct entry_set *set,
                        struct failure_list *problems)
{
    struct cJSON *tree = NULL;
    struct failure fail = {0};
    struct reader r;
    reader_init(&r, "", problems);
    const enum status st = json_parse(text, size, &tree, &fail);
    if (st != ST_OK) {
        *failure_add(problems) = fail;
        return st;
    }
    json_check(&r, tree);
    const bool read = problems->total == 0 && read_one(&r, tree, set);
    json_free(tree);
    if (read) {
        return ST_OK;
    }
    return reader_ran_out_of_memory(problems) ? ST_NO_MEMORY : ST_INVALID;
}

bool entry_read_network(struct reader *r, const struct cJSON *json, struct entry_set *set)
{
    void *array = set->network;
    struct network_entry *e = add(r, &array, &set->n_network, sizeof *e);
    set->network = array;
    const int before = r->problems->total;
    if (e == NULL || !read_members(r, network_fields, json, e)) {
        return false;
    }
    network_def_check(&e->def, r->pointer, r->problems);
    return unique(r, entry_network(set, e->def.name) != e) && r->problems->total == before &&
           hash_table(r, network_fields, e, e->def.hash);
}

bool entry_read_list(struct reader *r, const struct cJSON *json, struct entry_set *set,
                     entry_reader read_one)
{
    if (!cJSON_IsArray(json)) {
        reader_problem(r, "wrong_type", "an array", json, "the value must be an array");
        return false;
    }
    bool ok = true;
    int i = 0;
    for (const cJSON *c = json->child; c != NULL && i < ENTRIES_MAX + 1; c = c->next, i++) {
        const size_t mark = reader_enter_index(r, i);
        ok = read_one(r, c, set) && ok;
        reader_leave(r, mark);
    }
    return ok;
}

/* The first of a name counts; a second one has been refused. */
const struct material_entry *entry_material(const struct entry_set *set, const char *name)
{
    for (int i = 0; i < set->n_material; i++) {
        if (strcmp(set->material[i].material.name, name) == 0) {
            return &set->material[i];
        }
    }
    return NULL;
}

const struct polar_entry *entry_polar(const struct entry_set *set, const char *name)
{
    for (int i = 0; i < set->n_polar; i++) {
        if (strcmp(set->polar[i].def.name, name) == 0) {
            return &set->polar[i];
        }
    }
    return NULL;
}

const struct network_entry *entry_network(const struct entry_set *set, const char *name)
{
    for (int i = 0; i < set->n_network; i++) {
        if (strcmp(set->network[i].def.name, name) == 0) {
            return &set->network[i];
        }
    }
    return NULL;
}

void material_write_members(struct json_out *out, const struct material *m)
{
    field_write_members(out, material_fields, (unsigned)READER_ALL, m);
}

void polar_write_members(struct json_out *out, const struct polar_entry *p)
{
    const bool notes = p->description != NULL || p->provenance != NULL;
    field_write_members(out, polar_fields, ENTRY_NAME | ENTRY_TABLE | (notes ? ENTRY_NOTES : 0), p);
}

void network_write_members(struct json_out *out, const struct network_entry *n)
{
    const bool notes = n->description != NULL || n->provenance != NULL;
    field_write_members(out, network_fields, ENTRY_NAME | ENTRY_TABLE | (notes ? ENTRY_NOTES : 0),
                        n);
}

void material_write(struct json_out *out, const struct material *m)
{
    json_object_begin(out);
    material_write_members(out, m);
    json_object_end(out);
}

void polar_write(struct json_out *out, const struct polar_entry *p)
{
    json_object_begin(out);
    polar_write_members(out, p);
    json_object_end(out);
}

void network_write(struct json_out *out, const struct network_entry *n)
{
    json_object_begin(out);
    network_write_members(out, n);
    json_object_end(out);
}

void entry_set_done(struct entry_set *set)
{
    for (int i = 0; i < set->n_material; i++) {
        free(set->material[i].provenance);
    }
    for (int i = 0; i < set->n_polar; i++) {
        polar_def_done(&set->polar[i].def);
        free(set->polar[i].description);
        free(set->polar[i].provenance);
    }
    for (int i = 0; i < set->n_network; i++) {
        network_def_done(&set->network[i].def);
        free(set->network[i].description);
        free(set->network[i].provenance);
    }
    free(set->material);
    free(set->polar);
    free(set->network);
    *set = (struct entry_set){0};
}
