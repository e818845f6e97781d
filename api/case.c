#include "api/case.h"

#include "api/case_fields.h"
#include "api/hash.h"
#include "api/json.h"
#include "core/coupling/model.h"

#include <assert.h>
#include <cjson/cJSON.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Field tables read and print enums as int. */
_Static_assert(sizeof(enum case_kind) == sizeof(int), "an enum is an int");

const char *case_kind_name(enum case_kind kind)
{
    assert((unsigned)kind < CASE_KIND_COUNT);
    return case_kind_names[kind];
}

bool case_kind_parse(const char *name, enum case_kind *out)
{
    const int index = field_name_index(case_kind_names, name);
    if (index >= 0) {
        *out = (enum case_kind)index;
    }
    return index >= 0;
}

bool dynamic_type_parse(const char *name, enum dynamic_type *out)
{
    const int index = field_name_index(dynamic_names, name);
    if (index >= 0) {
        *out = (enum dynamic_type)index;
    }
    return index >= 0;
}

/* The bit of the document's kind, which decides what is required. */
static unsigned kind_of(const struct cJSON *tree)
{
    const cJSON *kind = cJSON_GetObjectItemCaseSensitive(tree, "kind");
    enum case_kind value = CASE_SIMULATION;
    if (!cJSON_IsString(kind) || !case_kind_parse(kind->valuestring, &value)) {
        return CASE_OF_NO_KIND;
    }
    return 1u << value;
}

/* Whether one pointer is the other or lies under it. */
static bool is_within(const char *inner, const char *outer)
{
    const size_t n = strlen(outer);
    return strncmp(inner, outer, n) == 0 && (inner[n] == '\0' || inner[n] == '/');
}

/* Whether a finding of the core only follows from a problem that is known. */
static bool follows(const char *found, const char *known)
{
    /* What was not read because of a problem beside it. */
    static const struct {
        const char *known, *found;
    } beside[] = {{"/type", "/"}, {"/beam/stations", "/beam/section"}};
    const size_t n = strlen(known);
    for (size_t i = 0; i < sizeof beside / sizeof beside[0]; i++) {
        const size_t end = strlen(beside[i].known), parent = n > end ? n - end : 0;
        if (n >= end && strcmp(known + parent, beside[i].known) == 0 &&
            strncmp(found, known, parent) == 0 &&
            strncmp(found + parent, beside[i].found, strlen(beside[i].found)) == 0) {
            return true;
        }
    }
    return is_within(found, known) || is_within(known, found);
}

/* Adds what the core finds, except about members that are already reported: their value is only a
 * default there. */
static enum status check_physics(const struct case_def *def, const char *prefix,
                                 struct failure_list *problems)
{
    struct failure_list *found = malloc(sizeof *found);
    if (found == NULL) {
        return ST_NO_MEMORY;
    }
    found->count = 0;
    found->total = 0;
    case_def_check(def, found);
    const int last = problems->count;
    for (int i = 0; i < found->count; i++) {
        const struct failure *f = &found->item[i];
        char pointer[2 * sizeof f->pointer];
        (void)snprintf(pointer, sizeof pointer, "%s%s", prefix, f->pointer);
        bool known = false;
        for (int j = 0; j < last; j++) {
            known = known || follows(pointer, problems->item[j].pointer);
        }
        if (!known) {
            failure_set(failure_add(problems), f->status, pointer, f->code, f->expected, f->got,
                        "%s", f->detail);
        }
    }
    free(found);
    return ST_OK;
}

/* A trial build, once everything else is in order: sections that cannot carry load are refused
 * before any work is queued. */
static enum status try_sections(const struct case_def *def, const char *prefix,
                                struct failure_list *problems)
{
    struct failure_list *found = calloc(1, sizeof *found);
    if (found == NULL) {
        return ST_NO_MEMORY;
    }
    const enum status st = model_try_sections(&def->beam, found);
    for (int i = 0; i < found->count; i++) {
        const struct failure *f = &found->item[i];
        char pointer[2 * sizeof f->pointer];
        (void)snprintf(pointer, sizeof pointer, "%s%s", prefix, f->pointer);
        failure_set(failure_add(problems), ST_INVALID, pointer, f->code, f->expected, f->got, "%s",
                    f->detail);
    }
    free(found);
    return st;
}

/* Properties of every ply, in order: the canonical text only has the names of library materials. */
static void write_materials(struct json_out *out, const struct api_case *c)
{
    const struct section_def *s = NULL;
    for (int i = 0; (s = case_section(c, i)) != NULL; i++) {
        for (int l = 0; l < s->shape.n_layup; l++) {
            for (int k = 0; k < s->shape.layup[l].n_ply; k++) {
                material_write(out, &s->shape.layup[l].ply[k].material);
            }
        }
    }
}

/* Canonical text, and over it, without the label, the identity. */
static enum status identify(struct api_case *c)
{
    const unsigned kind = 1u << c->def.kind;
    struct json_out text = {0};
    field_write(&text, case_fields, kind | CASE_LABEL, c);
    c->canonical = json_out_take(&text, NULL);

    struct json_out identity = {0};
    field_write(&identity, case_fields, kind, c);
    json_string(&identity, AEROM_CORE_VERSION);
    write_materials(&identity, c);
    json_string(&identity, case_def_has_polar(&c->def) ? c->def.aero.polar->hash : NULL);
    json_string(&identity, c->def.kind == CASE_TRAINING ? c->training.dataset_hash : NULL);
    const bool moves = case_kind_is_dynamic(c->def.kind);
    json_string(&identity, moves && c->def.aero.network != NULL ? c->def.aero.network->hash : NULL);
    const bool ok = !identity.failed && c->canonical != NULL;
    if (ok) {
        hash_text(identity.text, identity.size, c->hash);
    }
    json_out_done(&identity);
    return ok ? ST_OK : ST_NO_MEMORY;
}

static enum status no_memory(const char *prefix, struct failure_list *problems)
{
    failure_set(failure_add(problems), ST_NO_MEMORY, prefix, "no_memory", NULL, NULL, "%s",
                status_text(ST_NO_MEMORY));
    return ST_NO_MEMORY;
}

enum status api_case_from_tree(const struct library *lib, const struct cJSON *tree,
                               const char *prefix, struct api_case **out,
                               struct failure_list *problems)
{
    assert(lib != NULL && out != NULL && problems != NULL);
    struct reader r;
    const int before = problems->total;
    struct api_case *c = calloc(1, sizeof *c);
    if (c == NULL) {
        return no_memory(prefix, problems);
    }
    c->library = lib;
    case_def_defaults(&c->def);
    training_def_defaults(&c->training.def);
    c->training.seed = 1;
    reader_init(&r, prefix, problems);
    r.kind = kind_of(tree);
    r.context = c;
    field_read(&r, case_fields, tree, c);

    enum status st = ST_OK;
    /* Without a kind the core would ask for the members of the wrong one; and once the list is
     * full, what is reported already cannot be told. */
    if (r.kind != CASE_OF_NO_KIND && problems->count < FAILURE_LIST_MAX) {
        st = check_physics(&c->def, prefix, problems);
    }
    if (st == ST_OK && problems->total == before && case_kind_has_beam(c->def.kind)) {
        st = try_sections(&c->def, prefix, problems);
    }
    if (st == ST_OK && problems->total > before) {
        st = ST_INVALID;
    }
    if (st == ST_OK) {
        st = identify(c);
    }
    if (st == ST_OK) {
        *out = c;
    } else {
        api_case_destroy(c);
    }
    return st == ST_NO_MEMORY ? no_memory(prefix, problems) : st;
}

enum status api_case_parse(const struct library *lib, const char *json, size_t size,
                           const char *prefix, struct api_case **out, struct failure_list *problems)
{
    struct failure fail;
    struct cJSON *tree = NULL;
    struct reader r;
    enum status st = json_parse(json, size, &tree, &fail);
    reader_init(&r, prefix, problems);
    if (st != ST_OK) {
        char pointer[2 * sizeof fail.pointer];
        (void)snprintf(pointer, sizeof pointer, "%s%s", prefix, fail.pointer);
        failure_set(failure_add(problems), st, pointer, fail.code, fail.expected, fail.got, "%s",
                    fail.detail);
        return st;
    }
    const int before = problems->total;
    json_check(&r, tree);
    const bool sound = problems->total == before;
    struct api_case *c = NULL;
    st = api_case_from_tree(lib, tree, prefix, &c, problems);
    json_free(tree);
    if (st == ST_OK && sound) {
        *out = c;
    } else {
        api_case_destroy(c);
    }
    return st == ST_OK && !sound ? ST_INVALID : st;
}

void api_case_destroy(struct api_case *c)
{
    if (c != NULL) {
        entry_set_done(&c->local);
        motion_entry_done(&c->motion);
        free(c->station);
        free(c->canonical);
        free(c);
    }
}

const struct case_def *api_case_def(const struct api_case *c)
{
    return &c->def;
}

const char *api_case_canonical(const struct api_case *c)
{
    return c->canonical;
}

char *api_case_take_canonical(struct api_case *c)
{
    char *text = c->canonical;
    c->canonical = NULL;
    return text;
}

const char *api_case_hash(const struct api_case *c)
{
    return c->hash;
}
