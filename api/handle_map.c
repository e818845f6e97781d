/* GET /v1/studies/{id}/map: one value of every cell over the axes. */
#include "api/json.h"
#include "api/reader.h"
#include "api/respond.h"
#include "api/study.h"

#include <cjson/cJSON.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PAGE = 500, NAMES_MAX = 32 };

/* How a map fared. */
struct map_read {
    int seen, absent; /* cells with a summary; those without the value */
    bool no_memory;
    bool composite;  /* the value is an object or an array */
    char names[160]; /* members of a summary, for the answer to a wrong value */
};

static void name_members(const cJSON *summary, struct map_read *read)
{
    const char *names[NAMES_MAX + 1] = {NULL};
    int n = 0;
    for (const cJSON *c = summary->child; c != NULL && n < NAMES_MAX; c = c->next) {
        names[n++] = c->string;
    }
    reader_join(names, sizeof read->names, read->names);
}

static void enter(struct study_map *m, const struct service_cell *c, struct map_read *read)
{
    cJSON *summary = c->summary != NULL ? cJSON_Parse(c->summary) : NULL;
    const enum study_value_kind kind = study_map_set(m, c->cell, c->state, summary);
    read->no_memory = read->no_memory || (c->summary != NULL && summary == NULL);
    if (summary != NULL) {
        read->seen++;
        read->absent += kind == STUDY_VALUE_ABSENT;
        read->composite = read->composite || kind == STUDY_VALUE_NONE;
        if (read->seen == 1) {
            name_members(summary, read);
        }
    }
    cJSON_Delete(summary);
}

/* Reads all finished cells, page by page. */
static enum service_status read_cells(const struct service *s, const char *id, struct study_map *m,
                                      struct map_read *read)
{
    int from = 0, n = PAGE;
    while (n == PAGE) {
        struct service_cell *cell = NULL;
        const enum service_status st = s->get_cells(s->ctx, id, from, PAGE, true, &cell, &n);
        if (st != SERVICE_OK) {
            return st;
        }
        for (int i = 0; i < n; i++) {
            enter(m, &cell[i], read);
        }
        from = n > 0 ? cell[n - 1].cell + 1 : from;
        service_cells_done(cell, n);
        free(cell);
    }
    return read->no_memory ? SERVICE_ERROR : SERVICE_OK;
}

static void refuse_value(struct api_response *res, const struct study_map *m,
                         const struct map_read *read)
{
    char detail[200];
    struct failure_list *errors = calloc(1, sizeof *errors);
    (void)snprintf(detail, sizeof detail,
                   read->composite ? "\"%.80s\" is more than one value"
                                   : "the summary of a cell has no \"%.80s\"",
                   m->value_name);
    if (errors != NULL) {
        failure_set(failure_add(errors), ST_INVALID, "?value", "unknown_value", read->names,
                    m->value_name, "%s", detail);
    }
    problem_response(res, PROBLEM_BAD_QUERY, detail, errors, NULL);
    free(errors);
}

static void fill_map(struct api_response *res, const struct job_record *job,
                     const struct service_study *progress, const struct study_map *m)
{
    struct json_out out = {0};
    json_object_begin(&out);
    json_key_string(&out, "study", job->id);
    json_key_string(&out, "name", job->name);
    json_key_string(&out, "state", job_state_name(job->state));
    json_key_integer(&out, "pending", progress->n_cell - progress->done - progress->failed);
    study_map_members(&out, m);
    json_object_end(&out);
    respond_json(res, 200, &out);
}

void handle_map(const struct api_call *call, struct api_response *res)
{
    const struct service *s = call->api->service;
    const char *value = api_query_get(call->req, "value");
    struct job_record job;
    struct service_study progress;
    struct map_read read = {.seen = 0};
    if (!study_find(call, res, &job, &progress)) {
        return;
    }
    struct study *study = study_of_job(call, res, job.id);
    if (study == NULL) {
        return;
    }
    struct study_map m = {.value_name = value != NULL ? value : "verdict"};
    study_map_axes(study, &m);
    if (!study_map_init(&m)) {
        problem_response(res, PROBLEM_INTERNAL, status_text(ST_NO_MEMORY), NULL, NULL);
        study_destroy(study);
        return;
    }
    const enum service_status st = read_cells(s, job.id, &m, &read);
    if (st != SERVICE_OK) {
        respond_service(res, st, job.id);
    } else if (read.composite || (read.seen > 0 && read.absent == read.seen)) {
        refuse_value(res, &m, &read);
    } else {
        fill_map(res, &job, &progress, &m);
    }
    study_map_done(&m);
    study_destroy(study);
}
