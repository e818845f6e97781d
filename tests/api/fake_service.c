#include "tests/api/fake_service.h"
#include "tests/api/fake_study.h"

#include "api/text.h"

#include <assert.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The fake itself never runs out of memory: a test that makes one allocation fail (test_alloc.c)
 * means those of the contract. */
static void *need(size_t n, size_t size)
{
    void *p = calloc(n, size);
    return p != NULL ? p : calloc(n, size);
}

static char *need_text(const char *text)
{
    char *copy = need(strlen(text) + 1, 1);
    memcpy(copy, text, strlen(text) + 1);
    return copy;
}

static struct fake_job *find(struct fake *f, const char *id)
{
    for (int i = 0; i < f->n_job; i++) {
        if (strcmp(f->job[i].record.id, id) == 0) {
            return &f->job[i];
        }
    }
    return NULL;
}

struct fake_job *fake_add(struct fake *f, int kind, enum job_state state, const char *name)
{
    assert(f->n_job < FAKE_JOBS_MAX);
    struct fake_job *job = &f->job[f->n_job];
    job->record = (struct job_record){.kind = kind,
                                      .state = state,
                                      .progress = state == JOB_DONE ? 1.0 : 0.0,
                                      .created_us = 1700000000000000 + f->n_job};
    (void)snprintf(job->record.id, sizeof job->record.id, "00000000-0000-7000-8000-%012x",
                   f->n_job);
    (void)snprintf(job->record.name, sizeof job->record.name, "%s", name);
    f->n_job++;
    return job;
}

static void fake_submit(void *ctx, int n, const struct service_submit *item,
                        service_submit_done done, void *arg)
{
    struct fake *f = ctx;
    if (f->refuse != SERVICE_OK) {
        done(arg, f->refuse, 0, NULL);
        return;
    }
    struct service_submitted *result = need((size_t)n, sizeof *result);
    for (int i = 0; i < n; i++) {
        struct fake_job *job = NULL;
        for (int j = 0; j < f->n_job; j++) {
            if (strcmp(f->job[j].record.content_hash, item[i].content_hash) == 0) {
                job = &f->job[j];
            }
        }
        result[i].reused = job != NULL;
        if (job == NULL) {
            job = fake_add(f, item[i].kind, JOB_QUEUED, item[i].name);
            job->case_json = need_text(item[i].case_json);
            (void)snprintf(job->record.content_hash, sizeof job->record.content_hash, "%s",
                           item[i].content_hash);
        }
        (void)snprintf(result[i].id, sizeof result[i].id, "%s", job->record.id);
        result[i].state = job->record.state;
    }
    done(arg, SERVICE_OK, n, result);
    free(result);
}

static void fake_cancel(void *ctx, const char *id, service_cancel_done done, void *arg)
{
    struct fake *f = ctx;
    struct fake_job *job = find(f, id);
    if (f->refuse != SERVICE_OK || job == NULL) {
        done(arg, f->refuse != SERVICE_OK ? f->refuse : SERVICE_NOT_FOUND, NULL);
        return;
    }
    if (job->record.state == JOB_QUEUED) {
        job->record.state = JOB_CANCELLED;
    }
    done(arg, SERVICE_OK, &job->record);
}

static enum service_status fake_get_job(void *ctx, const char *id, struct job_record *out)
{
    const struct fake_job *job = find(ctx, id);
    if (job == NULL) {
        return SERVICE_NOT_FOUND;
    }
    *out = job->record;
    return SERVICE_OK;
}

static bool passes(const struct service_filter *filter, const struct job_record *job)
{
    return (filter->kind < 0 || filter->kind == (int)job->kind) &&
           (filter->state < 0 || filter->state == (int)job->state) &&
           (filter->name == NULL || strcmp(filter->name, job->name) == 0) &&
           (filter->after == NULL || strcmp(job->id, filter->after) < 0);
}

static enum service_status fake_list(void *ctx, const struct service_filter *filter,
                                     struct job_record **out, int *n, bool *more)
{
    struct fake *f = ctx;
    *out = need((size_t)filter->limit, sizeof **out);
    *n = 0;
    *more = false;
    for (int i = f->n_job - 1; i >= 0; i--) {
        if (!passes(filter, &f->job[i].record)) {
            continue;
        }
        if (*n == filter->limit) {
            *more = true;
            break;
        }
        (*out)[(*n)++] = f->job[i].record;
    }
    return SERVICE_OK;
}

static enum service_status fake_get_case(void *ctx, const char *id, char **json)
{
    const struct fake_job *job = find(ctx, id);
    if (job == NULL || job->case_json == NULL) {
        return SERVICE_NOT_FOUND;
    }
    *json = need_text(job->case_json);
    return SERVICE_OK;
}

static enum service_status fake_get_document(void *ctx, const char *id, const char *document,
                                             char **json)
{
    char text[160];
    (void)ctx;
    (void)snprintf(text, sizeof text, "{\"document\":\"%s\",\"of\":\"%s\"}", document, id);
    *json = need_text(text);
    return SERVICE_OK;
}

/* Two columns of FAKE_SAMPLES samples 1 ms apart: a ramp, and a sine with one spike. */
static const char *const columns[] = {"tip_plunge_m", "modal_amplitude[1]"};
enum { N_COLUMN = 2 };

static bool named(const char *column, const char *name)
{
    const size_t n = strcspn(column, "[");
    return strcmp(column, name) == 0 || (strlen(name) == n && strncmp(column, name, n) == 0);
}

static double sample(int column, int i)
{
    return column == 0 ? 0.001 * i : (i == 501 ? 7.0 : sin(0.01 * i));
}

static void fill(struct series_data *out, int column, int first)
{
    struct series_column *c = &out->column[out->n_column++];
    (void)snprintf(c->name, sizeof c->name, "%s", columns[column]);
    c->value = need((size_t)(out->n > 0 ? out->n : 1), sizeof *c->value);
    for (int i = 0; i < out->n; i++) {
        c->value[i] = sample(column, first + i);
    }
}

static enum service_status fake_get_series(void *ctx, const char *id, int n_channel,
                                           const char *const *channel, double from_s, double to_s,
                                           struct series_data *out, int *bad_channel)
{
    (void)ctx;
    (void)id;
    *bad_channel = -1;
    for (int i = 0; i < n_channel; i++) {
        if (!named(columns[0], channel[i]) && !named(columns[1], channel[i])) {
            *bad_channel = i;
            return SERVICE_NOT_FOUND;
        }
    }
    int first = 0, last = FAKE_SAMPLES - 1;
    while (first <= last && first * 1e-3 < from_s) {
        first++;
    }
    while (last >= first && last * 1e-3 > to_s) {
        last--;
    }
    *out = (struct series_data){.t0 = first * 1e-3, .step = 1e-3, .n = last - first + 1};
    out->column = need(N_COLUMN, sizeof *out->column);
    for (int c = 0; c < N_COLUMN; c++) {
        bool wanted = n_channel == 0;
        for (int i = 0; i < n_channel; i++) {
            wanted = wanted || named(columns[c], channel[i]);
        }
        if (wanted) {
            fill(out, c, first);
        }
    }
    return SERVICE_OK;
}

static enum service_status fake_get_columns(void *ctx, const char *id, char (**out)[64], int *n)
{
    (void)ctx;
    (void)id;
    *out = need(N_COLUMN, sizeof **out);
    for (int i = 0; i < N_COLUMN; i++) {
        (void)snprintf((*out)[i], sizeof **out, "%s", columns[i]);
    }
    *n = N_COLUMN;
    return SERVICE_OK;
}

/* -- shelf -- */

static int newest(const struct fake *f, enum shelf_kind kind, const char *name)
{
    int version = 0;
    for (int i = 0; i < f->n_entry; i++) {
        const struct shelf_entry *e = &f->entry[i].entry;
        if (f->entry[i].kind == kind && strcmp(e->name, name) == 0 && e->version > version) {
            version = e->version;
        }
    }
    return version;
}

static struct shelf_entry copy_of(const struct shelf_entry *e, bool data)
{
    struct shelf_entry out = *e;
    out.head = need_text(e->head);
    out.data = data ? need(e->size + 1, 1) : NULL;
    if (data) {
        memcpy(out.data, e->data, e->size);
    }
    return out;
}

static void fake_put(void *ctx, const struct shelf_item *item, shelf_put_done done, void *arg)
{
    struct fake *f = ctx;
    if (f->refuse != SERVICE_OK) {
        done(arg, f->refuse, 0, false);
        return;
    }
    for (int i = 0; i < f->n_entry; i++) {
        const struct shelf_entry *e = &f->entry[i].entry;
        if (f->entry[i].kind == item->kind && strcmp(e->name, item->name) == 0 &&
            strcmp(e->hash, item->hash) == 0) {
            done(arg, SERVICE_OK, e->version, true);
            return;
        }
    }
    assert(f->n_entry < FAKE_ENTRIES_MAX);
    struct shelf_entry e = {.version = newest(f, item->kind, item->name) + 1,
                            .created_us = 1700000000000000,
                            .head = (char *)(uintptr_t)item->head,
                            .data = (void *)(uintptr_t)item->data,
                            .size = item->size};
    (void)snprintf(e.name, sizeof e.name, "%s", item->name);
    (void)snprintf(e.hash, sizeof e.hash, "%s", item->hash);
    f->entry[f->n_entry].kind = item->kind;
    f->entry[f->n_entry++].entry = copy_of(&e, true);
    done(arg, SERVICE_OK, e.version, false);
}

static void fake_drop(void *ctx, enum shelf_kind kind, const char *name, int version,
                      shelf_drop_done done, void *arg)
{
    struct fake *f = ctx;
    int kept = 0;
    if (f->in_use) {
        done(arg, SERVICE_NOT_READY);
        return;
    }
    for (int i = 0; i < f->n_entry; i++) {
        struct fake_entry *e = &f->entry[i];
        if (e->kind == kind && strcmp(e->entry.name, name) == 0 &&
            (version == 0 || version == e->entry.version)) {
            shelf_entry_done(&e->entry);
        } else {
            f->entry[kept++] = *e;
        }
    }
    const bool found = kept < f->n_entry;
    f->n_entry = kept;
    done(arg, found ? SERVICE_OK : SERVICE_NOT_FOUND);
}

static enum service_status fake_entries(void *ctx, enum shelf_kind kind, struct shelf_entry **out,
                                        int *n)
{
    const struct fake *f = ctx;
    *out = need(FAKE_ENTRIES_MAX, sizeof **out);
    *n = 0;
    for (int i = 0; i < f->n_entry; i++) {
        if (f->entry[i].kind == kind) {
            (*out)[(*n)++] = copy_of(&f->entry[i].entry, false);
        }
    }
    return SERVICE_OK;
}

static enum service_status fake_entry(void *ctx, enum shelf_kind kind, const char *name,
                                      int version, struct shelf_entry *out)
{
    const struct fake *f = ctx;
    const int wanted = version != 0 ? version : newest(f, kind, name);
    for (int i = 0; i < f->n_entry; i++) {
        const struct shelf_entry *e = &f->entry[i].entry;
        if (f->entry[i].kind == kind && strcmp(e->name, name) == 0 && e->version == wanted) {
            *out = copy_of(e, true);
            return SERVICE_OK;
        }
    }
    return SERVICE_NOT_FOUND;
}

static enum service_status fake_get_study(void *ctx, const char *id, struct service_study *out)
{
    const struct fake_job *job = find(ctx, id);
    if (job == NULL || job->record.kind != JOB_STUDY) {
        return SERVICE_NOT_FOUND;
    }
    *out = fake_study_progress();
    return SERVICE_OK;
}

static bool fake_ready(void *ctx, const char **why)
{
    const struct fake *f = ctx;
    *why = "the store is closed";
    return !f->not_ready;
}

static void take_answer(struct api_reply *reply, struct api_response *response)
{
    struct fake *f = (struct fake *)((char *)reply - offsetof(struct fake, reply));
    f->n_sent++;
    f->answer = *response;
    response->body = NULL;
}

struct fake *fake_create(void)
{
    struct failure fail;
    struct fake *f = need(1, sizeof *f);
    f->service = (struct service){.ctx = f,
                                  .submit = fake_submit,
                                  .cancel = fake_cancel,
                                  .get = fake_get_job,
                                  .list = fake_list,
                                  .get_case = fake_get_case,
                                  .get_document = fake_get_document,
                                  .get_series = fake_get_series,
                                  .get_columns = fake_get_columns,
                                  .get_study = fake_get_study,
                                  .get_cells = fake_get_cells,
                                  .ready = fake_ready};
    if (library_create_builtin(&f->library, &fail) != ST_OK) {
        (void)fprintf(stderr, "%s\n", fail.detail);
        abort();
    }
    f->shelf = (struct shelf){
        .ctx = f, .put = fake_put, .drop = fake_drop, .list = fake_entries, .get = fake_entry};
    library_attach(f->library, &f->shelf);
    f->api = (struct api){.library = f->library, .service = &f->service, .shelf = &f->shelf};
    f->reply.send = take_answer;
    return f;
}

void fake_reset(struct fake *f)
{
    for (int i = 0; i < f->n_job; i++) {
        free(f->job[i].case_json);
        f->job[i] = (struct fake_job){0};
    }
    f->n_job = 0;
    for (int i = 0; i < f->n_entry; i++) {
        shelf_entry_done(&f->entry[i].entry);
    }
    f->n_entry = 0;
}

void fake_destroy(struct fake *f)
{
    fake_reset(f);
    api_response_done(&f->answer);
    library_destroy(f->library);
    free(f);
}

/* Decodes one text into `*space` and moves it on; "" when it cannot be decoded or does not fit. */
static const char *take_text(const char *text, size_t n, char **space, size_t *size)
{
    char *out = *space;
    if (*size == 0 || !text_percent_decode(text, n, *size, out)) {
        return "";
    }
    const size_t used = strlen(out) + 1;
    *space += used;
    *size -= used;
    return out;
}

/* Cuts "a=1&b" into decoded keys and values; all text lives in `space`. */
static void parse_query(const char *query, char *space, size_t size, struct api_request *req)
{
    while (*query != '\0' && req->n_query < API_QUERY_MAX) {
        const size_t whole = strcspn(query, "&");
        const size_t key = strcspn(query, "=&");
        const size_t value = key < whole ? key + 1 : whole;
        struct api_query *q = &req->query[req->n_query++];
        q->key = take_text(query, key, &space, &size);
        q->value = take_text(query + value, whole - value, &space, &size);
        query += whole + (query[whole] == '&' ? 1 : 0);
    }
}

static int send_request(struct fake *f, struct api_request *req, const char *target)
{
    char path[1024];
    char space[2048];
    const size_t n = strcspn(target, "?");
    (void)snprintf(path, sizeof path, "%.*s", (int)n, target);
    parse_query(target[n] == '?' ? target + n + 1 : "", space, sizeof space, req);
    req->path = path;
    api_response_done(&f->answer);
    f->n_sent = 0;
    router_handle(&f->api, req, &f->reply);
    assert(f->n_sent == 1);
    return f->answer.status;
}

int fake_send(struct fake *f, const char *method, const char *target, const char *content_type,
              const char *body, size_t body_size)
{
    struct api_request req = {
        .method = method, .content_type = content_type, .body = body, .body_size = body_size};
    return send_request(f, &req, target);
}

int fake_request(struct fake *f, const char *method, const char *target, const char *content_type,
                 const char *body)
{
    return fake_send(f, method, target, content_type, body, body != NULL ? strlen(body) : 0);
}

int fake_get(struct fake *f, const char *target)
{
    return fake_request(f, "GET", target, NULL, NULL);
}

int fake_get_with(struct fake *f, const char *target, const char *accept, const char *etag)
{
    struct api_request req = {.method = "GET", .accept = accept, .if_none_match = etag};
    return send_request(f, &req, target);
}

int fake_post(struct fake *f, const char *body)
{
    return fake_request(f, "POST", "/v1/jobs", "application/json", body);
}

const char *fake_header(const struct fake *f, const char *name)
{
    for (int i = 0; i < f->answer.n_header; i++) {
        if (strcmp(f->answer.header[i].name, name) == 0) {
            return f->answer.header[i].value;
        }
    }
    return NULL;
}

bool fake_says(const struct fake *f, const char *text)
{
    return f->answer.body != NULL && strstr(f->answer.body, text) != NULL;
}
