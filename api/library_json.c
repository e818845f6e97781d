/* What GET /v1/materials, /v1/polars and /v1/networks show: what is compiled in and what is on the
 * shelf, in one form. */
#include "api/field.h"
#include "api/hash.h"
#include "api/library_set.h"
#include "api/text.h"

#include <assert.h>
#include <stddef.h>
#include <string.h>

static void write_axis(struct json_out *out, const char *key, int n, const double *x, double unit)
{
    json_key(out, key);
    json_object_begin(out);
    json_key(out, "from");
    json_number_in_unit(out, x[0], unit);
    json_key(out, "to");
    json_number_in_unit(out, x[n - 1], unit);
    json_key_integer(out, "count", n);
    json_object_end(out);
}

/* -- heads: what a list shows of an entry, and whole entries ------------------------------ */

static void material_head(struct json_out *out, const struct entry_set *set, int i)
{
    struct json_out text = {0};
    char hash[LIMIT_HASH] = "";
    material_write_members(out, &set->material[i].material);
    material_write(&text, &set->material[i].material);
    if (!text.failed) {
        hash_text(text.text, text.size, hash);
    }
    out->failed = out->failed || text.failed;
    json_out_done(&text);
    json_key_string(out, "hash", hash);
}

static void material_whole(struct json_out *out, const struct entry_set *set, int i)
{
    material_head(out, set, i);
    json_key(out, "provenance");
    json_raw(out, set->material[i].provenance);
}

static void polar_head(struct json_out *out, const struct entry_set *set, int i)
{
    const struct polar_entry *e = &set->polar[i];
    json_key_string(out, "name", e->def.name);
    json_key_string(out, "hash", e->def.hash);
    json_key(out, "description");
    json_raw(out, e->description);
    write_axis(out, "alpha_deg", e->def.n_alpha, e->def.alpha, FIELD_DEGREE);
    write_axis(out, "plunge_c", e->def.n_plunge, e->def.plunge, 1.0);
}

static void polar_whole(struct json_out *out, const struct entry_set *set, int i)
{
    polar_write_members(out, &set->polar[i]);
    json_key_string(out, "hash", set->polar[i].def.hash);
}

static void network_head(struct json_out *out, const struct entry_set *set, int i)
{
    const struct network_entry *e = &set->network[i];
    json_key_string(out, "name", e->def.name);
    json_key_string(out, "hash", e->def.hash);
    json_key(out, "description");
    json_raw(out, e->description);
    json_key(out, "inputs");
    json_array_begin(out);
    for (int k = 0; k < e->def.n_in; k++) {
        json_string(out, network_input_name(e->def.input[k]));
    }
    json_array_end(out);
    json_key(out, "outputs");
    json_array_begin(out);
    for (int k = 0; k < e->def.n_out; k++) {
        json_string(out, network_output_name(e->def.output[k]));
    }
    json_array_end(out);
    json_key_integer(out, "hidden", e->def.n_hidden);
}

static void network_whole(struct json_out *out, const struct entry_set *set, int i)
{
    network_write_members(out, &set->network[i]);
    json_key_string(out, "hash", set->network[i].def.hash);
}

/* -- what is the same of every kind ------------------------------------------------------- */

static int material_count(const struct entry_set *set)
{
    return set->n_material;
}

static int polar_count(const struct entry_set *set)
{
    return set->n_polar;
}

static int network_count(const struct entry_set *set)
{
    return set->n_network;
}

static const char *material_name(const struct entry_set *set, int i)
{
    return set->material[i].material.name;
}

static const char *polar_name(const struct entry_set *set, int i)
{
    return set->polar[i].def.name;
}

static const char *network_name(const struct entry_set *set, int i)
{
    return set->network[i].def.name;
}

static const struct {
    const char *list;
    int (*count)(const struct entry_set *set);
    const char *(*name)(const struct entry_set *set, int i);
    void (*head)(struct json_out *out, const struct entry_set *set, int i);
    void (*whole)(struct json_out *out, const struct entry_set *set, int i);
} kinds[] = {
    [SHELF_MATERIAL] = {"materials", material_count, material_name, material_head, material_whole},
    [SHELF_POLAR] = {"polars", polar_count, polar_name, polar_head, polar_whole},
    [SHELF_NETWORK] = {"networks", network_count, network_name, network_head, network_whole},
};

/* What is known of an entry beside its content; NULL for one that is compiled in. */
void library_version_members(struct json_out *out, const struct shelf_entry *e)
{
    char created[TEXT_TIME_SIZE] = "";
    if (e != NULL) {
        text_time(e->created_us, created);
    }
    json_key_integer(out, "version", e != NULL ? e->version : 1);
    json_key(out, "built_in");
    json_boolean(out, e == NULL);
    json_key_string(out, "created", e != NULL ? created : NULL);
    json_key_string(out, "job", e != NULL && e->job[0] != '\0' ? e->job : NULL);
}

enum service_status library_shelf_members(struct json_out *out, const struct library *lib,
                                          enum shelf_kind kind)
{
    const struct shelf *shelf = library_shelf(lib);
    struct shelf_entry *list = NULL;
    int n = 0;
    if (shelf == NULL) {
        return SERVICE_OK;
    }
    const enum service_status st = shelf->list(shelf->ctx, kind, &list, &n);
    for (int i = 0; st == SERVICE_OK && i < n; i++) {
        json_object_begin(out);
        json_members(out, list[i].head, strlen(list[i].head));
        library_version_members(out, &list[i]);
        json_object_end(out);
    }
    shelf_entries_done(list, n);
    return st;
}

enum service_status library_list_json(const struct library *lib, enum shelf_kind kind, char **json)
{
    const struct entry_set *set = library_entries(lib);
    struct json_out out = {0};
    assert(kind < SHELF_DATASET);
    json_object_begin(&out);
    json_key(&out, kinds[kind].list);
    json_array_begin(&out);
    for (int i = 0; i < kinds[kind].count(set); i++) {
        json_object_begin(&out);
        kinds[kind].head(&out, set, i);
        library_version_members(&out, NULL);
        json_object_end(&out);
    }
    const enum service_status st = library_shelf_members(&out, lib, kind);
    json_array_end(&out);
    json_object_end(&out);
    *json = json_out_take(&out, NULL);
    return st;
}

static int find(const struct entry_set *set, enum shelf_kind kind, const char *name)
{
    for (int i = 0; i < kinds[kind].count(set); i++) {
        if (strcmp(kinds[kind].name(set, i), name) == 0) {
            return i;
        }
    }
    return -1;
}

bool library_is_built_in(const struct library *lib, enum shelf_kind kind, const char *name)
{
    return find(library_entries(lib), kind, name) >= 0;
}

enum service_status library_entry_json(const struct library *lib, enum shelf_kind kind,
                                       const char *name, int version, char **json)
{
    const struct entry_set *set = library_entries(lib);
    const struct shelf *shelf = library_shelf(lib);
    struct json_out out = {0};
    const int i = version <= 1 ? find(set, kind, name) : -1;
    if (i >= 0) {
        json_object_begin(&out);
        kinds[kind].whole(&out, set, i);
        library_version_members(&out, NULL);
        json_object_end(&out);
        *json = json_out_take(&out, NULL);
        return SERVICE_OK;
    }
    struct shelf_entry e = {0};
    const enum service_status st =
        shelf != NULL ? shelf->get(shelf->ctx, kind, name, version, &e) : SERVICE_NOT_FOUND;
    if (st == SERVICE_OK) {
        json_members(&out, e.data, e.size - 1); /* without the last bracket */
        json_key_string(&out, "hash", e.hash);
        if (kind == SHELF_MATERIAL) {
            json_key_string(&out, "provenance", NULL);
        }
        library_version_members(&out, &e);
        json_object_end(&out);
        *json = json_out_take(&out, NULL);
        shelf_entry_done(&e);
    }
    return st;
}

const char *library_item(const struct entry_set *set, enum shelf_kind kind, char hash[LIMIT_HASH],
                         char **head, char **data)
{
    struct json_out short_out = {0}, long_out = {0};
    kinds[kind].head(&short_out, set, 0);
    if (kind == SHELF_MATERIAL) {
        struct json_out hashed = {0};
        material_write(&hashed, &set->material[0].material);
        if (!hashed.failed) {
            hash_text(hashed.text, hashed.size, hash);
        }
        long_out.failed = hashed.failed;
        json_out_done(&hashed);
        material_write(&long_out, &set->material[0].material);
    } else if (kind == SHELF_POLAR) {
        memcpy(hash, set->polar[0].def.hash, LIMIT_HASH);
        polar_write(&long_out, &set->polar[0]);
    } else {
        memcpy(hash, set->network[0].def.hash, LIMIT_HASH);
        network_write(&long_out, &set->network[0]);
    }
    *head = json_out_take(&short_out, NULL);
    *data = json_out_take(&long_out, NULL);
    return kinds[kind].name(set, 0);
}
