/* GET /v1/jobs and /v1/studies, GET and DELETE /v1/jobs/{id}. */
#include "api/job_out.h"
#include "api/respond.h"
#include "api/text.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LIST_LIMIT = 50, LIST_LIMIT_MAX = 1000 };

/* The query of a list; id is what `filter.after` points to. */
struct list_query {
    struct service_filter filter;
    char id[JOB_ID_SIZE];
};

static void refuse_parameter(struct failure_list *errors, const char *key, const char *value,
                             const char *expected)
{
    char pointer[64];
    char got[96];
    (void)snprintf(pointer, sizeof pointer, "?%s", key);
    (void)snprintf(got, sizeof got, "\"%.80s\"", value);
    failure_set(failure_add(errors), ST_INVALID, pointer, "out_of_range", expected, got,
                "the parameter \"%s\" must be %s", key, expected);
}

static void read_list_query(const struct api_request *req, struct list_query *q,
                            struct failure_list *errors)
{
    const char *kind = api_query_get(req, "kind");
    const char *state = api_query_get(req, "state");
    const char *limit = api_query_get(req, "limit");
    const char *cursor = api_query_get(req, "cursor");
    int kind_value = CASE_SIMULATION;
    enum job_state state_value = JOB_QUEUED;
    double number = LIST_LIMIT;
    if (kind != NULL && !job_kind_parse(kind, &kind_value)) {
        refuse_parameter(errors, "kind", kind,
                         "a kind of job, such as \"simulation\" or \"study\"");
    }
    if (state != NULL && !job_state_parse(state, &state_value)) {
        refuse_parameter(errors, "state", state,
                         "one of queued running cancelling done failed cancelled");
    }
    if (limit != NULL && (!text_number(limit, &number) || number != floor(number) || number < 1 ||
                          number > LIST_LIMIT_MAX)) {
        refuse_parameter(errors, "limit", limit, "an integer from 1 to 1000");
        number = LIST_LIMIT;
    }
    if (cursor != NULL && !text_cursor_read(cursor, sizeof q->id, q->id)) {
        refuse_parameter(errors, "cursor", cursor, "the \"next\" of a page of this list");
    }
    q->filter = (struct service_filter){.limit = (int)number,
                                        .after = cursor != NULL ? q->id : NULL,
                                        .kind = kind != NULL ? kind_value : -1,
                                        .state = state != NULL ? (int)state_value : -1,
                                        .name = api_query_get(req, "name")};
}

/* The same list from the next page on, for the Link header. False when it does not fit one. */
static bool next_url(const struct api_request *req, const char *path, const char *cursor,
                     size_t size, char *out)
{
    static const char *const kept[] = {"kind", "state", "name", "limit"};
    size_t used = (size_t)snprintf(out, size, "%s?", path);
    for (size_t i = 0; i < sizeof kept / sizeof kept[0]; i++) {
        const char *value = api_query_get(req, kept[i]);
        if (value != NULL) {
            used += (size_t)snprintf(out + used, size - used, "%s=", kept[i]);
            if (used >= size || !text_percent_encode(value, size - used, out + used)) {
                return false;
            }
            used += strlen(out + used);
            used += (size_t)snprintf(out + used, size - used, "&");
        }
        if (used >= size) {
            return false;
        }
    }
    used += (size_t)snprintf(out + used, size - used, "cursor=%s", cursor);
    return used < size;
}

static void fill_list(const struct api_call *call, struct api_response *res, const char *path,
                      int n, const struct job_record *job, bool more)
{
    struct json_out out = {0};
    char cursor[TEXT_CURSOR_SIZE];
    char url[480];
    if (more && n > 0) {
        text_cursor_make(job[n - 1].id, cursor);
        if (next_url(call->req, path, cursor, sizeof url, url)) {
            api_response_header(res, "Link", "<%s>; rel=\"next\"", url);
        }
    }
    json_object_begin(&out);
    json_key(&out, strrchr(path, '/') + 1);
    json_array_begin(&out);
    for (int i = 0; i < n; i++) {
        job_write(&out, &job[i]);
    }
    json_array_end(&out);
    json_key_string(&out, "next", more && n > 0 ? cursor : NULL);
    json_object_end(&out);
    respond_json(res, 200, &out);
}

/* Jobs of one kind, or with -1 those the query asks for. */
static void list_jobs(const struct api_call *call, struct api_response *res, const char *path,
                      int kind)
{
    const struct service *s = call->api->service;
    struct list_query query;
    struct failure_list *errors = calloc(1, sizeof *errors);
    if (errors == NULL) {
        problem_response(res, PROBLEM_INTERNAL, status_text(ST_NO_MEMORY), NULL, NULL);
        return;
    }
    read_list_query(call->req, &query, errors);
    query.filter.kind = kind >= 0 ? kind : query.filter.kind;
    if (errors->total > 0) {
        problem_response(res, PROBLEM_BAD_QUERY, errors->item[0].detail, errors, NULL);
    } else {
        struct job_record *job = NULL;
        int n = 0;
        bool more = false;
        const enum service_status st = s->list(s->ctx, &query.filter, &job, &n, &more);
        if (st == SERVICE_OK) {
            fill_list(call, res, path, n, job, more);
        } else {
            respond_service(res, st, "");
        }
        free(job);
    }
    free(errors);
}

void handle_list(const struct api_call *call, struct api_response *res)
{
    list_jobs(call, res, "/v1/jobs", -1);
}

void handle_study_list(const struct api_call *call, struct api_response *res)
{
    list_jobs(call, res, "/v1/studies", JOB_STUDY);
}

void handle_get(const struct api_call *call, struct api_response *res)
{
    struct job_record job;
    if (respond_find_job(call, res, &job)) {
        struct json_out out = {0};
        job_write(&out, &job);
        respond_json(res, 200, &out);
    }
}

/* A cancel on its way: the id outlives the request. */
struct cancel {
    struct api_reply *reply;
    char id[JOB_ID_SIZE];
};

static void cancel_done(void *arg, enum service_status status, const struct job_record *job)
{
    struct cancel *c = arg;
    struct api_response res = {0};
    if (status == SERVICE_OK) {
        struct json_out out = {0};
        job_write(&out, job);
        respond_json(&res, 200, &out);
    } else {
        respond_service(&res, status, c->id);
    }
    c->reply->send(c->reply, &res);
    free(c);
}

void handle_cancel(const struct api_call *call, struct api_response *res)
{
    const struct service *s = call->api->service;
    struct job_record job;
    if (!respond_find_job(call, res, &job)) {
        return;
    }
    struct cancel *c = calloc(1, sizeof *c);
    if (c == NULL) {
        problem_response(res, PROBLEM_INTERNAL, status_text(ST_NO_MEMORY), NULL, NULL);
        return;
    }
    c->reply = call->reply;
    (void)snprintf(c->id, sizeof c->id, "%s", job.id);
    s->cancel(s->ctx, c->id, cancel_done, c);
}
