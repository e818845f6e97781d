#include "server/study_work.h"

#include "api/pack.h"
#include "api/study_run.h"
#include "server/clock.h"
#include "server/job.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { BATCH_MAX = 256, PUBLISH_US = 500000, PACK_LEVEL = 1 };

/* A cell on its way to the store; `cell` points into the rest. */
struct kept_cell {
    struct store_cell cell;
    struct study_cell_result result;
    void *packed; /* owned */
};

struct unit_run;

struct study_work {
    char id[JOB_ID_SIZE]; /* of the study below, "" = none */
    struct study *study;
    struct study_runner *runner;
    struct study_memory memory; /* of the runner */
    struct packer *packer;
    struct unit_run *unit; /* the one being computed */
    int n;
    struct kept_cell kept[BATCH_MAX];
};

/* A unit being computed. */
struct unit_run {
    struct study_work *work;
    const struct worker_env *env;
    const struct store_claim *claim;
    int next;          /* places before it are in the batch, or stored */
    int64_t stored_us; /* last time */
    bool kept;         /* the lease */
    bool ended;        /* the study */
};

struct study_work *study_work_create(void)
{
    struct study_work *w = calloc(1, sizeof *w);
    if (w != NULL) {
        w->packer = packer_create();
    }
    if (w != NULL && w->packer == NULL) {
        free(w);
        w = NULL;
    }
    return w;
}

static void forget_cells(struct study_work *w)
{
    for (int i = 0; i < w->n; i++) {
        study_cell_result_done(&w->kept[i].result);
        free(w->kept[i].packed);
    }
    w->n = 0;
}

static void forget_study(struct study_work *w)
{
    study_runner_destroy(w->runner);
    study_destroy(w->study);
    w->runner = NULL;
    w->study = NULL;
    w->id[0] = '\0';
}

void study_work_destroy(struct study_work *w)
{
    if (w != NULL) {
        forget_cells(w);
        forget_study(w);
        packer_destroy(w->packer);
        free(w);
    }
}

/* -- storing ---------------------------------------------------------------------------- */

struct cells_request {
    struct write_request base;
    const struct store_ticket *ticket;
    const struct store_batch *batch;
    struct store_progress progress;
};

static enum store_status cells_apply(struct write_request *r, struct store_session *s)
{
    struct cells_request *q = (struct cells_request *)r;
    return s->ops->publish_cells(s, q->ticket, q->batch, clock_wall_us(), &q->progress);
}

static void publish(struct unit_run *u, enum store_unit_move move)
{
    struct store_cell cell[BATCH_MAX];
    struct study_work *w = u->work;
    for (int i = 0; i < w->n; i++) {
        cell[i] = w->kept[i].cell;
    }
    const struct store_batch batch = {.n = w->n, .cell = cell, .next = u->next, .move = move};
    struct cells_request q = {
        .base = {.apply = cells_apply}, .ticket = &u->claim->ticket, .batch = &batch};
    const enum store_status st = worker_store(u->env, &q.base);
    u->kept = st == STORE_OK && q.progress.kept;
    u->ended = st == STORE_OK && job_is_final(q.progress.state);
    u->stored_us = clock_mono_us();
    if (st != STORE_OK) {
        LOG(u->env->log, st == STORE_CONFLICT ? LOG_LEVEL_WARN : LOG_LEVEL_ERROR,
            "cells_not_stored", log_s("id", u->claim->ticket.id),
            log_i("unit", u->claim->ticket.unit), log_i("status", st));
    } else if (u->ended) {
        LOG(u->env->log, LOG_LEVEL_INFO, "study_end", log_s("id", u->claim->ticket.id),
            log_s("state", job_state_name(q.progress.state)));
    }
    forget_cells(w);
}

/* -- one cell --------------------------------------------------------------------------- */

/* An answer that is known already. False when there is none, or it cannot be read. */
static bool look_up(const struct unit_run *u, const char *hash, struct store_known *out)
{
    if (hash[0] == '\0') {
        return false;
    }
    struct store *store = u->env->store;
    struct store_session *s = store->ops->reader_take(store);
    if (s == NULL) {
        return false;
    }
    const enum store_status st = s->ops->find_known(s, hash, out);
    store->ops->reader_give(store, s);
    return st == STORE_OK;
}

static void take_known(struct kept_cell *k, const char *hash, struct store_known *known)
{
    k->cell.reused = true;
    k->cell.known = known->known;
    k->result = (struct study_cell_result){.state = STUDY_CELL_DONE, .summary = known->summary};
    (void)snprintf(k->result.hash, sizeof k->result.hash, "%s", hash);
    (void)snprintf(k->result.verdict, sizeof k->result.verdict, "%s", known->verdict);
}

/* A cell that has ended the process, or was lost with it, again and again. */
static void give_up(struct kept_cell *k, int lost)
{
    k->result = (struct study_cell_result){.state = STUDY_CELL_FAILED, .code = "lost"};
    (void)snprintf(k->result.detail, sizeof k->result.detail,
                   "the process or worker that computed the cell ended without an answer, %d times",
                   lost);
}

static bool fill(struct study_work *w, struct kept_cell *k)
{
    struct store_cell *c = &k->cell;
    const struct study_cell_result *r = &k->result;
    c->state = r->state;
    c->content_hash = r->hash;
    c->verdict = r->verdict;
    c->error_code = r->code;
    c->error_detail = r->detail;
    c->cpu_s = r->cpu_s;
    if (r->summary != NULL) {
        c->summary_size = strlen(r->summary);
        k->packed =
            packer_text(w->packer, r->summary, c->summary_size, PACK_LEVEL, &c->summary_packed);
        c->summary = k->packed;
    }
    return r->summary == NULL || k->packed != NULL;
}

/* Enters a finished cell into the batch. */
static enum status put(struct study_work *w, const struct kept_cell *k)
{
    w->kept[w->n] = *k;
    w->n++;
    return fill(w, &w->kept[w->n - 1]) ? ST_OK : ST_NO_MEMORY;
}

static bool is_due(const struct unit_run *u)
{
    return clock_mono_us() - u->stored_us >= PUBLISH_US;
}

/* Answers the cell at the next place into the batch. */
static enum status answer_cell(struct unit_run *u, const struct sim_control *control)
{
    struct study_work *w = u->work;
    struct kept_cell k = {.cell = {.cell = study_cell_at(w->study, u->next)}};
    struct store_known known = {.known = 0};
    char hash[LIMIT_HASH] = "";
    enum status st = study_runner_begin(w->runner, k.cell.cell, hash);
    if (st != ST_OK) {
        return st;
    }
    if (look_up(u, hash, &known)) {
        take_known(&k, hash, &known);
    } else if (u->next == u->claim->next && u->claim->lost >= u->env->attempts_max) {
        give_up(&k, u->claim->lost);
    } else {
        st = study_runner_compute(w->runner, control, &k.result);
    }
    if (st == ST_OK) {
        u->next++;
        st = put(w, &k);
    }
    return st;
}

/* -- what searches know ----------------------------------------------------------------- */

/* study_memory: the answer of a cell or a job. */
static char *find_answer(void *context, const char *hash)
{
    const struct study_work *w = context;
    struct store *store = w->unit->env->store;
    struct store_known known = {.known = 0};
    if (!look_up(w->unit, hash, &known) || known.known == 0) {
        return known.summary;
    }
    struct store_session *s = store->ops->reader_take(store);
    if (s != NULL) {
        (void)s->ops->read_known(s, known.known, &known.summary); /* unread: it is run again */
        store->ops->reader_give(store, s);
    }
    return known.summary;
}

/* study_memory: an answer of a search under way is stored with the next batch, so that a crash
 * costs no more of it than of cells. */
static void keep_answer(void *context, const char *hash, const char *verdict, const char *summary,
                        double cpu_s)
{
    struct study_work *w = context;
    struct kept_cell k = {.cell = {.cell = -1},
                          .result = {.state = STUDY_CELL_DONE, .cpu_s = cpu_s}};
    k.result.summary = strdup(summary);
    if (k.result.summary == NULL || !w->unit->kept) {
        free(k.result.summary);
        return;
    }
    (void)snprintf(k.result.hash, sizeof k.result.hash, "%s", hash);
    (void)snprintf(k.result.verdict, sizeof k.result.verdict, "%s", verdict);
    if (put(w, &k) != ST_OK) {
        w->n--;
        free(k.result.summary);
    }
    if (is_due(w->unit) || w->n == BATCH_MAX - 1) {
        publish(w->unit, STORE_UNIT_KEEP);
    }
}

/* -- the unit --------------------------------------------------------------------------- */

struct fail_request {
    struct write_request base;
    const struct store_ticket *ticket;
    const struct failure *why;
};

static enum store_status fail_apply(struct write_request *r, struct store_session *s)
{
    struct fail_request *q = (struct fail_request *)r;
    char detail[512];
    (void)snprintf(detail, sizeof detail, "%s%s%s", q->why->pointer,
                   q->why->pointer[0] != '\0' ? ": " : "", q->why->detail);
    return (s->ops->fail)(s, q->ticket, q->why->code, detail, clock_wall_us());
}

/* An accepted study that no longer parses: the library or the rules have changed since. */
static bool fail_study(const struct worker_env *env, const struct store_claim *claim,
                       const struct failure *why)
{
    struct fail_request q = {.base = {.apply = fail_apply}, .ticket = &claim->ticket, .why = why};
    const enum store_status st = worker_store(env, &q.base);
    LOG(env->log, LOG_LEVEL_WARN, "job_failed", log_s("id", claim->ticket.id),
        log_s("code", why->code), log_s("detail", why->detail), log_i("status", st));
    return st == STORE_OK;
}

/* Makes the study of the claim the one at hand. */
static enum status open_study(struct study_work *w, const struct worker_env *env,
                              const struct store_claim *claim, struct failure *why)
{
    if (strcmp(w->id, claim->ticket.id) == 0) {
        return ST_OK;
    }
    forget_study(w);
    struct failure_list *problems = calloc(1, sizeof *problems);
    if (problems == NULL) {
        return ST_NO_MEMORY;
    }
    const enum status st = study_open(env->library, claim->case_json, &w->study, problems);
    *why = problems->item[0];
    free(problems);
    if (st != ST_OK) {
        return st;
    }
    w->runner = study_runner_create(w->study, clock_thread_cpu_s);
    if (w->runner == NULL) {
        forget_study(w);
        return ST_NO_MEMORY;
    }
    w->memory = (struct study_memory){.context = w, .find = find_answer, .keep = keep_answer};
    study_runner_remember(w->runner, &w->memory);
    (void)snprintf(w->id, sizeof w->id, "%s", claim->ticket.id);
    return ST_OK;
}

bool study_work_unit(struct study_work *w, const struct worker_env *env, int slot,
                     const struct store_claim *claim)
{
    struct failure why = {.status = ST_OK};
    struct unit_run u = {.work = w,
                         .env = env,
                         .claim = claim,
                         .next = claim->next,
                         .stored_us = clock_mono_us(),
                         .kept = true};
    enum status st = open_study(w, env, claim, &why);
    if (st == ST_INVALID || st == ST_LIMIT) {
        return fail_study(env, claim, &why);
    }
    const struct sim_control control = dispatch_control(env->dispatch, slot);
    w->unit = &u;
    while (st == ST_OK && u.kept && u.next < claim->last) {
        st = sim_control_cancelled(&control) ? ST_CANCELLED : answer_cell(&u, &control);
        const bool due = is_due(&u) || w->n == BATCH_MAX;
        if (st == ST_OK && due && u.next < claim->last) {
            publish(&u, STORE_UNIT_YIELD);
        }
    }
    if (st == ST_NO_MEMORY) { /* the lease runs out and the unit is taken up again */
        LOG(env->log, LOG_LEVEL_ERROR, "no_memory", log_s("id", claim->ticket.id));
        forget_cells(w);
    } else if (u.kept) {
        publish(&u, STORE_UNIT_RELEASE);
    }
    forget_cells(w); /* of a lease that was lost in the middle of a search */
    w->unit = NULL;
    return u.ended;
}
