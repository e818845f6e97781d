/* GET, POST and DELETE of /v1/datasets. */
#include "api/dataset.h"
#include "api/handle_shelf.h"
#include "api/hash.h"
#include "api/hdf5_dataset.h"
#include "api/json.h"
#include "api/library_set.h"
#include "api/respond.h"
#include "api/text.h"
#include "core/num.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* -- GET -------------------------------------------------------------------------------- */

void handle_datasets(const struct api_call *call, struct api_response *res)
{
    const char *head = dataset_built_in_head();
    struct json_out out = {0};
    json_object_begin(&out);
    json_key(&out, "datasets");
    json_array_begin(&out);
    json_object_begin(&out);
    json_members(&out, head, strlen(head));
    library_version_members(&out, NULL);
    json_object_end(&out);
    const enum service_status st = library_shelf_members(&out, call->api->library, SHELF_DATASET);
    json_array_end(&out);
    json_object_end(&out);
    size_t size = 0;
    char *body = json_out_take(&out, &size);
    if (st != SERVICE_OK) {
        free(body);
        respond_service(res, st, "");
        return;
    }
    respond_tagged(call, res, "application/json", respond_revalidate, body, size);
}

enum format { FORMAT_JSON, FORMAT_CSV, FORMAT_SVG, FORMATS };
static const struct {
    const char *name, *type, *sent;
} formats[FORMATS] = {{"json", "application/json", "application/json"},
                      {"csv", "text/csv", "text/csv; charset=utf-8; header=present"},
                      {"svg", "image/svg+xml", "image/svg+xml"}};

/* Cuts ".json", ".csv" or ".svg" off the name of a record; FORMATS when it has none. */
static enum format cut_format(char *record)
{
    for (int i = 0; i < FORMATS; i++) {
        const size_t n = strlen(record), end = strlen(formats[i].name);
        if (n > end + 1 && record[n - end - 1] == '.' &&
            strcmp(record + n - end, formats[i].name) == 0) {
            record[n - end - 1] = '\0';
            return (enum format)i;
        }
    }
    return FORMATS;
}

/* By the query, else by Accept. False when the answer is given. */
static bool choose(const struct api_call *call, struct api_response *res, bool one_record,
                   enum format *out)
{
    const char *asked = api_query_get(call->req, "format");
    const int n = one_record ? FORMATS : FORMAT_SVG;
    int best = 0;
    for (int i = 0; i < n; i++) {
        if (asked != NULL && strcmp(asked, formats[i].name) == 0) {
            *out = (enum format)i;
            return true;
        }
        if (text_accept_weight(call->req->accept, formats[i].type) >
            text_accept_weight(call->req->accept, formats[best].type)) {
            best = i;
        }
    }
    if (asked != NULL) {
        problem_response(res, PROBLEM_BAD_QUERY,
                         one_record ? "format must be json, csv or svg"
                                    : "format must be json or csv; a drawing is one of a record",
                         NULL, NULL);
        return false;
    }
    *out = (enum format)best;
    return true;
}

/* Only the record of this name is left; false when there is none. */
static bool keep_record(struct dataset_entry *e, const char *name)
{
    for (int i = 0; i < e->n_record; i++) {
        if (strcmp(e->record[i].name, name) == 0) {
            const struct flow_record first = e->record[0];
            e->record[0] = e->record[i];
            e->record[i] = first;
            while (e->n_record > 1) {
                free(e->record[--e->n_record].value);
            }
            return true;
        }
    }
    return false;
}

static void write_columns(struct json_out *out, const struct flow_record *r)
{
    json_object_begin(out);
    json_key_string(out, "name", r->name);
    json_key_number(out, "period_c_v", r->period);
    json_key_number(out, "start_c_v", r->start);
    for (int k = 0; k < FLOW_ROWS; k++) {
        const double scale = k == FLOW_THETA ? 180.0 / NUM_PI : 1.0;
        json_key_numbers(out, dataset_columns[DATASET_FLOW + k], r->n,
                         r->value + num_at(0, k, r->n), 1, scale);
    }
    json_object_end(out);
}

static void write_item(struct json_out *out, const struct dataset_entry *e,
                       const struct shelf_entry *kept)
{
    json_object_begin(out);
    json_members(out, kept->head, strlen(kept->head));
    library_version_members(out, dataset_is_built_in(e->name) ? NULL : kept);
    json_key(out, "records");
    dataset_write_records(out, e);
    json_object_end(out);
}

static void show(const struct api_call *call, struct api_response *res, struct dataset_entry *e,
                 const struct shelf_entry *kept)
{
    const bool one = call->tail[0] != '\0';
    char record[ROUTE_PARAM_SIZE];
    struct json_out out = {0};
    size_t size = 0;
    (void)snprintf(record, sizeof record, "%s", call->tail);
    bool found = !one || keep_record(e, record);
    enum format format = found ? FORMATS : cut_format(record);
    found = found || keep_record(e, record);
    if (!found) {
        char detail[400];
        (void)snprintf(detail, sizeof detail, "the dataset \"%s\" has no record \"%.200s\"",
                       e->name, record);
        problem_response(res, PROBLEM_UNKNOWN_NAME, detail, NULL, NULL);
        return;
    }
    if (format == FORMATS && !choose(call, res, one, &format)) {
        return;
    }
    if (format == FORMAT_CSV) {
        dataset_write_csv(&out, e);
    } else if (format == FORMAT_SVG) {
        dataset_write_svg(&out, &e->record[0]);
    } else if (one) {
        write_columns(&out, &e->record[0]);
    } else {
        write_item(&out, e, kept);
    }
    char *body = json_out_take(&out, &size);
    api_response_header(res, "Vary", "Accept");
    respond_tagged(call, res, formats[format].sent, respond_revalidate, body, size);
}

void handle_dataset(const struct api_call *call, struct api_response *res)
{
    struct dataset_entry e = {.n_record = 0};
    struct shelf_entry kept = {.version = 0};
    char reference[ROUTE_PARAM_SIZE + 16];
    int version = 0;
    if (!shelf_query_version(call, res, &version)) {
        return;
    }
    (void)snprintf(reference, sizeof reference, version > 0 ? "%s@%d" : "%s", call->param, version);
    const enum service_status st = strchr(call->param, '@') != NULL
                                       ? SERVICE_NOT_FOUND
                                       : dataset_load(call->api->library, reference, &e, &kept);
    if (st == SERVICE_NOT_FOUND) {
        shelf_unknown(res, SHELF_DATASET, call->param);
    } else if (st != SERVICE_OK) {
        respond_service(res, st, "");
    } else {
        show(call, res, &e, &kept);
    }
    dataset_entry_done(&e);
    shelf_entry_done(&kept);
}

/* -- POST ------------------------------------------------------------------------------- */

/* ST_CORRUPT: it is not JSON. */
static enum status read_json(const struct api_request *req, struct dataset_entry *e,
                             struct failure_list *problems)
{
    struct cJSON *tree = NULL;
    struct failure fail = {0};
    struct reader r;
    const enum status st = json_parse(req->body, req->body_size, &tree, &fail);
    if (st != ST_OK) {
        *failure_add(problems) = fail;
        return st == ST_NO_MEMORY ? st : ST_CORRUPT;
    }
    reader_init(&r, "", problems);
    json_check(&r, tree);
    if (problems->total == 0) {
        dataset_read_json(&r, tree, e);
    }
    json_free(tree);
    return reader_ran_out_of_memory(problems) ? ST_NO_MEMORY : ST_OK;
}

/* Text that has no place for a name and notes takes them from the query. */
static enum status take_query(const struct api_request *req, struct dataset_entry *e,
                              struct failure_list *problems)
{
    const char *name = api_query_get(req, "name");
    const char *description = api_query_get(req, "description");
    if (name == NULL || strlen(name) >= sizeof e->name) {
        failure_set(failure_add(problems), ST_INVALID, "?name", "required", "a name of 1..63 bytes",
                    NULL, "the query must have the name of the dataset");
        return ST_INVALID;
    }
    (void)snprintf(e->name, sizeof e->name, "%s", name);
    if (description != NULL) {
        struct json_out out = {0};
        json_string(&out, description);
        e->description = json_out_take(&out, NULL);
        return e->description != NULL ? ST_OK : ST_NO_MEMORY;
    }
    return ST_OK;
}

static enum status read_csv(const struct api_request *req, struct dataset_entry *e,
                            struct failure_list *problems)
{
    const enum status st = take_query(req, e, problems);
    return st == ST_OK ? dataset_read_csv(req->body, req->body_size, e, problems) : st;
}

static enum status read_hdf5(const struct api_request *req, struct dataset_entry *e,
                             struct failure_list *problems)
{
    const enum status st = take_query(req, e, problems);
    return st == ST_OK ? hdf5_read_dataset(req->body, req->body_size, e, problems) : st;
}

static const struct {
    const char *type;
    enum status (*read)(const struct api_request *req, struct dataset_entry *e,
                        struct failure_list *problems);
} readers[] = {
    {"application/json", read_json}, {"text/csv", read_csv}, {"application/x-hdf5", read_hdf5}};

/* Canonical text and what follows from it. */
static bool seal(struct dataset_entry *e, struct shelf_new *entry)
{
    struct json_out text = {0}, head = {0};
    size_t size = 0;
    dataset_write_csv(&text, e);
    char *csv = json_out_take(&text, &size);
    if (csv == NULL) {
        return false;
    }
    hash_text(csv, size, e->hash);
    dataset_write_head(&head, e);
    entry->name = e->name;
    memcpy(entry->hash, e->hash, sizeof entry->hash);
    entry->head = json_out_take(&head, NULL);
    entry->data = dataset_compress(csv, size, &entry->size);
    free(csv);
    return true;
}

static void add(const struct api_call *call, struct api_response *res, size_t reader)
{
    struct dataset_entry e = {.n_record = 0};
    struct shelf_new entry = {.name = NULL};
    struct failure_list *problems = calloc(1, sizeof *problems);
    enum status st =
        problems != NULL ? readers[reader].read(call->req, &e, problems) : ST_NO_MEMORY;
    if (st == ST_OK && problems->total == 0) {
        dataset_check(&e, problems);
    }
    if (st == ST_NO_MEMORY) {
        problem_response(res, PROBLEM_INTERNAL, status_text(st), NULL, NULL);
    } else if (problems->total > 0) {
        respond_refuse(res, st == ST_CORRUPT ? PROBLEM_MALFORMED_JSON : PROBLEM_INVALID_ENTRY,
                       problems);
    } else if (strchr(e.name, '/') != NULL) {
        problem_response(res, PROBLEM_INVALID_ENTRY, "the name of a dataset has no '/'", NULL,
                         NULL);
    } else if (!shelf_name_is_free(res, dataset_is_built_in(e.name), e.name)) {
        /* answered */
    } else if (seal(&e, &entry)) {
        shelf_put_new(call, res, SHELF_DATASET, &entry);
    } else {
        problem_response(res, PROBLEM_INTERNAL, status_text(ST_NO_MEMORY), NULL, NULL);
    }
    dataset_entry_done(&e);
    free(problems);
}

void handle_add_dataset(const struct api_call *call, struct api_response *res)
{
    char detail[200];
    for (size_t i = 0; i < sizeof readers / sizeof readers[0]; i++) {
        if (text_is_media_type(call->req->content_type, readers[i].type)) {
            add(call, res, i);
            return;
        }
    }
    (void)snprintf(detail, sizeof detail,
                   "Content-Type is %.80s; send application/json, text/csv or application/x-hdf5",
                   call->req->content_type != NULL ? call->req->content_type : "absent");
    problem_response(res, PROBLEM_MEDIA_TYPE, detail, NULL, NULL);
}

void handle_remove_dataset(const struct api_call *call, struct api_response *res)
{
    shelf_remove(call, res, SHELF_DATASET, dataset_is_built_in(call->param));
}
