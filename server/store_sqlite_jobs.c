/* Writes of the SQLite back end: jobs and their queue. All run inside the writer's transaction. */
#include "server/job.h"
#include "server/store_sqlite.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum store_status sqlite_find_job(struct store_session *s, const char *id, int64_t *seq,
                                  enum job_state *state)
{
    struct sql q = sql_begin(s, "SELECT seq, state FROM job WHERE id = ?1");
    sql_text(&q, id);
    if (!sql_row(&q)) {
        const enum store_status st = sql_end(&q);
        return st == STORE_OK ? STORE_NONE : st;
    }
    const char *name = (const char *)sqlite3_column_text(q.stmt, 1);
    if (name == NULL || !job_state_parse(name, state)) {
        q.status = STORE_CORRUPT;
    } else {
        *seq = sqlite3_column_int64(q.stmt, 0);
    }
    return sql_end(&q);
}

enum store_status sqlite_move_job(struct store_session *s, int64_t seq, enum job_state from,
                                  enum job_state to, int64_t finished)
{
    if (!job_move_allowed(from, to)) {
        return STORE_CONFLICT;
    }
    struct sql q = sql_begin(s, "UPDATE job SET state = ?1, finished_us = ?2 WHERE seq = ?3");
    sql_text(&q, job_state_name(to));
    sql_int(&q, finished);
    sql_int(&q, seq);
    return sql_run(&q);
}

static enum store_status run_for(struct store_session *s, const char *text, int64_t seq)
{
    struct sql q = sql_begin(s, text);
    sql_int(&q, seq);
    return sql_run(&q);
}

enum store_status sqlite_finish_job(struct store_session *s, int64_t seq, enum job_state from,
                                    enum job_state to, int64_t now)
{
    static const char *const text[] = {"DELETE FROM queue WHERE job = ?1",
                                       "DELETE FROM study_unit WHERE study = ?1",
                                       "UPDATE study SET open = 0 WHERE job = ?1"};
    enum store_status st = sqlite_move_job(s, seq, from, to, now);
    for (size_t i = 0; st == STORE_OK && i < sizeof text / sizeof text[0]; i++) {
        st = run_for(s, text[i], seq);
    }
    return st;
}

/* -- submit ----------------------------------------------------------------------------- */

static enum store_status find_equal(struct store_session *s, const char *hash,
                                    struct service_submitted *out)
{
    struct sql q = sql_begin(s, "SELECT id, state FROM job WHERE content_hash = ?1 "
                                "AND state IN ('queued', 'running', 'done')");
    sql_text(&q, hash);
    if (!sql_row(&q)) {
        const enum store_status st = sql_end(&q);
        return st == STORE_OK ? STORE_NONE : st;
    }
    struct service_submitted found = {.reused = true};
    sql_copy(&q, 0, found.id, sizeof found.id);
    const char *state = (const char *)sqlite3_column_text(q.stmt, 1);
    if (state == NULL || !job_state_parse(state, &found.state)) {
        q.status = STORE_CORRUPT;
    } else {
        *out = found;
    }
    return sql_end(&q);
}

enum store_status sqlite_submit(struct store_session *s, const struct service_submit *item,
                                const char *new_id, int64_t now, struct service_submitted *out)
{
    enum store_status st = find_equal(s, item->content_hash, out);
    if (st != STORE_NONE) {
        return st;
    }
    struct sql job = sql_begin(s, "INSERT INTO job (id, kind, state, name, content_hash, "
                                  "created_us) VALUES (?1, ?2, 'queued', ?3, ?4, ?5)");
    sql_text(&job, new_id);
    sql_text(&job, job_kind_name(item->kind));
    sql_text(&job, item->name);
    sql_text(&job, item->content_hash);
    sql_int(&job, now);
    st = sql_run(&job);
    const int64_t seq = sqlite3_last_insert_rowid(sqlite_session_of(s)->db);
    if (st == STORE_OK) {
        struct sql text = sql_begin(s, "INSERT INTO job_case (job, json) VALUES (?1, ?2)");
        sql_int(&text, seq);
        sql_text(&text, item->case_json);
        st = sql_run(&text);
    }
    if (st == STORE_OK && item->plan != NULL) {
        st = sqlite_insert_study(s, seq, item->plan);
    } else if (st == STORE_OK) {
        struct sql queue = sql_begin(s, "INSERT INTO queue (job, ready_us) VALUES (?1, ?2)");
        sql_int(&queue, seq);
        sql_int(&queue, now);
        st = sql_run(&queue);
    }
    if (st == STORE_OK) {
        *out = (struct service_submitted){.state = JOB_QUEUED};
        (void)snprintf(out->id, sizeof out->id, "%s", new_id);
    }
    return st;
}

/* -- claim and its ends ----------------------------------------------------------------- */

static enum store_status lease_oldest(struct store_session *s, const char *owner, int64_t now,
                                      int64_t lease_until, int64_t *seq, int64_t *fence)
{
    struct sql q =
        sql_begin(s, "UPDATE queue SET lease_until = ?1, owner = ?2, fence = fence + 1 "
                     "WHERE job = (SELECT job FROM queue WHERE lease_until = 0 AND ready_us <= ?3 "
                     "             ORDER BY ready_us, job LIMIT 1) RETURNING job, fence");
    sql_int(&q, lease_until);
    sql_text(&q, owner);
    sql_int(&q, now);
    bool found = false;
    while (sql_row(&q)) { /* one row; the update is complete once the statement has ended */
        *seq = sqlite3_column_int64(q.stmt, 0);
        *fence = sqlite3_column_int64(q.stmt, 1);
        found = true;
    }
    const enum store_status st = sql_end(&q);
    return st == STORE_OK && !found ? STORE_NONE : st;
}

enum store_status sqlite_claim(struct store_session *s, const char *owner, int64_t now,
                               int64_t lease_until, struct store_claim *out)
{
    int64_t seq = 0;
    struct store_claim claim = {.attempt = 0};
    enum store_status st = lease_oldest(s, owner, now, lease_until, &seq, &claim.ticket.fence);
    if (st != STORE_OK) {
        return st;
    }
    struct sql mark = sql_begin(s, "UPDATE job SET state = 'running', attempt = attempt + 1, "
                                   "started_us = ?1 WHERE seq = ?2 AND state = 'queued'");
    sql_int(&mark, now);
    sql_int(&mark, seq);
    st = sql_run(&mark);
    if (st != STORE_OK) {
        return st;
    }
    if (sqlite3_changes(sqlite_session_of(s)->db) != 1) {
        return STORE_CORRUPT; /* a waiting row whose job is not queued breaks the invariant */
    }
    struct sql q =
        sql_begin(s, "SELECT id, kind, attempt, json FROM job JOIN job_case ON job = seq "
                     "WHERE seq = ?1");
    sql_int(&q, seq);
    if (sql_row(&q)) {
        sql_copy(&q, 0, claim.ticket.id, sizeof claim.ticket.id);
        const char *kind = (const char *)sqlite3_column_text(q.stmt, 1);
        if (kind == NULL || !job_kind_parse(kind, &claim.kind)) {
            q.status = STORE_CORRUPT;
        }
        claim.attempt = sqlite3_column_int(q.stmt, 2);
        claim.case_json = sql_strdup(&q, 3);
    }
    st = sql_end(&q);
    if (st == STORE_OK && claim.case_json == NULL) {
        st = STORE_CORRUPT;
    }
    if (st != STORE_OK) {
        free(claim.case_json);
        return st;
    }
    *out = claim;
    return STORE_OK;
}

enum store_status sqlite_redeem(struct store_session *s, const char *lease,
                                const struct store_ticket *t, int64_t *seq, enum job_state *state)
{
    enum store_status st = sqlite_find_job(s, t->id, seq, state);
    if (st != STORE_OK) {
        return st == STORE_NONE ? STORE_CONFLICT : st;
    }
    struct sql q = sql_begin(s, lease);
    sql_int(&q, *seq);
    sql_int(&q, t->unit);
    sql_int(&q, t->fence);
    const bool held = sql_row(&q);
    st = sql_end(&q);
    return st == STORE_OK && !held ? STORE_CONFLICT : st;
}

/* Of a whole job. */
static enum store_status redeem(struct store_session *s, const struct store_ticket *t, int64_t *seq,
                                enum job_state *state)
{
    return sqlite_redeem(s,
                         "SELECT 1 FROM queue WHERE job = ?1 AND ?2 = 0 AND fence = ?3 "
                         "AND lease_until <> 0",
                         t, seq, state);
}

/* Of a job or a unit of a study. */
static enum store_status redeem_any(struct store_session *s, const struct store_ticket *t,
                                    int64_t *seq, enum job_state *state)
{
    return (t->unit > 0 ? sqlite_redeem_unit : redeem)(s, t, seq, state);
}

enum store_status sqlite_heartbeat(struct store_session *s, const struct store_ticket *t,
                                   int64_t lease_until)
{
    int64_t seq = 0;
    enum job_state state;
    enum store_status st = redeem_any(s, t, &seq, &state);
    if (st == STORE_OK) {
        struct sql q = t->unit > 0 ? sql_begin(s, "UPDATE study_unit SET lease_until = ?1 "
                                                  "WHERE study = ?2 AND unit = ?3")
                                   : sql_begin(s, "UPDATE queue SET lease_until = ?1 "
                                                  "WHERE job = ?2 AND ?3 = 0");
        sql_int(&q, lease_until);
        sql_int(&q, seq);
        sql_int(&q, t->unit);
        st = sql_run(&q);
    }
    return st;
}

enum store_status sqlite_publish(struct store_session *s, const struct store_ticket *t,
                                 const struct store_result *result, int64_t now)
{
    int64_t seq = 0;
    enum job_state state;
    enum store_status st = redeem(s, t, &seq, &state);
    if (st == STORE_OK) {
        st = sqlite_finish_job(s, seq, state, JOB_DONE, now);
    }
    if (st == STORE_OK) {
        st = sqlite_insert_result(s, seq, t->fence, result, now);
    }
    if (st == STORE_OK && result->entry != NULL) {
        struct shelf_item item = *result->entry;
        int version = 0;
        bool reused = false;
        item.job = t->id;
        st = sqlite_shelf_put(s, &item, now, &version, &reused);
    }
    return st;
}

static enum store_status fail_job(struct store_session *s, int64_t seq, enum job_state state,
                                  const char *code, const char *detail, int64_t now)
{
    enum store_status st = sqlite_finish_job(s, seq, state, JOB_FAILED, now);
    if (st == STORE_OK) {
        struct sql q = sql_begin(s, "UPDATE job SET error_code = ?1, error_detail = ?2 "
                                    "WHERE seq = ?3");
        sql_text(&q, code);
        sql_text(&q, detail);
        sql_int(&q, seq);
        st = sql_run(&q);
    }
    return st;
}

enum store_status sqlite_fail(struct store_session *s, const struct store_ticket *t,
                              const char *code, const char *detail, int64_t now)
{
    int64_t seq = 0;
    enum job_state state;
    const enum store_status st = redeem_any(s, t, &seq, &state);
    return st == STORE_OK ? fail_job(s, seq, state, code, detail, now) : st;
}

static enum store_status wait_again(struct store_session *s, int64_t seq, enum job_state state,
                                    int lost)
{
    enum store_status st = sqlite_move_job(s, seq, state, JOB_QUEUED, 0);
    if (st == STORE_OK) {
        struct sql q = sql_begin(s, "UPDATE queue SET lease_until = 0, owner = '', "
                                    "lost = lost + ?1 WHERE job = ?2");
        sql_int(&q, lost);
        sql_int(&q, seq);
        st = sql_run(&q);
    }
    return st;
}

enum store_status sqlite_hand_back(struct store_session *s, const struct store_ticket *t)
{
    int64_t seq = 0;
    enum job_state state;
    const enum store_status st = redeem(s, t, &seq, &state);
    return st == STORE_OK ? wait_again(s, seq, state, 0) : st;
}

enum store_status sqlite_stopped(struct store_session *s, const struct store_ticket *t, int64_t now)
{
    int64_t seq = 0;
    enum job_state state;
    enum store_status st = redeem(s, t, &seq, &state);
    if (st == STORE_OK && state != JOB_CANCELLING) {
        return STORE_CONFLICT;
    }
    return st == STORE_OK ? sqlite_finish_job(s, seq, state, JOB_CANCELLED, now) : st;
}

enum store_status sqlite_cancel(struct store_session *s, const char *id, int64_t now,
                                struct job_record *out)
{
    int64_t seq = 0;
    enum job_state state;
    enum store_status st = sqlite_find_job(s, id, &seq, &state);
    if (st != STORE_OK) {
        return st;
    }
    if (state == JOB_QUEUED) {
        st = sqlite_finish_job(s, seq, state, JOB_CANCELLED, now);
    } else if (state == JOB_RUNNING) {
        st = sqlite_move_job(s, seq, state, JOB_CANCELLING, 0);
        if (st == STORE_OK) {
            st = sqlite_stop_study(s, seq, now);
        }
    }
    return st == STORE_OK ? sqlite_get(s, id, out) : st;
}

/* -- recovery --------------------------------------------------------------------------- */

struct lost_job {
    int64_t seq;
    int lost;
    enum job_state state;
};

static enum store_status next_lost(struct store_session *s, const char *owner, int64_t now,
                                   struct lost_job *out)
{
    struct sql q = sql_begin(s, "SELECT job, lost, state FROM queue JOIN job ON seq = job "
                                "WHERE lease_until > 0 AND (owner <> ?1 OR lease_until < ?2) "
                                "LIMIT 1");
    sql_text(&q, owner);
    sql_int(&q, now);
    if (!sql_row(&q)) {
        const enum store_status st = sql_end(&q);
        return st == STORE_OK ? STORE_NONE : st;
    }
    const char *state = (const char *)sqlite3_column_text(q.stmt, 2);
    struct lost_job found = {.seq = sqlite3_column_int64(q.stmt, 0),
                             .lost = sqlite3_column_int(q.stmt, 1)};
    if (state == NULL || !job_state_parse(state, &found.state)) {
        q.status = STORE_CORRUPT;
    } else {
        *out = found;
    }
    return sql_end(&q);
}

static enum store_status take_back(struct store_session *s, const struct lost_job *job, int64_t now,
                                   int attempts_max, struct store_recovered *count)
{
    if (job->state == JOB_CANCELLING) {
        count->cancelled++;
        return sqlite_finish_job(s, job->seq, job->state, JOB_CANCELLED, now);
    }
    if (job->lost + 1 < attempts_max) {
        count->queued++;
        return wait_again(s, job->seq, job->state, 1);
    }
    char detail[160];
    (void)snprintf(detail, sizeof detail,
                   "the process or worker that ran the job ended without an answer, %d times",
                   job->lost + 1);
    count->failed++;
    return fail_job(s, job->seq, job->state, "lost", detail, now);
}

enum store_status sqlite_recover(struct store_session *s, const char *owner, int64_t now,
                                 int attempts_max, struct store_recovered *out)
{
    struct store_recovered count = {0};
    struct lost_job job = {0};
    enum store_status st;
    while ((st = next_lost(s, owner, now, &job)) == STORE_OK) {
        st = take_back(s, &job, now, attempts_max, &count);
        if (st != STORE_OK) {
            return st;
        }
    }
    while (st == STORE_NONE && (st = sqlite_recover_unit(s, owner, now, &count)) == STORE_OK) {
        st = STORE_NONE;
    }
    if (st == STORE_NONE) {
        *out = count;
        st = STORE_OK;
    }
    return st;
}
