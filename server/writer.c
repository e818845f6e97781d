#include "server/writer.h"

#include <assert.h>
#include <errno.h>
#include <pthread.h>
#include <stdlib.h>
#include <time.h>

struct write_waiter {
    pthread_mutex_t mutex; /* guards finished, status */
    pthread_cond_t cond;
    bool finished;
    enum store_status status;
};

struct writer {
    struct store *store;
    const struct log *log;
    pthread_t thread;
    pthread_mutex_t mutex; /* guards the queue, stopping and stats */
    pthread_cond_t work;
    struct write_request *head, **tail;
    bool stopping;
    struct writer_stats stats;
};

static void finish(struct write_request *r)
{
    /* After `done` the request may be gone; the waiter lives on the caller's stack. */
    struct write_waiter *waiter = r->waiter;
    const enum store_status st = r->status;
    if (r->done != NULL) {
        r->done(r, st);
    }
    if (waiter != NULL) {
        (void)pthread_mutex_lock(&waiter->mutex);
        waiter->status = st;
        waiter->finished = true;
        (void)pthread_cond_signal(&waiter->cond);
        (void)pthread_mutex_unlock(&waiter->mutex);
    }
}

/* Applies one request in its savepoint. False when the transaction itself is lost. */
static bool apply_one(struct store_session *s, struct write_request *r)
{
    r->status = s->ops->mark(s);
    if (r->status != STORE_OK) {
        return false;
    }
    r->status = r->apply(r, s);
    if (!s->ops->in_transaction(s)) {
        return false;
    }
    const enum store_status st = r->status == STORE_OK ? s->ops->release(s) : s->ops->undo(s);
    if (st != STORE_OK) {
        r->status = st;
        return false;
    }
    return true;
}

/* One transaction over the first n requests. Not STORE_OK: none of them is stored. */
static enum store_status run_group(struct store_session *s, struct write_request *group, int n)
{
    enum store_status st = s->ops->begin(s);
    bool intact = st == STORE_OK;
    for (struct write_request *r = group; intact && n > 0; r = r->next, n--) {
        intact = apply_one(s, r);
        st = intact ? STORE_OK : (r->status == STORE_OK ? STORE_ERROR : r->status);
    }
    if (st == STORE_OK) {
        st = s->ops->commit(s);
    }
    if (st != STORE_OK) {
        s->ops->rollback(s);
    }
    return st;
}

static void report(const struct writer *w, struct store_session *s, enum store_status st)
{
    LOG(w->log, LOG_LEVEL_ERROR, "write_failed", log_i("status", st),
        log_s("message", s->ops->message(s)));
}

static void commit_group(struct writer *w, struct write_request *group, int n)
{
    struct store_session *s = w->store->ops->writer(w->store);
    enum store_status st = run_group(s, group, n);
    if (st == STORE_OK) {
        return;
    }
    if (n > 1) {
        (void)pthread_mutex_lock(&w->mutex);
        w->stats.retries++;
        (void)pthread_mutex_unlock(&w->mutex);
    }
    for (struct write_request *r = group; r != NULL; r = r->next) {
        st = run_group(s, r, 1);
        if (st != STORE_OK) {
            report(w, s, st);
            r->status = st;
        }
    }
}

/* Waits for work; an idle second is used to tidy the log. Takes up to a group off the queue;
 * NULL when stopping and everything is done. */
static struct write_request *next_group(struct writer *w, int *n, bool *idle)
{
    (void)pthread_mutex_lock(&w->mutex);
    *idle = false;
    while (w->head == NULL && !w->stopping && !*idle) {
        struct timespec until;
        (void)clock_gettime(CLOCK_MONOTONIC, &until);
        until.tv_sec += 1;
        *idle = pthread_cond_timedwait(&w->work, &w->mutex, &until) == ETIMEDOUT;
    }
    struct write_request *group = w->head;
    struct write_request **end = &w->head;
    *n = 0;
    while (*end != NULL && *n < WRITER_GROUP_MAX) {
        end = &(*end)->next;
        ++*n;
    }
    w->head = *end;
    *end = NULL;
    if (*n > 0) {
        *idle = false;
        w->stats.requests += *n;
        w->stats.commits++;
    }
    if (w->head == NULL) {
        w->tail = &w->head;
    }
    (void)pthread_mutex_unlock(&w->mutex);
    return *n > 0 ? group : NULL;
}

static void tidy(struct writer *w, enum store_tidy when)
{
    struct store_session *s = w->store->ops->writer(w->store);
    const enum store_status st = s->ops->checkpoint(s, when);
    if (st != STORE_OK) {
        report(w, s, st);
    }
}

static void *writer_main(void *arg)
{
    struct writer *w = arg;
    for (;;) {
        int n = 0;
        bool idle = false;
        struct write_request *group = next_group(w, &n, &idle);
        if (group == NULL && !idle) {
            break;
        }
        if (group != NULL) {
            commit_group(w, group, n);
        }
        while (group != NULL) {
            struct write_request *r = group;
            group = r->next;
            finish(r);
        }
        tidy(w, idle ? STORE_TIDY_IDLE : STORE_TIDY_BUSY);
    }
    tidy(w, STORE_TIDY_CLOSE);
    return NULL;
}

enum store_status writer_create(struct store *st, const struct log *log, struct writer **out)
{
    struct writer *w = calloc(1, sizeof *w);
    if (w == NULL) {
        return STORE_ERROR;
    }
    w->store = st;
    w->log = log;
    w->tail = &w->head;
    (void)pthread_mutex_init(&w->mutex, NULL);
    pthread_condattr_t attr;
    (void)pthread_condattr_init(&attr);
    (void)pthread_condattr_setclock(&attr, CLOCK_MONOTONIC);
    (void)pthread_cond_init(&w->work, &attr);
    (void)pthread_condattr_destroy(&attr);
    if (pthread_create(&w->thread, NULL, writer_main, w) != 0) {
        (void)pthread_cond_destroy(&w->work);
        (void)pthread_mutex_destroy(&w->mutex);
        free(w);
        return STORE_ERROR;
    }
    *out = w;
    return STORE_OK;
}

bool writer_post(struct writer *w, struct write_request *r)
{
    assert(r->apply != NULL);
    r->next = NULL;
    (void)pthread_mutex_lock(&w->mutex);
    const bool accepted = !w->stopping;
    if (accepted) {
        *w->tail = r;
        w->tail = &r->next;
        (void)pthread_cond_signal(&w->work);
    }
    (void)pthread_mutex_unlock(&w->mutex);
    return accepted;
}

enum store_status writer_call(struct writer *w, struct write_request *r)
{
    struct write_waiter waiter = {.status = STORE_ERROR};
    (void)pthread_mutex_init(&waiter.mutex, NULL);
    (void)pthread_cond_init(&waiter.cond, NULL);
    r->waiter = &waiter;
    if (writer_post(w, r)) {
        (void)pthread_mutex_lock(&waiter.mutex);
        while (!waiter.finished) {
            (void)pthread_cond_wait(&waiter.cond, &waiter.mutex);
        }
        (void)pthread_mutex_unlock(&waiter.mutex);
    }
    (void)pthread_cond_destroy(&waiter.cond);
    (void)pthread_mutex_destroy(&waiter.mutex);
    return waiter.status;
}

void writer_stats(struct writer *w, struct writer_stats *out)
{
    (void)pthread_mutex_lock(&w->mutex);
    *out = w->stats;
    (void)pthread_mutex_unlock(&w->mutex);
}

void writer_stop(struct writer *w)
{
    if (w == NULL) {
        return;
    }
    (void)pthread_mutex_lock(&w->mutex);
    const bool already = w->stopping;
    w->stopping = true;
    (void)pthread_cond_signal(&w->work);
    (void)pthread_mutex_unlock(&w->mutex);
    if (!already) {
        (void)pthread_join(w->thread, NULL);
    }
}

void writer_destroy(struct writer *w)
{
    if (w == NULL) {
        return;
    }
    writer_stop(w);
    (void)pthread_cond_destroy(&w->work);
    (void)pthread_mutex_destroy(&w->mutex);
    free(w);
}
