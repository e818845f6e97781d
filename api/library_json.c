/* What GET /v1/materials, /v1/polars and /v1/networks show. */
#include "api/field.h"
#include "api/library_set.h"

#include <stddef.h>

char *library_materials_json(const struct library *lib, const char *name)
{
    const struct entry_set *set = library_entries(lib);
    struct json_out out = {0};
    if (name != NULL) {
        const struct material_entry *e = entry_material(set, name);
        if (e == NULL) {
            return NULL;
        }
        json_object_begin(&out);
        material_write_members(&out, &e->material);
        json_key(&out, "provenance");
        json_raw(&out, e->provenance);
        json_object_end(&out);
        return json_out_take(&out, NULL);
    }
    json_object_begin(&out);
    json_key(&out, "materials");
    json_array_begin(&out);
    for (int i = 0; i < set->n_material; i++) {
        material_write(&out, &set->material[i].material);
    }
    json_array_end(&out);
    json_object_end(&out);
    return json_out_take(&out, NULL);
}

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

static void write_polar_head(struct json_out *out, const struct polar_entry *e)
{
    json_object_begin(out);
    json_key_string(out, "name", e->def.name);
    json_key_string(out, "hash", e->def.hash);
    json_key(out, "description");
    json_raw(out, e->description);
    write_axis(out, "alpha_deg", e->def.n_alpha, e->def.alpha, FIELD_DEGREE);
    write_axis(out, "plunge_c", e->def.n_plunge, e->def.plunge, 1.0);
    json_object_end(out);
}

char *library_polars_json(const struct library *lib, const char *name)
{
    const struct entry_set *set = library_entries(lib);
    struct json_out out = {0};
    if (name != NULL) {
        const struct polar_entry *e = entry_polar(set, name);
        if (e == NULL) {
            return NULL;
        }
        json_object_begin(&out);
        polar_write_members(&out, e);
        json_key_string(&out, "hash", e->def.hash);
        json_object_end(&out);
        return json_out_take(&out, NULL);
    }
    json_object_begin(&out);
    json_key(&out, "polars");
    json_array_begin(&out);
    for (int i = 0; i < set->n_polar; i++) {
        write_polar_head(&out, &set->polar[i]);
    }
    json_array_end(&out);
    json_object_end(&out);
    return json_out_take(&out, NULL);
}

static void write_network_head(struct json_out *out, const struct network_entry *e)
{
    json_object_begin(out);
    json_key_string(out, "name", e->def.name);
    json_key_string(out, "hash", e->def.hash);
    json_key(out, "description");
    json_raw(out, e->description);
    json_key(out, "inputs");
    json_array_begin(out);
    for (int i = 0; i < e->def.n_in; i++) {
        json_string(out, network_input_name(e->def.input[i]));
    }
    json_array_end(out);
    json_key(out, "outputs");
    json_array_begin(out);
    for (int i = 0; i < e->def.n_out; i++) {
        json_string(out, network_output_name(e->def.output[i]));
    }
    json_array_end(out);
    json_key_integer(out, "hidden", e->def.n_hidden);
    json_object_end(out);
}

char *library_networks_json(const struct library *lib, const char *name)
{
    const struct entry_set *set = library_entries(lib);
    struct json_out out = {0};
    if (name != NULL) {
        const struct network_entry *e = entry_network(set, name);
        if (e == NULL) {
            return NULL;
        }
        json_object_begin(&out);
        network_write_members(&out, e);
        json_key_string(&out, "hash", e->def.hash);
        json_object_end(&out);
        return json_out_take(&out, NULL);
    }
    json_object_begin(&out);
    json_key(&out, "networks");
    json_array_begin(&out);
    for (int i = 0; i < set->n_network; i++) {
        write_network_head(&out, &set->network[i]);
    }
    json_array_end(&out);
    json_object_end(&out);
    return json_out_take(&out, NULL);
}
