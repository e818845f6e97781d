/* Studies: POST and GET /v1/studies, one study, its cells, its maps. */
#include "api/job_out.h"
#include "api/json.h"
#include "api/reader.h"
#include "api/respond.h"
#include "api/study.h"
#include "api/text.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { CELL_LIMIT = 100, CELL_LIMIT_MAX = 1000, CELL_PAGE = 500 };

/* -- submit ----------------------------------------------------------------------------- */

/* A study on its way to storage. */
struct study_submission {
    struct api_reply *reply;
    struct service_submit item;
    struct study_plan plan;
    char *canonical;
    char name[128];
    char hash[LIMIT_HASH];
};

static void write_accepted(struct json_out *out, const struct study_submission *s,
                           const struct service_submitted *r)
{
    char path[96];
    json_object_begin(out);
    json_key_string(out, "id", r->id);
    json_key_string(out, "state", job_state_name(r->state));
    json_key(out, "reused");
    json_boolean(out, r->reused);
    json_key_string(out, "kind", job_kind_name(JOB_STUDY));
    json_key_string(out, "name", s->name);
    json_key_string(out, "content_hash", s->hash);
    json_key_integer(out, "cells", s->plan.n_cell);
    json_key(out, "links");
    json_object_begin(out);
    (void)snprintf(path, sizeof path, "/v1/studies/%s", r->id);
    json_key_string(out, "self", path);
    json_object_end(out);
    json_object_end(out);
}

static void study_submitted(void *arg, enum service_status status, int n,
                            const struct service_submitted *result)
{
    struct study_submission *s = arg;
    struct api_response res = {0};
    (void)n;
    if (status == SERVICE_OK) {
        struct json_out out = {0};
        write_accepted(&out, s, &result[0]);
        api_response_header(&res, "Location", "/v1/studies/%s", result[0].id);
        respond_json(&res, result[0].reused ? 200 : 202, &out);
    } else {
        respond_service(&res, status, "");
    }
    s->reply->send(s->reply, &res);
    free(s->canonical);
    free(s);
}

void study_submit(const struct api_call *call, struct study *study, struct api_response *res)
{
    const struct service *service = call->api->service;
    struct study_submission *s = calloc(1, sizeof *s);
    if (s == NULL) {
        problem_response(res, PROBLEM_INTERNAL, status_text(ST_NO_MEMORY), NULL, NULL);
        return;
    }
    s->reply = call->reply;
    s->plan = study_plan_of(study);
    (void)snprintf(s->name, sizeof s->name, "%s", study_name(study));
    (void)snprintf(s->hash, sizeof s->hash, "%s", study_hash(study));
    s->canonical = study_take_canonical(study);
    s->item = (struct service_submit){.kind = JOB_STUDY,
                                      .name = s->name,
                                      .case_json = s->canonical,
                                      .content_hash = s->hash,
                                      .plan = &s->plan};
    service->submit(service->ctx, 1, &s->item, study_submitted, s);
}

/* -- one study -------------------------------------------------------------------------- */

/* Like respond_find_job, for a job that is a study. */
bool study_find(const struct api_call *call, struct api_response *res, struct job_record *job,
                struct service_study *study)
{
    const struct service *s = call->api->service;
    char detail[128];
    if (!respond_find_job(call, res, job)) {
        return false;
    }
    if (job->kind != JOB_STUDY) {
        (void)snprintf(detail, sizeof detail, "the job is no study but of kind \"%s\"",
                       job_kind_name(job->kind));
        problem_response(res, PROBLEM_UNKNOWN_JOB, detail, NULL, NULL);
        return false;
    }
    const enum service_status st = s->get_study(s->ctx, job->id, study);
    if (st != SERVICE_OK) {
        respond_service(res, st, job->id);
    }
    return st == SERVICE_OK;
}

/* The definition of a job that is a study, opened; NULL when the answer is given. */
struct study *study_of_job(const struct api_call *call, struct api_response *res, const char *id)
{
    const struct service *s = call->api->service;
    char *json = NULL;
    struct study *study = NULL;
    const enum service_status st = s->get_case(s->ctx, id, &json);
    if (st != SERVICE_OK) {
        respond_service(res, st, id);
        return NULL;
    }
    struct failure_list *problems = calloc(1, sizeof *problems);
    if (problems == NULL || study_open(call->api->library, json, &study, problems) != ST_OK) {
        const bool known = problems != NULL && problems->count > 0;
        problem_response(res, PROBLEM_INTERNAL,
                         known ? problems->item[0].detail : status_text(ST_NO_MEMORY), NULL, NULL);
    }
    free(problems);
    free(json);
    return study;
}

enum service_status study_each_cell(const struct service *s, const char *id, int n_path,
                                    const char *const *path, study_visit visit, void *arg)
{
    enum service_status st = SERVICE_OK;
    int from = 0, n = CELL_PAGE;
    while (st == SERVICE_OK && n == CELL_PAGE) {
        struct service_cell *cell = NULL;
        st = s->get_cells(s->ctx, id, from, CELL_PAGE, true, &cell, &n);
        if (st != SERVICE_OK) {
            return st;
        }
        for (int i = 0; i < n; i++) {
            const char *text = cell[i].summary;
            cJSON *summary = text == NULL ? NULL
                             : n_path > 0 ? study_value_parse(text, n_path, path)
                                          : cJSON_Parse(text);
            st = text != NULL && summary == NULL ? SERVICE_ERROR : st;
            visit(arg, &cell[i], &summary);
            cJSON_Delete(summary);
        }
        from = n > 0 ? cell[n - 1].cell + 1 : from;
        service_cells_done(cell, n);
        free(cell);
    }
    return st;
}

void handle_study(const struct api_call *call, struct api_response *res)
{
    struct job_record job;
    struct service_study study;
    if (!study_find(call, res, &job, &study)) {
        return;
    }
    struct json_out out = {0};
    json_object_begin(&out);
    job_write_members(&out, &job);
    json_key(&out, "cells");
    json_object_begin(&out);
    json_key_integer(&out, "total", study.n_cell);
    json_key_integer(&out, "done", study.done);
    json_key_integer(&out, "failed", study.failed);
    json_key_integer(&out, "pending", study.n_cell - study.done - study.failed);
    json_key_integer(&out, "reused", study.reused);
    json_object_end(&out);
    json_key_number(&out, "cpu_s", study.cpu_s);
    json_object_end(&out);
    respond_json(res, 200, &out);
}

/* -- cells ------------------------------------------------------------------------------ */

static void write_cell(struct json_out *out, const struct study *study,
                       const struct service_cell *c)
{
    study_point(out, study, c->cell);
    json_key_string(out, "state", study_cell_state_name(c->state));
    json_key(out, "reused");
    json_boolean(out, c->reused);
    json_key_string(out, "verdict", c->verdict[0] != '\0' ? c->verdict : NULL);
    json_key(out, "error");
    if (c->state == STUDY_CELL_FAILED) {
        json_object_begin(out);
        json_key_string(out, "code", c->error_code);
        json_key_string(out, "detail", c->error_detail);
        json_object_end(out);
    } else {
        json_null(out);
    }
    json_key_string(out, "content_hash", c->content_hash[0] != '\0' ? c->content_hash : NULL);
}

/* A whole number of the query, within limits; `value` stays when it is not given. False when it is
 * none, with the answer given. */
static bool whole_number(const struct api_call *call, struct api_response *res, const char *key,
                         int least, int most, int *value)
{
    const char *text = api_query_get(call->req, key);
    double number = 0.0;
    char pointer[32], expected[48];
    if (text == NULL) {
        return true;
    }
    if (text_number(text, &number) && number == floor(number) && number >= least &&
        number <= most) {
        *value = (int)number;
        return true;
    }
    struct failure_list *errors = calloc(1, sizeof *errors);
    (void)snprintf(pointer, sizeof pointer, "?%s", key);
    (void)snprintf(expected, sizeof expected, "an integer from %d to %d", least, most);
    if (errors != NULL) {
        failure_set(failure_add(errors), ST_INVALID, pointer, "out_of_range", expected, text,
                    "the parameter \"%s\" must be %s", key, expected);
    }
    problem_response(res, PROBLEM_BAD_QUERY, expected, errors, NULL);
    free(errors);
    return false;
}

static void fill_cells(struct api_response *res, const struct study *study,
                       const struct service_cell *cell, int n, int limit)
{
    struct json_out out = {0};
    json_object_begin(&out);
    json_key(&out, "cells");
    json_array_begin(&out);
    for (int i = 0; i < n; i++) {
        json_object_begin(&out);
        write_cell(&out, study, &cell[i]);
        json_object_end(&out);
    }
    json_array_end(&out);
    json_key(&out, "next");
    if (n == limit && cell[n - 1].cell + 1 < study_cells(study)) {
        json_integer(&out, cell[n - 1].cell + 1);
    } else {
        json_null(&out);
    }
    json_object_end(&out);
    respond_json(res, 200, &out);
}

void handle_cells(const struct api_call *call, struct api_response *res)
{
    const struct service *s = call->api->service;
    struct job_record job;
    struct service_study progress;
    struct service_cell *cell = NULL;
    int from = 0, limit = CELL_LIMIT, n = 0;
    if (!study_find(call, res, &job, &progress) ||
        !whole_number(call, res, "from", 0, STUDY_CELLS_MAX, &from) ||
        !whole_number(call, res, "limit", 1, CELL_LIMIT_MAX, &limit)) {
        return;
    }
    struct study *study = study_of_job(call, res, job.id);
    if (study == NULL) {
        return;
    }
    const enum service_status st = s->get_cells(s->ctx, job.id, from, limit, false, &cell, &n);
    if (st == SERVICE_OK) {
        fill_cells(res, study, cell, n, limit);
        service_cells_done(cell, n);
        free(cell);
    } else {
        respond_service(res, st, job.id);
    }
    study_destroy(study);
}

/* The case of a cell as it would be posted; NULL when it is not admissible. */
static char *case_of(struct study *study, int cell)
{
    char *text = NULL;
    struct api_case *c = NULL;
    struct failure_list *problems = calloc(1, sizeof *problems);
    if (problems != NULL && study_case(study, cell, &c, problems) == ST_OK) {
        text = api_case_take_canonical(c);
        api_case_destroy(c);
    }
    free(problems);
    return text;
}

static void fill_cell(struct api_response *res, struct study *study, const struct service_cell *c)
{
    struct json_out out = {0};
    char *text = case_of(study, c->cell);
    json_object_begin(&out);
    write_cell(&out, study, c);
    json_key(&out, "case");
    json_raw(&out, text);
    json_key(&out, "summary");
    json_raw(&out, c->summary);
    json_object_end(&out);
    respond_json(res, 200, &out);
    free(text);
}

void handle_cell(const struct api_call *call, struct api_response *res)
{
    const struct service *s = call->api->service;
    struct job_record job;
    struct service_study progress;
    struct service_cell *found = NULL;
    double number = 0.0;
    int n = 0;
    if (!study_find(call, res, &job, &progress)) {
        return;
    }
    const bool whole = text_number(call->tail, &number) && number == floor(number);
    if (!whole || number < 0.0 || number >= progress.n_cell) {
        char detail[128];
        (void)snprintf(detail, sizeof detail, "the study has the cells 0 to %d, not \"%.40s\"",
                       progress.n_cell - 1, call->tail);
        problem_response(res, PROBLEM_NO_CELL, detail, NULL, NULL);
        return;
    }
    struct study *study = study_of_job(call, res, job.id);
    if (study == NULL) {
        return;
    }
    const enum service_status st = s->get_cells(s->ctx, job.id, (int)number, 1, true, &found, &n);
    if (st == SERVICE_OK) {
        const struct service_cell pending = {.cell = (int)number, .state = STUDY_CELL_PENDING};
        fill_cell(res, study, n == 1 && found->cell == (int)number ? found : &pending);
        service_cells_done(found, n);
        free(found);
    } else {
        respond_service(res, st, job.id);
    }
    study_destroy(study);
}
