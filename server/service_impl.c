#include "server/service_impl.h"

#include "api/pack.h"
#include "server/clock.h"
#include "server/id.h"
#include "server/port.h"
#include "server/series_read.h"

#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct service_impl {
    struct service port;
    struct store *store;
    struct writer *writer;
    struct dispatch *dispatch;
    const struct log *log;
    int64_t queue_limit;
    struct id_generator ids; /* writer's thread only */
    atomic_bool stopping;
    atomic_bool disk_low;
};

/* -- writes ----------------------------------------------------------------------------- */

struct submit_request {
    struct write_request base;
    struct service_impl *service;
    service_submit_done done;
    void *arg;
    int n;
    const struct service_submit *item; /* borrowed until `done` */
    struct service_submitted result[];
};

static enum store_status submit_apply(struct write_request *r, struct store_session *s)
{
    struct submit_request *q = (struct submit_request *)r;
    const int64_t now = clock_wall_us();
    enum store_status st = STORE_OK;
    for (int i = 0; st == STORE_OK && i < q->n; i++) {
        char id[JOB_ID_SIZE];
        id_next(&q->service->ids, now, id);
        st = s->ops->submit(s, &q->item[i], id, now, &q->result[i]);
    }
    return st;
}

static void submit_done(struct write_request *r, enum store_status st)
{
    struct submit_request *q = (struct submit_request *)r;
    struct service_impl *s = q->service;
    int created = 0;
    for (int i = 0; st == STORE_OK && i < q->n; i++) {
        created += !q->result[i].reused;
    }
    dispatch_depth_add(s->dispatch, created - q->n); /* all n were counted when they came in */
    if (created > 0) {
        dispatch_ring(s->dispatch);
    }
    q->done(q->arg, port_status(st), st == STORE_OK ? q->n : 0, q->result);
    free(q);
}

static enum service_status refusal(const struct service_impl *s, int n)
{
    if (atomic_load(&s->stopping) || dispatch_depth(s->dispatch) + n > s->queue_limit) {
        return SERVICE_BUSY;
    }
    return atomic_load(&s->disk_low) ? SERVICE_DISK_FULL : SERVICE_OK;
}

static void service_submit(void *ctx, int n, const struct service_submit *item,
                           service_submit_done done, void *arg)
{
    struct service_impl *s = ctx;
    assert(n >= 1);
    const enum service_status refused = refusal(s, n);
    if (refused != SERVICE_OK) {
        LOG(s->log, LOG_LEVEL_WARN, "submit_refused", log_i("status", refused), log_i("jobs", n));
        done(arg, refused, 0, NULL);
        return;
    }
    struct submit_request *q = calloc(1, sizeof *q + (size_t)n * sizeof q->result[0]);
    if (q == NULL) {
        done(arg, SERVICE_ERROR, 0, NULL);
        return;
    }
    q->base = (struct write_request){.apply = submit_apply, .done = submit_done};
    q->service = s;
    q->done = done;
    q->arg = arg;
    q->n = n;
    q->item = item;
    dispatch_depth_add(s->dispatch, n);
    if (!writer_post(s->writer, &q->base)) {
        dispatch_depth_add(s->dispatch, -n);
        free(q);
        done(arg, SERVICE_BUSY, 0, NULL);
    }
}

struct cancel_request {
    struct write_request base;
    struct service_impl *service;
    service_cancel_done done;
    void *arg;
    char id[JOB_ID_SIZE];
    int64_t now;
    struct job_record job;
};

static enum store_status cancel_apply(struct write_request *r, struct store_session *s)
{
    struct cancel_request *q = (struct cancel_request *)r;
    q->now = clock_wall_us();
    return s->ops->cancel(s, q->id, q->now, &q->job);
}

static void cancel_done(struct write_request *r, enum store_status st)
{
    struct cancel_request *q = (struct cancel_request *)r;
    struct dispatch *d = q->service->dispatch;
    if (st == STORE_OK && q->job.state == JOB_CANCELLING) {
        (void)dispatch_cancel(d, q->id, 0);
    }
    if (st == STORE_OK && q->job.state == JOB_CANCELLED && q->job.finished_us == q->now) {
        dispatch_depth_add(d, -1); /* it was still queued: nobody else counts it off */
    }
    q->done(q->arg, port_status(st), st == STORE_OK ? &q->job : NULL);
    free(q);
}

static void service_cancel(void *ctx, const char *id, service_cancel_done done, void *arg)
{
    struct service_impl *s = ctx;
    if (strlen(id) >= JOB_ID_SIZE) {
        done(arg, SERVICE_NOT_FOUND, NULL);
        return;
    }
    struct cancel_request *q = calloc(1, sizeof *q);
    if (q == NULL) {
        done(arg, SERVICE_ERROR, NULL);
        return;
    }
    q->base = (struct write_request){.apply = cancel_apply, .done = cancel_done};
    q->service = s;
    q->done = done;
    q->arg = arg;
    (void)snprintf(q->id, sizeof q->id, "%s", id);
    if (!writer_post(s->writer, &q->base)) {
        free(q);
        done(arg, SERVICE_BUSY, NULL);
    }
}

/* -- reads ------------------------------------------------------------------------------ */

static void add_progress(const struct service_impl *s, struct job_record *job)
{
    if (job->state == JOB_RUNNING || job->state == JOB_CANCELLING) {
        (void)dispatch_progress(s->dispatch, job->id, &job->progress);
    }
}

static enum service_status service_get(void *ctx, const char *id, struct job_record *out)
{
    const struct service_impl *s = ctx;
    struct store_session *r = port_take(s->store, s->log);
    if (r == NULL) {
        return SERVICE_ERROR;
    }
    const enum service_status st = port_give(s->store, s->log, r, r->ops->get(r, id, out));
    if (st == SERVICE_OK) {
        add_progress(s, out);
    }
    return st;
}

static enum service_status service_list(void *ctx, const struct service_filter *filter,
                                        struct job_record **out, int *n, bool *more)
{
    const struct service_impl *s = ctx;
    struct store_session *r = port_take(s->store, s->log);
    if (r == NULL) {
        return SERVICE_ERROR;
    }
    const enum service_status st =
        port_give(s->store, s->log, r, r->ops->list(r, filter, out, n, more));
    for (int i = 0; st == SERVICE_OK && i < *n; i++) {
        add_progress(s, &(*out)[i]);
    }
    return st;
}

static enum service_status service_get_case(void *ctx, const char *id, char **json)
{
    const struct service_impl *s = ctx;
    struct store_session *r = port_take(s->store, s->log);
    return r == NULL ? SERVICE_ERROR
                     : port_give(s->store, s->log, r, r->ops->get_case(r, id, json));
}

static enum service_status service_get_document(void *ctx, const char *id, const char *document,
                                                char **json)
{
    const struct service_impl *s = ctx;
    struct store_session *r = port_take(s->store, s->log);
    return r == NULL ? SERVICE_ERROR
                     : port_give(s->store, s->log, r, r->ops->get_document(r, id, document, json));
}

/* -- studies ---------------------------------------------------------------------------- */

static enum service_status service_get_study(void *ctx, const char *id, struct service_study *out)
{
    const struct service_impl *s = ctx;
    struct store_session *r = port_take(s->store, s->log);
    return r == NULL ? SERVICE_ERROR
                     : port_give(s->store, s->log, r, r->ops->get_study(r, id, out));
}

/* Cells with their summaries unpacked; false when one is damaged, or memory ran out. */
static bool unpack_cells(const struct store_cell_row *row, int n, struct service_cell *out)
{
    bool ok = true;
    for (int i = 0; i < n; i++) {
        out[i] = row[i].cell;
        if (row[i].packed != NULL) {
            out[i].summary = unpack_text(row[i].packed, row[i].packed_size, row[i].size);
            ok = ok && out[i].summary != NULL;
        }
    }
    return ok;
}

static enum service_status service_get_cells(void *ctx, const char *id, int from, int limit,
                                             bool summaries, struct service_cell **out, int *n)
{
    const struct service_impl *s = ctx;
    struct store_session *r = port_take(s->store, s->log);
    if (r == NULL) {
        return SERVICE_ERROR;
    }
    struct store_cell_row *row = NULL;
    int count = 0;
    const enum service_status st = port_give(
        s->store, s->log, r, r->ops->get_cells(r, id, from, limit, summaries, &row, &count));
    if (st != SERVICE_OK) {
        return st;
    }
    struct service_cell *cell = calloc((size_t)count + 1, sizeof *cell);
    const bool ok = cell != NULL && unpack_cells(row, count, cell);
    for (int i = 0; i < count; i++) {
        free(row[i].packed);
    }
    free(row);
    if (!ok) {
        LOG(s->log, LOG_LEVEL_ERROR, "read_failed",
            log_s("message", "a summary cannot be unpacked"));
        service_cells_done(cell, cell != NULL ? count : 0);
        free(cell);
        return SERVICE_ERROR;
    }
    *out = cell;
    *n = count;
    return SERVICE_OK;
}

/* -- series ----------------------------------------------------------------------------- */

static enum service_status service_get_series(void *ctx, const char *id, int n_channel,
                                              const char *const *channel, double from_s,
                                              double to_s, struct series_data *out,
                                              int *bad_channel)
{
    const struct service_impl *s = ctx;
    const struct series_ask ask = {id, n_channel, channel, from_s, to_s};
    *bad_channel = -1;
    struct store_session *r = port_take(s->store, s->log);
    return r == NULL ? SERVICE_ERROR
                     : port_give(s->store, s->log, r, series_read(r, &ask, out, bad_channel));
}

static enum service_status service_get_columns(void *ctx, const char *id, char (**out)[64], int *n)
{
    const struct service_impl *s = ctx;
    struct store_session *r = port_take(s->store, s->log);
    if (r == NULL) {
        return SERVICE_ERROR;
    }
    struct series_data data = {.n = 0};
    const enum service_status st = port_give(s->store, s->log, r, r->ops->get_series(r, id, &data));
    if (st != SERVICE_OK) {
        return st;
    }
    char(*names)[64] = calloc((size_t)data.n_column + 1, sizeof *names);
    for (int j = 0; names != NULL && j < data.n_column; j++) {
        memcpy(names[j], data.column[j].name, sizeof names[j]);
    }
    const int count = data.n_column;
    series_data_done(&data);
    if (names == NULL) {
        return SERVICE_ERROR;
    }
    *out = names;
    *n = count;
    return SERVICE_OK;
}

/* -- life ------------------------------------------------------------------------------- */

static bool service_ready(void *ctx, const char **why)
{
    const struct service_impl *s = ctx;
    *why = "";
    if (atomic_load(&s->stopping)) {
        *why = "the daemon is stopping";
    } else if (atomic_load(&s->disk_low)) {
        *why = "the disk is nearly full";
    } else if (dispatch_depth(s->dispatch) >= s->queue_limit) {
        *why = "the queue is full";
    }
    return (*why)[0] == '\0';
}

struct service_impl *service_impl_create(struct store *st, struct writer *writer,
                                         struct dispatch *dispatch, const struct log *log,
                                         int64_t queue_limit)
{
    struct service_impl *s = calloc(1, sizeof *s);
    if (s == NULL) {
        return NULL;
    }
    s->port = (struct service){.ctx = s,
                               .submit = service_submit,
                               .cancel = service_cancel,
                               .get = service_get,
                               .list = service_list,
                               .get_case = service_get_case,
                               .get_document = service_get_document,
                               .get_series = service_get_series,
                               .get_columns = service_get_columns,
                               .get_study = service_get_study,
                               .get_cells = service_get_cells,
                               .ready = service_ready};
    s->store = st;
    s->writer = writer;
    s->dispatch = dispatch;
    s->log = log;
    s->queue_limit = queue_limit;
    char newest[JOB_ID_SIZE] = "";
    struct store_session *r = port_take(s->store, s->log);
    if (r == NULL || port_give(s->store, s->log, r, r->ops->newest_id(r, newest)) != SERVICE_OK) {
        free(s);
        return NULL;
    }
    if (newest[0] != '\0' && !id_continue(&s->ids, newest)) {
        LOG(log, LOG_LEVEL_WARN, "unexpected_id", log_s("id", newest));
    }
    return s;
}

void service_impl_destroy(struct service_impl *s)
{
    free(s);
}

const struct service *service_impl_port(const struct service_impl *s)
{
    return &s->port;
}

void service_impl_disk_low(struct service_impl *s, bool low)
{
    if (atomic_exchange(&s->disk_low, low) != low) {
        LOG(s->log, LOG_LEVEL_WARN, "disk", log_s("state", low ? "nearly full" : "ok"));
    }
}

void service_impl_stop(struct service_impl *s)
{
    atomic_store(&s->stopping, true);
}
