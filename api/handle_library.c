/* GET, POST and DELETE of /v1/materials, /v1/polars, /v1/networks and their entries. */
#include "api/handle_shelf.h"
#include "api/json.h"
#include "api/library_set.h"
#include "api/respond.h"
#include "api/text.h"

#include <cjson/cJSON.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void shelf_unknown(struct api_response *res, enum shelf_kind kind, const char *name)
{
    char detail[160 + ROUTE_PARAM_SIZE];
    const char *what = shelf_kind_name(kind);
    (void)snprintf(detail, sizeof detail, "the library has no %s \"%s\"; /v1/%ss lists them", what,
                   name, what);
    problem_response(res, PROBLEM_UNKNOWN_NAME, detail, NULL, NULL);
}

bool shelf_query_version(const struct api_call *call, struct api_response *res, int *version)
{
    const char *text = api_query_get(call->req, "version");
    double v = 0.0;
    if (text != NULL && !(text_number(text, &v) && v >= 1.0 && v <= 1e9 && v == (int)v)) {
        problem_response(res, PROBLEM_BAD_QUERY, "version must be a whole number from 1 on", NULL,
                         NULL);
        return false;
    }
    *version = (int)v;
    return true;
}

/* The list when the path has no name, otherwise one entry. */
static void show(const struct api_call *call, struct api_response *res, enum shelf_kind kind)
{
    const struct library *lib = call->api->library;
    char *body = NULL;
    int version = 0;
    if (!shelf_query_version(call, res, &version)) {
        return;
    }
    const enum service_status st = call->param[0] == '\0'
                                       ? library_list_json(lib, kind, &body)
                                       : library_entry_json(lib, kind, call->param, version, &body);
    if (st == SERVICE_NOT_FOUND) {
        shelf_unknown(res, kind, call->param);
    } else if (st != SERVICE_OK) {
        free(body);
        respond_service(res, st, "");
    } else {
        respond_tagged(call, res, "application/json", respond_revalidate, body,
                       body != NULL ? strlen(body) : 0);
    }
}

/* -- POST ------------------------------------------------------------------------------- */

/* An entry on its way to the shelf: lives from the request to the answer. */
struct putting {
    struct api_reply *reply;
    struct shelf_item item;
    char name[LIMIT_NAME], hash[LIMIT_HASH];
    char *head;
    void *data;
};

static void putting_destroy(struct putting *p)
{
    free(p->head);
    free(p->data);
    free(p);
}

static void put_done(void *arg, enum service_status status, int version, bool reused)
{
    struct putting *p = arg;
    struct api_response res = {0};
    if (status == SERVICE_OK) {
        struct json_out out = {0};
        char path[4 * LIMIT_NAME], name[3 * LIMIT_NAME];
        (void)text_percent_encode(p->name, sizeof name, name);
        (void)snprintf(path, sizeof path, "/v1/%ss/%s", shelf_kind_name(p->item.kind), name);
        json_object_begin(&out);
        json_key_string(&out, "name", p->name);
        json_key_integer(&out, "version", version);
        json_key_string(&out, "hash", p->hash);
        json_key(&out, "reused");
        json_boolean(&out, reused);
        json_key(&out, "links");
        json_object_begin(&out);
        json_key_string(&out, "self", path);
        json_object_end(&out);
        json_object_end(&out);
        api_response_header(&res, "Location", "%s", path);
        respond_json(&res, reused ? 200 : 201, &out);
    } else {
        respond_service(&res, status, "");
    }
    p->reply->send(p->reply, &res);
    putting_destroy(p);
}

void shelf_put_new(const struct api_call *call, struct api_response *res, enum shelf_kind kind,
                   const struct shelf_new *entry)
{
    const struct shelf *shelf = call->api->shelf;
    struct putting *p = calloc(1, sizeof *p);
    if (p == NULL || entry->head == NULL || entry->data == NULL) {
        free(p);
        free(entry->head);
        free(entry->data);
        problem_response(res, PROBLEM_INTERNAL, status_text(ST_NO_MEMORY), NULL, NULL);
        return;
    }
    p->reply = call->reply;
    p->head = entry->head;
    p->data = entry->data;
    (void)snprintf(p->name, sizeof p->name, "%s", entry->name);
    (void)snprintf(p->hash, sizeof p->hash, "%s", entry->hash);
    p->item = (struct shelf_item){.kind = kind,
                                  .name = p->name,
                                  .hash = p->hash,
                                  .head = p->head,
                                  .job = "",
                                  .data = p->data,
                                  .size = entry->size};
    shelf->put(shelf->ctx, &p->item, put_done, p);
}

bool shelf_name_is_free(struct api_response *res, bool built_in, const char *name)
{
    char detail[300];
    if (built_in) {
        (void)snprintf(detail, sizeof detail,
                       "\"%s\" belongs to the program and never changes; take another name", name);
        problem_response(res, PROBLEM_BUILT_IN, detail, NULL, NULL);
        return false;
    }
    if (!shelf_name_is_allowed(name)) {
        struct failure_list *list = calloc(1, sizeof *list);
        if (list == NULL) {
            problem_response(res, PROBLEM_INTERNAL, status_text(ST_NO_MEMORY), NULL, NULL);
            return false;
        }
        failure_set(failure_add(list), ST_INVALID, "/name", "bad_name",
                    "1..63 letters, digits, and any of ._+/-", NULL,
                    "the name has characters a reference cannot have");
        respond_refuse(res, PROBLEM_INVALID_ENTRY, list);
        free(list);
        return false;
    }
    return true;
}

/* An entry as GET shows it can be sent again: what it says about its version does not count; its
 * hash, taken out here, must fit. NULL when it has none. */
static cJSON *take_hash(cJSON *tree)
{
    static const char *const shown[] = {"version", "built_in", "created", "job"};
    for (size_t i = 0; i < sizeof shown / sizeof shown[0]; i++) {
        cJSON_DeleteItemFromObjectCaseSensitive(tree, shown[i]);
    }
    return cJSON_DetachItemFromObjectCaseSensitive(tree, "hash");
}

static void check_hash(struct reader *r, const cJSON *hash, const char *content)
{
    if (hash != NULL && !(cJSON_IsString(hash) && strcmp(hash->valuestring, content) == 0)) {
        const size_t mark = reader_enter_key(r, "hash");
        reader_problem(r, "bad_checksum", content, hash,
                       "the hash is not that of the content: numbers were changed or lost");
        reader_leave(r, mark);
    }
}

/* Fills entry->name (which lives in the set), hash, head and data. ST_CORRUPT: it is not JSON. */
static enum status read_body(const struct api_request *req, enum shelf_kind kind,
                             entry_reader read_one, struct entry_set *set, struct shelf_new *entry,
                             struct failure_list *problems)
{
    struct cJSON *tree = NULL;
    struct reader r;
    struct failure fail = {0};
    const enum status st = json_parse(req->body, req->body_size, &tree, &fail);
    if (st != ST_OK) {
        *failure_add(problems) = fail;
        return st == ST_NO_MEMORY ? st : ST_CORRUPT;
    }
    reader_init(&r, "", problems);
    json_check(&r, tree);
    cJSON *hash = take_hash(tree);
    if (problems->total == 0 && read_one(&r, tree, set)) {
        char *data = NULL;
        entry->name = library_item(set, kind, entry->hash, &entry->head, &data);
        entry->data = data;
        entry->size = data != NULL ? strlen(data) : 0;
        check_hash(&r, hash, entry->hash);
    }
    cJSON_Delete(hash);
    json_free(tree);
    if (problems->total == 0) {
        return ST_OK;
    }
    return reader_ran_out_of_memory(problems) ? ST_NO_MEMORY : ST_INVALID;
}

static void add(const struct api_call *call, struct api_response *res, enum shelf_kind kind,
                entry_reader read_one)
{
    const struct api_request *req = call->req;
    if (!respond_is_json(call, res)) {
        return;
    }
    struct entry_set set = {0};
    struct shelf_new entry = {.name = NULL};
    struct failure_list *problems = calloc(1, sizeof *problems);
    const enum status st =
        problems != NULL ? read_body(req, kind, read_one, &set, &entry, problems) : ST_NO_MEMORY;
    if (st == ST_NO_MEMORY) {
        problem_response(res, PROBLEM_INTERNAL, status_text(st), NULL, NULL);
    } else if (st != ST_OK) {
        respond_refuse(res, st == ST_CORRUPT ? PROBLEM_MALFORMED_JSON : PROBLEM_INVALID_ENTRY,
                       problems);
    } else if (shelf_name_is_free(res, library_is_built_in(call->api->library, kind, entry.name),
                                  entry.name)) {
        shelf_put_new(call, res, kind, &entry);
        entry.head = NULL;
        entry.data = NULL;
    }
    free(entry.head);
    free(entry.data);
    entry_set_done(&set);
    free(problems);
}

/* -- DELETE ----------------------------------------------------------------------------- */

struct dropping {
    struct api_reply *reply;
    enum shelf_kind kind;
    char name[ROUTE_PARAM_SIZE];
};

static void drop_done(void *arg, enum service_status status)
{
    struct dropping *d = arg;
    struct api_response res = {0};
    if (status == SERVICE_OK) {
        res.status = 204;
    } else if (status == SERVICE_NOT_FOUND) {
        shelf_unknown(&res, d->kind, d->name);
    } else if (status == SERVICE_NOT_READY) {
        problem_response(&res, PROBLEM_IN_USE,
                         "a training that is not finished reads it; cancel "
                         "the training or wait for its end",
                         NULL, NULL);
    } else {
        respond_service(&res, status, "");
    }
    d->reply->send(d->reply, &res);
    free(d);
}

void shelf_remove(const struct api_call *call, struct api_response *res, enum shelf_kind kind,
                  bool built_in)
{
    const struct shelf *shelf = call->api->shelf;
    int version = 0;
    if (!shelf_query_version(call, res, &version)) {
        return;
    }
    if (built_in) {
        problem_response(res, PROBLEM_BUILT_IN, "what belongs to the program cannot be deleted",
                         NULL, NULL);
        return;
    }
    struct dropping *d = calloc(1, sizeof *d);
    if (d == NULL) {
        problem_response(res, PROBLEM_INTERNAL, status_text(ST_NO_MEMORY), NULL, NULL);
        return;
    }
    d->reply = call->reply;
    d->kind = kind;
    (void)snprintf(d->name, sizeof d->name, "%s", call->param);
    shelf->drop(shelf->ctx, kind, call->param, version, drop_done, d);
}

static void remove_entry(const struct api_call *call, struct api_response *res,
                         enum shelf_kind kind)
{
    shelf_remove(call, res, kind, library_is_built_in(call->api->library, kind, call->param));
}

/* -- routes ----------------------------------------------------------------------------- */

void handle_materials(const struct api_call *call, struct api_response *res)
{
    show(call, res, SHELF_MATERIAL);
}

void handle_polars(const struct api_call *call, struct api_response *res)
{
    show(call, res, SHELF_POLAR);
}

void handle_networks(const struct api_call *call, struct api_response *res)
{
    show(call, res, SHELF_NETWORK);
}

void handle_add_material(const struct api_call *call, struct api_response *res)
{
    add(call, res, SHELF_MATERIAL, entry_read_material);
}

void handle_add_polar(const struct api_call *call, struct api_response *res)
{
    add(call, res, SHELF_POLAR, entry_read_polar);
}

void handle_add_network(const struct api_call *call, struct api_response *res)
{
    add(call, res, SHELF_NETWORK, entry_read_network);
}

void handle_remove_material(const struct api_call *call, struct api_response *res)
{
    remove_entry(call, res, SHELF_MATERIAL);
}

void handle_remove_polar(const struct api_call *call, struct api_response *res)
{
    remove_entry(call, res, SHELF_POLAR);
}

void handle_remove_network(const struct api_call *call, struct api_response *res)
{
    remove_entry(call, res, SHELF_NETWORK);
}
