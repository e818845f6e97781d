#include "api/library.h"

#include "api/embedded.h"
#include "api/json.h"
#include "api/library_set.h"

#include <assert.h>
#include <cjson/cJSON.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct library {
    struct entry_set set;
    const struct shelf *shelf;
};

static bool is_under(const char *path, const char *folder)
{
    return strncmp(path, folder, strlen(folder)) == 0;
}

/* The provenance of a file of materials is that of each of them. */
static void keep_provenance(struct reader *r, struct entry_set *set, int first,
                            const struct cJSON *note)
{
    for (int i = first; note != NULL && i < set->n_material; i++) {
        struct json_out out = {0};
        json_value(&out, note);
        set->material[i].provenance = json_out_take(&out, NULL);
        if (set->material[i].provenance == NULL) {
            reader_no_memory(r);
        }
    }
}

/* {"provenance"?: any, "materials": [...]} */
static void read_material_file(struct reader *r, const struct cJSON *json, struct entry_set *set)
{
    const int first = set->n_material;
    for (const cJSON *c = json->child; c != NULL; c = c->next) {
        const size_t mark = reader_enter_key(r, c->string != NULL ? c->string : "");
        if (c->string != NULL && strcmp(c->string, "materials") == 0) {
            (void)entry_read_list(r, c, set, entry_read_material);
        } else if (c->string == NULL || strcmp(c->string, "provenance") != 0) {
            reader_problem(r, "unknown_key", "\"provenance\", \"materials\"", c, "no such key");
        }
        reader_leave(r, mark);
    }
    keep_provenance(r, set, first, cJSON_GetObjectItemCaseSensitive(json, "provenance"));
}

static enum status read_file(struct entry_set *set, const struct embedded_file *file,
                             struct failure_list *problems)
{
    struct cJSON *tree = NULL;
    struct reader r;
    reader_init(&r, "", problems);
    const enum status st =
        json_parse(file->data, embedded_size(file), &tree, failure_add(problems));
    if (st != ST_OK) {
        return st;
    }
    problems->count = problems->total = 0; /* the item json_parse did not need */
    json_check(&r, tree);
    if (is_under(file->path, "materials/")) {
        read_material_file(&r, tree, set);
    } else if (is_under(file->path, "polars/")) {
        (void)entry_read_polar(&r, tree, set);
    } else if (is_under(file->path, "networks/")) {
        (void)entry_read_network(&r, tree, set);
    }
    json_free(tree);
    return problems->total > 0 ? ST_INVALID : ST_OK;
}

enum status library_create_builtin(struct library **out, struct failure *fail)
{
    assert(out != NULL && fail != NULL);
    enum status st = ST_NO_MEMORY;
    const char *path = "";
    struct library *lib = calloc(1, sizeof *lib);
    struct failure_list *problems = calloc(1, sizeof *problems);
    if (lib != NULL && problems != NULL) {
        st = ST_OK;
    }
    for (int i = 0; st == ST_OK && i < data_file_count; i++) {
        path = data_files[i].path;
        st = read_file(&lib->set, &data_files[i], problems);
    }
    if (st == ST_OK) {
        *out = lib;
        lib = NULL;
    } else {
        const struct failure *f = problems != NULL && problems->count > 0 ? problems->item : NULL;
        failure_set(fail, st, f != NULL ? f->pointer : "", f != NULL ? f->code : status_name(st),
                    f != NULL ? f->expected : NULL, f != NULL ? f->got : NULL,
                    "library file %s: %s: %.160s", path, f != NULL ? f->pointer : "",
                    f != NULL ? f->detail : status_text(st));
    }
    library_destroy(lib);
    free(problems);
    return st;
}

void library_destroy(struct library *lib)
{
    if (lib != NULL) {
        entry_set_done(&lib->set);
        free(lib);
    }
}

void library_attach(struct library *lib, const struct shelf *shelf)
{
    lib->shelf = shelf;
}

const struct shelf *library_shelf(const struct library *lib)
{
    return lib->shelf;
}

bool library_borrow(const struct library *lib, enum shelf_kind kind, const char *reference,
                    struct entry_set *into, char name[LIMIT_NAME])
{
    static const entry_reader readers[SHELF_KINDS] = {[SHELF_MATERIAL] = entry_read_material,
                                                      [SHELF_POLAR] = entry_read_polar,
                                                      [SHELF_NETWORK] = entry_read_network};
    int version = 0;
    struct shelf_entry e = {0};
    if (lib->shelf == NULL || !shelf_reference(reference, name, &version) ||
        lib->shelf->get(lib->shelf->ctx, kind, name, version, &e) != SERVICE_OK) {
        return false;
    }
    struct failure_list *problems = calloc(1, sizeof *problems);
    const bool read =
        problems != NULL && entry_parse(e.data, e.size, readers[kind], into, problems) == ST_OK;
    free(problems);
    shelf_entry_done(&e);
    return read;
}

const struct entry_set *library_entries(const struct library *lib)
{
    return &lib->set;
}

const struct material *library_material(const struct library *lib, const char *name)
{
    const struct material_entry *e = entry_material(&lib->set, name);
    return e != NULL ? &e->material : NULL;
}

const struct polar_def *library_polar(const struct library *lib, const char *name)
{
    const struct polar_entry *e = entry_polar(&lib->set, name);
    return e != NULL ? &e->def : NULL;
}

const struct network_def *library_network(const struct library *lib, const char *name)
{
    const struct network_entry *e = entry_network(&lib->set, name);
    return e != NULL ? &e->def : NULL;
}

const char *library_example_case(int index, const char **text, size_t *size)
{
    for (int i = 0; i < data_file_count; i++) {
        if (is_under(data_files[i].path, "cases/") && index-- == 0) {
            *text = data_files[i].data;
            *size = embedded_size(&data_files[i]);
            return data_files[i].path;
        }
    }
    return NULL;
}
