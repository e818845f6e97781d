#include "server/worker.h"

#include "server/clock.h"
#include "server/runner.h"
#include "server/study_work.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { IDLE_WAIT_S = 5, RETRY_WAIT_S = 1, FULL_RETRIES_MAX = 600, ERROR_RETRIES_MAX = 3 };

struct worker {
    struct workers *all;
    int slot;
    pthread_t thread;
    struct study_work *study;
    double study_ahead_s; /* time given to studies less that given to jobs, within a second */
};

/* The request that workers_keep posts again and again. */
struct keep_request {
    struct write_request base;
    struct workers *all;
    atomic_bool queued;
    int n;                       /* tickets to extend */
    struct store_ticket *ticket; /* (slots) */
    bool *lost;                  /* (slots) the ticket is no longer valid */
    struct store_recovered recovered;
};

struct workers {
    struct worker_env env;
    struct keep_request keep;
    int n_thread;
    struct worker thread[];
};

static int64_t lease_end(int64_t now)
{
    return now + LEASE_S * INT64_C(1000000);
}

/* -- claim ------------------------------------------------------------------------------ */

struct claim_request {
    struct write_request base;
    const struct worker *worker;
    struct store_claim claim;
};

static enum store_status claim_apply(struct write_request *r, struct store_session *s)
{
    struct claim_request *c = (struct claim_request *)r;
    const int64_t now = clock_wall_us();
    free(c->claim.case_json); /* of a try that was rolled back */
    c->claim.case_json = NULL;
    /* Who had less comes first. */
    enum store_status (*const take[])(struct store_session *, const char *, int64_t, int64_t,
                                      struct store_claim *) = {s->ops->claim, s->ops->claim_unit};
    const int first = c->worker->study_ahead_s < 0.0;
    enum store_status st = STORE_NONE;
    for (int i = 0; st == STORE_NONE && i < 2; i++) {
        st = take[i ^ first](s, c->worker->all->env.owner, now, lease_end(now), &c->claim);
    }
    return st;
}

static void claim_done(struct write_request *r, enum store_status st)
{
    struct claim_request *c = (struct claim_request *)r;
    if (st == STORE_OK) {
        dispatch_enter(c->worker->all->env.dispatch, c->worker->slot, &c->claim.ticket);
    } else {
        free(c->claim.case_json);
        c->claim.case_json = NULL;
    }
}

static enum store_status claim_job(const struct worker *w, struct store_claim *out)
{
    struct claim_request c = {.base = {.apply = claim_apply, .done = claim_done}, .worker = w};
    const enum store_status st = writer_call(w->all->env.writer, &c.base);
    if (st == STORE_OK) {
        *out = c.claim;
    }
    return st;
}

/* -- the end of a claim ----------------------------------------------------------------- */

struct end_request {
    struct write_request base;
    const struct store_ticket *ticket;
    const struct run_outcome *outcome;
    enum job_state state; /* what became of the job */
};

static enum store_status end_apply(struct write_request *r, struct store_session *s)
{
    struct end_request *e = (struct end_request *)r;
    const struct run_outcome *o = e->outcome;
    const int64_t now = clock_wall_us();
    enum store_status st = STORE_ERROR;
    switch (o->end) {
    case RUN_DONE:
        st = s->ops->publish(s, e->ticket, &o->result, now);
        e->state = JOB_DONE;
        break;
    case RUN_FAILED:
        st = s->ops->fail(s, e->ticket, o->code, o->detail, now);
        e->state = JOB_FAILED;
        break;
    case RUN_STOPPED:
        st = s->ops->hand_back(s, e->ticket);
        e->state = JOB_QUEUED;
        break;
    }
    if (st == STORE_CONFLICT) { /* being cancelled: that is the only end left to it */
        st = s->ops->stopped(s, e->ticket, now);
        e->state = JOB_CANCELLED;
    }
    return st;
}

static void pause_s(int seconds)
{
    const struct timespec t = {.tv_sec = seconds};
    (void)nanosleep(&t, NULL);
}

enum store_status worker_store(const struct worker_env *env, struct write_request *r)
{
    for (int i = 0;; i++) {
        const enum store_status st = writer_call(env->writer, r);
        const bool again = (st == STORE_FULL && i < FULL_RETRIES_MAX) ||
                           (st == STORE_ERROR && i < ERROR_RETRIES_MAX);
        if (!again || dispatch_stopping(env->dispatch)) {
            return st;
        }
        pause_s(RETRY_WAIT_S);
    }
}

static void report_end(const struct worker_env *env, const struct store_claim *claim,
                       const struct end_request *e, enum store_status st)
{
    const struct run_outcome *o = e->outcome;
    const char *id = claim->ticket.id;
    if (st == STORE_CONFLICT) {
        LOG(env->log, LOG_LEVEL_WARN, "job_stale", log_s("id", id),
            log_i("fence", claim->ticket.fence));
    } else if (st != STORE_OK) {
        LOG(env->log, LOG_LEVEL_ERROR, "job_not_stored", log_s("id", id), log_i("status", st));
    } else if (e->state == JOB_FAILED) {
        LOG(env->log, LOG_LEVEL_WARN, "job_failed", log_s("id", id), log_s("code", o->code),
            log_s("detail", o->detail));
    } else {
        LOG(env->log, LOG_LEVEL_INFO, "job_end", log_s("id", id),
            log_s("state", job_state_name(e->state)), log_i("attempt", claim->attempt),
            log_s("verdict", o->verdict), log_f("cpu_s", o->result.cpu_s));
    }
}

static void run_job(const struct worker *w, struct store_claim *claim)
{
    const struct worker_env *env = &w->all->env;
    const struct sim_control control = dispatch_control(env->dispatch, w->slot);
    struct run_outcome *outcome = malloc(sizeof *outcome);
    if (outcome == NULL) {
        LOG(env->log, LOG_LEVEL_ERROR, "no_memory", log_s("id", claim->ticket.id));
        dispatch_leave(env->dispatch, w->slot); /* the lease runs out and the job is run again */
        return;
    }
    runner_run(env->library, claim->case_json, &control, outcome);
    struct end_request e = {
        .base = {.apply = end_apply}, .ticket = &claim->ticket, .outcome = outcome};
    const enum store_status st = worker_store(env, &e.base);
    dispatch_leave(env->dispatch, w->slot);
    if (st == STORE_OK && e.state != JOB_QUEUED) {
        dispatch_depth_add(env->dispatch, -1);
    }
    report_end(env, claim, &e, st);
    run_outcome_done(outcome);
    free(outcome);
}

static void run_unit(const struct worker *w, const struct store_claim *claim)
{
    const struct worker_env *env = &w->all->env;
    const bool ended = study_work_unit(w->study, env, w->slot, claim);
    dispatch_leave(env->dispatch, w->slot);
    if (ended) {
        dispatch_depth_add(env->dispatch, -1);
    }
}

static void run_claim(struct worker *w, struct store_claim *claim)
{
    static const double most_s = 1.0;
    const int64_t start = clock_mono_us();
    const bool unit = claim->ticket.unit > 0;
    if (unit) {
        run_unit(w, claim);
    } else {
        run_job(w, claim);
    }
    const double spent = 1e-6 * (double)(clock_mono_us() - start);
    w->study_ahead_s += unit ? spent : -spent;
    w->study_ahead_s = fmin(fmax(w->study_ahead_s, -most_s), most_s);
    free(claim->case_json);
}

static void *worker_main(void *arg)
{
    struct worker *w = arg;
    struct dispatch *d = w->all->env.dispatch;
    while (!dispatch_stopping(d)) {
        struct store_claim claim = {.attempt = 0};
        const uint64_t rings = dispatch_rings(d);
        const enum store_status st = claim_job(w, &claim);
        if (st == STORE_OK) {
            run_claim(w, &claim);
        } else {
            dispatch_wait(d, rings, st == STORE_NONE ? IDLE_WAIT_S : RETRY_WAIT_S);
        }
    }
    return NULL;
}

/* -- leases ----------------------------------------------------------------------------- */

static enum store_status keep_apply(struct write_request *r, struct store_session *s)
{
    struct keep_request *k = (struct keep_request *)r;
    const struct worker_env *env = &k->all->env;
    const int64_t now = clock_wall_us();
    for (int i = 0; i < k->n; i++) {
        const enum store_status st = s->ops->heartbeat(s, &k->ticket[i], lease_end(now));
        k->lost[i] = st == STORE_CONFLICT;
        if (st != STORE_OK && st != STORE_CONFLICT) {
            return st;
        }
    }
    return s->ops->recover(s, env->owner, now, env->attempts_max, &k->recovered);
}

static void report_recovered(const struct worker_env *env, const struct store_recovered *r)
{
    if (r->queued + r->failed + r->cancelled + r->units == 0) {
        return;
    }
    LOG(env->log, LOG_LEVEL_WARN, "jobs_recovered", log_i("queued", r->queued),
        log_i("failed", r->failed), log_i("cancelled", r->cancelled), log_i("units", r->units));
    dispatch_depth_add(env->dispatch, -(int64_t)(r->failed + r->cancelled));
    dispatch_ring(env->dispatch);
}

static void keep_done(struct write_request *r, enum store_status st)
{
    struct keep_request *k = (struct keep_request *)r;
    if (st == STORE_OK) {
        for (int i = 0; i < k->n; i++) {
            if (k->lost[i]) { /* ended in the meantime, or lost: then it must not go on */
                (void)dispatch_cancel(k->all->env.dispatch, k->ticket[i].id, k->ticket[i].fence);
            }
        }
        report_recovered(&k->all->env, &k->recovered);
    }
    atomic_store(&k->queued, false);
}

void workers_keep(struct workers *w)
{
    struct keep_request *k = &w->keep;
    if (atomic_exchange(&k->queued, true)) {
        return;
    }
    k->n = dispatch_tickets(w->env.dispatch, k->ticket);
    if (!writer_post(w->env.writer, &k->base)) {
        atomic_store(&k->queued, false);
    }
}

struct recover_request {
    struct write_request base;
    const struct worker_env *env;
    struct store_recovered recovered;
};

static enum store_status recover_apply(struct write_request *r, struct store_session *s)
{
    struct recover_request *q = (struct recover_request *)r;
    return s->ops->recover(s, q->env->owner, clock_wall_us(), q->env->attempts_max, &q->recovered);
}

enum store_status workers_recover(const struct worker_env *env)
{
    struct recover_request r = {.base = {.apply = recover_apply}, .env = env};
    const enum store_status st = writer_call(env->writer, &r.base);
    if (st == STORE_OK) {
        report_recovered(env, &r.recovered);
    }
    return st;
}

/* -- start and stop --------------------------------------------------------------------- */

enum store_status workers_start(const struct worker_env *env, struct workers **out)
{
    const size_t n = (size_t)dispatch_slots(env->dispatch);
    struct workers *w = calloc(1, sizeof *w + n * sizeof w->thread[0]);
    if (w == NULL) {
        return STORE_ERROR;
    }
    w->env = *env;
    w->keep.base = (struct write_request){.apply = keep_apply, .done = keep_done};
    w->keep.all = w;
    w->keep.ticket = calloc(n + 1, sizeof *w->keep.ticket);
    w->keep.lost = calloc(n + 1, sizeof *w->keep.lost);
    bool ok = w->keep.ticket != NULL && w->keep.lost != NULL;
    for (int i = 0; ok && i < (int)n; i++) {
        w->thread[i] = (struct worker){.all = w, .slot = i, .study = study_work_create()};
        ok = w->thread[i].study != NULL &&
             pthread_create(&w->thread[i].thread, NULL, worker_main, &w->thread[i]) == 0;
        w->n_thread += ok;
    }
    if (!ok) {
        workers_stop(w);
        return STORE_ERROR;
    }
    *out = w;
    return STORE_OK;
}

void workers_stop(struct workers *w)
{
    if (w == NULL) {
        return;
    }
    dispatch_stop(w->env.dispatch);
    for (int i = 0; i < w->n_thread; i++) {
        (void)pthread_join(w->thread[i].thread, NULL);
    }
    while (atomic_load(&w->keep.queued)) { /* still with the writer, which outlives the workers */
        const struct timespec t = {.tv_nsec = 1000000};
        (void)nanosleep(&t, NULL);
    }
    for (int i = 0; i < dispatch_slots(w->env.dispatch); i++) {
        study_work_destroy(w->thread[i].study);
    }
    free(w->keep.ticket);
    free(w->keep.lost);
    free(w);
}
