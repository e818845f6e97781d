/* POST /v1/jobs: one case, a study, or a batch of cases that is taken whole or not at all; POST
 * /v1/studies: a study. */
#include "api/case.h"
#include "api/json.h"
#include "api/reader.h"
#include "api/respond.h"
#include "api/study.h"

#include <assert.h>
#include <cjson/cJSON.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { BATCH_MAX = 1000, CASE_BODY_MAX = 1 << 20 };

/* What of a case goes to storage. A whole one takes 100 kB and more, and a batch has a thousand. */
struct kept {
    char *canonical;
    char name[sizeof((struct case_def *)0)->name];
    char hash[LIMIT_HASH];
};

/* Cases on their way to storage: lives from the request to the service's answer. */
struct submission {
    struct api_reply *reply;
    bool batch;
    int n; /* cases parsed */
    struct kept *kept;
    struct service_submit *item;
};

static void submission_destroy(struct submission *s)
{
    for (int i = 0; i < s->n; i++) {
        free(s->kept[i].canonical);
    }
    free(s->kept);
    free(s->item);
    free(s);
}

static struct submission *submission_create(struct api_reply *reply, int n, bool batch)
{
    struct submission *s = calloc(1, sizeof *s);
    if (s == NULL) {
        return NULL;
    }
    *s = (struct submission){.reply = reply, .batch = batch};
    s->kept = calloc((size_t)n, sizeof *s->kept);
    s->item = calloc((size_t)n, sizeof *s->item);
    if (s->kept == NULL || s->item == NULL) {
        submission_destroy(s);
        return NULL;
    }
    return s;
}

static void write_submitted(struct json_out *out, const struct service_submit *item,
                            const struct service_submitted *r)
{
    char path[64];
    (void)snprintf(path, sizeof path, "/v1/jobs/%s", r->id);
    json_object_begin(out);
    json_key_string(out, "id", r->id);
    json_key_string(out, "state", job_state_name(r->state));
    json_key(out, "reused");
    json_boolean(out, r->reused);
    json_key_string(out, "kind", job_kind_name(item->kind));
    json_key_string(out, "name", item->name);
    json_key_string(out, "content_hash", item->content_hash);
    json_key(out, "links");
    json_object_begin(out);
    json_key_string(out, "self", path);
    json_object_end(out);
    json_object_end(out);
}

static void fill_accepted(struct api_response *res, const struct submission *s,
                          const struct service_submitted *result)
{
    struct json_out out = {0};
    bool all_reused = true;
    if (s->batch) {
        json_object_begin(&out);
        json_key(&out, "jobs");
        json_array_begin(&out);
    }
    for (int i = 0; i < s->n; i++) {
        all_reused = all_reused && result[i].reused;
        write_submitted(&out, &s->item[i], &result[i]);
    }
    if (s->batch) {
        json_array_end(&out);
        json_object_end(&out);
    } else {
        api_response_header(res, "Location", "/v1/jobs/%s", result[0].id);
    }
    respond_json(res, all_reused ? 200 : 202, &out);
}

static void submit_done(void *arg, enum service_status status, int n,
                        const struct service_submitted *result)
{
    struct submission *s = arg;
    struct api_response res = {0};
    if (status == SERVICE_OK) {
        assert(n == s->n);
        fill_accepted(&res, s, result);
    } else {
        respond_service(&res, status, "");
    }
    s->reply->send(s->reply, &res);
    submission_destroy(s);
}

static void add_case(struct submission *s, struct api_case *c)
{
    const struct case_def *def = api_case_def(c);
    struct kept *k = &s->kept[s->n];
    (void)snprintf(k->name, sizeof k->name, "%s", def->name);
    (void)snprintf(k->hash, sizeof k->hash, "%s", api_case_hash(c));
    k->canonical = api_case_take_canonical(c);
    s->item[s->n] = (struct service_submit){
        .kind = def->kind, .name = k->name, .case_json = k->canonical, .content_hash = k->hash};
    s->n++;
    api_case_destroy(c);
}

/* The "jobs" of a batch, checked; NULL when it is none that can be read (reported). */
static const cJSON *batch_list(struct reader *r, const cJSON *tree)
{
    const cJSON *jobs = NULL;
    for (const cJSON *c = tree->child; c != NULL; c = c->next) {
        const size_t mark = reader_enter_key(r, c->string);
        const int n = cJSON_IsArray(c) ? cJSON_GetArraySize(c) : -1;
        if (strcmp(c->string, "jobs") != 0) {
            reader_problem(r, "unknown_key", "\"jobs\"", c, "a batch has no such key");
        } else if (n < 0) {
            reader_problem(r, "wrong_type", "an array of cases", c, "the value must be an array");
        } else if (n == 0 || n > BATCH_MAX) {
            reader_problem(r, n == 0 ? "empty_list" : "wrong_length", "1 to 1000 cases", c,
                           "the list has %d entries", n);
        } else {
            jobs = c;
        }
        reader_leave(r, mark);
    }
    return jobs;
}

/* Parses every case of the tree; NULL when out of memory. Problems go to the list. */
static struct submission *parse_cases(const struct api_call *call, const cJSON *tree,
                                      struct failure_list *problems)
{
    struct reader r;
    reader_init(&r, "", problems);
    json_check(&r, tree);
    const bool batch = cJSON_GetObjectItemCaseSensitive(tree, "jobs") != NULL;
    const cJSON *jobs = batch ? batch_list(&r, tree) : NULL;
    const int n = jobs != NULL ? cJSON_GetArraySize(jobs) : 1;
    struct submission *s = submission_create(call->reply, n, batch);
    const cJSON *item = batch ? (jobs != NULL ? jobs->child : NULL) : tree;
    for (int i = 0; s != NULL && i < n && item != NULL; i++) {
        char prefix[32] = "";
        struct api_case *c = NULL;
        if (batch) {
            (void)snprintf(prefix, sizeof prefix, "/jobs/%d", i);
        }
        if (api_case_from_tree(call->api->library, item, prefix, &c, problems) == ST_OK) {
            add_case(s, c);
        }
        item = batch ? item->next : NULL;
    }
    return s;
}

/* The tree of the body; NULL when the answer is given. */
static cJSON *read_body(const struct api_call *call, struct api_response *res)
{
    cJSON *tree = NULL;
    struct failure fail;
    if (!respond_is_json(call, res) ||
        json_parse(call->req->body, call->req->body_size, &tree, &fail) == ST_OK) {
        return tree;
    }
    struct failure_list *problems = calloc(1, sizeof *problems);
    if (problems != NULL) {
        *failure_add(problems) = fail;
        respond_refuse(res, fail.status == ST_INVALID ? PROBLEM_MALFORMED_JSON : PROBLEM_INTERNAL,
                       problems);
    } else {
        problem_response(res, PROBLEM_INTERNAL, status_text(ST_NO_MEMORY), NULL, NULL);
    }
    free(problems);
    return NULL;
}

static void submit_cases(const struct api_call *call, const cJSON *tree,
                         struct failure_list *problems, struct api_response *res)
{
    const struct service *service = call->api->service;
    struct submission *s = parse_cases(call, tree, problems);
    if (s == NULL || reader_ran_out_of_memory(problems)) {
        problem_response(res, PROBLEM_INTERNAL, status_text(ST_NO_MEMORY), NULL, NULL);
    } else if (!s->batch && call->req->body_size > CASE_BODY_MAX) {
        problem_response(res, PROBLEM_TOO_LARGE, "one case may have 1 MiB; a batch 16 MiB", NULL,
                         NULL);
    } else if (problems->total > 0) {
        respond_refuse(res, PROBLEM_INVALID_CASE, problems);
    } else {
        service->submit(service->ctx, s->n, s->item, submit_done, s);
        s = NULL; /* submit_done has it, perhaps has freed it */
    }
    if (s != NULL) {
        submission_destroy(s);
    }
}

static void submit_study(const struct api_call *call, const cJSON *tree,
                         struct failure_list *problems, struct api_response *res)
{
    struct study *study = NULL;
    struct reader r;
    reader_init(&r, "", problems);
    json_check(&r, tree);
    enum status st = ST_INVALID;
    if (problems->total == 0) {
        st = study_from_tree(call->api->library, tree, &study, problems);
    }
    if (st == ST_OK) {
        study_submit(call, study, res);
        study_destroy(study);
    } else if (st == ST_NO_MEMORY || reader_ran_out_of_memory(problems)) {
        problem_response(res, PROBLEM_INTERNAL, status_text(ST_NO_MEMORY), NULL, NULL);
    } else {
        respond_refuse(res, PROBLEM_INVALID_CASE, problems);
    }
}

static void submit(const struct api_call *call, struct api_response *res, bool only_study)
{
    cJSON *tree = read_body(call, res);
    if (tree == NULL) {
        return;
    }
    struct failure_list *problems = calloc(1, sizeof *problems);
    if (problems == NULL) {
        problem_response(res, PROBLEM_INTERNAL, status_text(ST_NO_MEMORY), NULL, NULL);
    } else if (only_study || study_is_one(tree)) {
        submit_study(call, tree, problems, res);
    } else {
        submit_cases(call, tree, problems, res);
    }
    free(problems);
    json_free(tree);
}

void handle_submit(const struct api_call *call, struct api_response *res)
{
    submit(call, res, false);
}

void handle_study_submit(const struct api_call *call, struct api_response *res)
{
    submit(call, res, true);
}
