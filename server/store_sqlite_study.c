/* Writes of the SQLite back end: studies, their units and cells, inside the writer's transaction.
 */
#include "api/study.h"
#include "server/job.h"
#include "server/store_sqlite.h"

#include <stdlib.h>
#include <string.h>

/* One number of a statement with one parameter; STORE_NONE without a row. */
static enum store_status ask_number(struct store_session *s, const char *text, int64_t parameter,
                                    int64_t *out)
{
    struct sql q = sql_begin(s, text);
    sql_int(&q, parameter);
    const bool found = sql_row(&q);
    if (found) {
        *out = sqlite3_column_int64(q.stmt, 0);
    }
    const enum store_status st = sql_end(&q);
    return st == STORE_OK && !found ? STORE_NONE : st;
}

/* -- accepted --------------------------------------------------------------------------- */

static enum store_status insert_unit(struct store_session *s, int64_t seq, int unit, int from,
                                     int to)
{
    struct sql q = sql_begin(s, "INSERT INTO study_unit (study, unit, next, last) "
                                "VALUES (?1, ?2, ?3, ?4)");
    sql_int(&q, seq);
    sql_int(&q, unit);
    sql_int(&q, from);
    sql_int(&q, to);
    return sql_run(&q);
}

enum store_status sqlite_insert_study(struct store_session *s, int64_t seq,
                                      const struct study_plan *plan)
{
    struct sql q = sql_begin(s, "INSERT INTO study (job, n_cell) VALUES (?1, ?2)");
    sql_int(&q, seq);
    sql_int(&q, plan->n_cell);
    enum store_status st = sql_run(&q);
    int unit = 0;
    for (int run = 0; run < plan->n_cell; run += plan->run) {
        for (int from = run; st == STORE_OK && from < run + plan->run; from += plan->unit) {
            const int end = run + plan->run, to = from + plan->unit;
            st = insert_unit(s, seq, ++unit, from, to < end ? to : end);
        }
    }
    return st;
}

/* -- claim ------------------------------------------------------------------------------ */

static enum store_status lease_unit(struct store_session *s, int64_t seq, const char *owner,
                                    int64_t lease_until, struct store_claim *claim)
{
    struct sql q = sql_begin(
        s, "UPDATE study_unit SET lease_until = ?1, owner = ?2, fence = ?3 WHERE study = ?4 AND "
           "unit = (SELECT unit FROM study_unit WHERE lease_until = 0 AND study = ?4 "
           "ORDER BY unit LIMIT 1) RETURNING unit, next, last, lost");
    sql_int(&q, lease_until);
    sql_text(&q, owner);
    sql_int(&q, claim->ticket.fence);
    sql_int(&q, seq);
    bool found = false;
    while (sql_row(&q)) { /* one row; the update is complete once the statement has ended */
        claim->ticket.unit = sqlite3_column_int(q.stmt, 0);
        claim->next = sqlite3_column_int(q.stmt, 1);
        claim->last = sqlite3_column_int(q.stmt, 2);
        claim->lost = sqlite3_column_int(q.stmt, 3);
        found = true;
    }
    const enum store_status st = sql_end(&q);
    return st == STORE_OK && !found ? STORE_NONE : st;
}

/* The fence of this claim, and whose turn it was. */
static enum store_status next_fence(struct store_session *s, int64_t seq, int64_t now,
                                    int64_t *fence)
{
    struct sql q = sql_begin(s, "UPDATE study SET fence = fence + 1, served_us = ?1 "
                                "WHERE job = ?2 RETURNING fence");
    sql_int(&q, now);
    sql_int(&q, seq);
    while (sql_row(&q)) {
        *fence = sqlite3_column_int64(q.stmt, 0);
    }
    return sql_end(&q);
}

static enum store_status start_study(struct store_session *s, int64_t seq, int64_t now)
{
    struct sql q = sql_begin(s, "UPDATE job SET state = 'running', attempt = 1, started_us = ?1 "
                                "WHERE seq = ?2 AND state = 'queued'");
    sql_int(&q, now);
    sql_int(&q, seq);
    return sql_run(&q);
}

static enum store_status read_definition(struct store_session *s, int64_t seq,
                                         struct store_claim *claim)
{
    struct sql q = sql_begin(s, "SELECT id, attempt, json FROM job JOIN job_case ON job = seq "
                                "WHERE seq = ?1");
    sql_int(&q, seq);
    if (sql_row(&q)) {
        sql_copy(&q, 0, claim->ticket.id, sizeof claim->ticket.id);
        claim->attempt = sqlite3_column_int(q.stmt, 1);
        claim->case_json = sql_strdup(&q, 2);
    }
    const enum store_status st = sql_end(&q);
    if (st != STORE_OK) {
        free(claim->case_json);
        return st;
    }
    return claim->case_json != NULL ? STORE_OK : STORE_CORRUPT;
}

enum store_status sqlite_claim_unit(struct store_session *s, const char *owner, int64_t now,
                                    int64_t lease_until, struct store_claim *out)
{
    int64_t seq = 0;
    struct store_claim claim = {.kind = JOB_STUDY};
    struct sql q = sql_begin(s, "SELECT job FROM study WHERE open = 1 AND EXISTS "
                                "(SELECT 1 FROM study_unit WHERE lease_until = 0 AND study = job) "
                                "ORDER BY served_us, job LIMIT 1");
    const bool found = sql_row(&q);
    if (found) {
        seq = sqlite3_column_int64(q.stmt, 0);
    }
    enum store_status st = sql_end(&q);
    if (st == STORE_OK && !found) {
        return STORE_NONE;
    }
    if (st == STORE_OK) {
        st = next_fence(s, seq, now, &claim.ticket.fence);
    }
    if (st == STORE_OK) {
        st = lease_unit(s, seq, owner, lease_until, &claim);
    }
    if (st == STORE_OK) {
        st = start_study(s, seq, now);
    }
    if (st == STORE_OK) {
        st = read_definition(s, seq, &claim);
    }
    if (st == STORE_OK) {
        *out = claim;
    }
    return st;
}

enum store_status sqlite_redeem_unit(struct store_session *s, const struct store_ticket *t,
                                     int64_t *seq, enum job_state *state)
{
    return sqlite_redeem(s,
                         "SELECT 1 FROM study_unit WHERE study = ?1 AND unit = ?2 AND fence = ?3 "
                         "AND lease_until <> 0",
                         t, seq, state);
}

/* -- cells ------------------------------------------------------------------------------ */

/* Number of the answer of a cell, which is stored unless an equal one is. */
static enum store_status insert_answer(struct store_session *s, const struct store_cell *c,
                                       int64_t *out)
{
    const bool done = c->state == STUDY_CELL_DONE;
    struct sql q = sql_begin(s, "INSERT OR IGNORE INTO cell_result (content_hash, state, verdict, "
                                "error_code, error_detail, cpu_s, size, summary) "
                                "VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8)");
    sql_text(&q, c->content_hash);
    sql_text(&q, study_cell_state_name(c->state));
    sql_text(&q, c->verdict);
    sql_text(&q, c->error_code);
    sql_text(&q, c->error_detail);
    sql_real(&q, c->cpu_s);
    sql_int(&q, (int64_t)c->summary_size);
    sql_blob(&q, done ? c->summary : "", done ? c->summary_packed : 0);
    enum store_status st = sql_run(&q);
    if (st == STORE_OK && sqlite3_changes(sqlite_session_of(s)->db) == 1) {
        *out = sqlite3_last_insert_rowid(sqlite_session_of(s)->db);
    } else if (st == STORE_OK) {
        st = sqlite_find_answer(s, c->content_hash, out);
    }
    return st;
}

static enum store_status count_cell(struct store_session *s, int64_t seq,
                                    const struct store_cell *c)
{
    const bool done = c->state == STUDY_CELL_DONE;
    struct sql q = sql_begin(s, "UPDATE study SET done = done + ?1, failed = failed + ?2, "
                                "reused = reused + ?3, cpu_s = cpu_s + ?4 WHERE job = ?5");
    sql_int(&q, done);
    sql_int(&q, !done);
    sql_int(&q, c->reused);
    sql_real(&q, c->reused ? 0.0 : c->cpu_s);
    sql_int(&q, seq);
    return sql_run(&q);
}

static enum store_status insert_cell(struct store_session *s, int64_t seq,
                                     const struct store_cell *c)
{
    int64_t answer = c->known;
    enum store_status st = answer > 0 ? STORE_OK : insert_answer(s, c, &answer);
    if (st != STORE_OK || c->cell < 0) {
        return st;
    }
    struct sql q = sql_begin(s, "INSERT OR IGNORE INTO study_cell (study, cell, result, reused) "
                                "VALUES (?1, ?2, ?3, ?4)");
    sql_int(&q, seq);
    sql_int(&q, c->cell);
    sql_int(&q, answer);
    sql_int(&q, c->reused);
    st = sql_run(&q);
    const bool fresh = st == STORE_OK && sqlite3_changes(sqlite_session_of(s)->db) == 1;
    return fresh ? count_cell(s, seq, c) : st;
}

/* -- what becomes of a unit ------------------------------------------------------------- */

static enum store_status remove_unit(struct store_session *s, int64_t seq, int unit)
{
    struct sql q = sql_begin(s, "DELETE FROM study_unit WHERE study = ?1 AND unit = ?2");
    sql_int(&q, seq);
    sql_int(&q, unit);
    return sql_run(&q);
}

/* The proof that a study was finished, as for any job. */
static enum store_status insert_proof(struct store_session *s, int64_t seq, int64_t now)
{
    struct sql q = sql_begin(s, "INSERT INTO result (job, fence, finished_us, cpu_s) "
                                "SELECT job, 1, ?1, cpu_s FROM study WHERE job = ?2");
    sql_int(&q, now);
    sql_int(&q, seq);
    return sql_run(&q);
}

/* Ends the study when no unit is left. */
static enum store_status close_study(struct store_session *s, int64_t seq, enum job_state *state,
                                     int64_t now)
{
    int64_t left = 0;
    enum store_status st = ask_number(
        s, "SELECT count(*) FROM (SELECT 1 FROM study_unit WHERE study = ?1 LIMIT 1)", seq, &left);
    if (st != STORE_OK || left > 0) {
        return st;
    }
    const enum job_state end = *state == JOB_CANCELLING ? JOB_CANCELLED : JOB_DONE;
    st = sqlite_finish_job(s, seq, *state, end, now);
    if (st == STORE_OK && end == JOB_DONE) {
        st = insert_proof(s, seq, now);
    }
    if (st == STORE_OK) {
        *state = end;
    }
    return st;
}

/* Whether a job, or another study, could be served instead. */
static enum store_status others_wait(struct store_session *s, int64_t seq, bool *out)
{
    int64_t wait = 0;
    const enum store_status st =
        ask_number(s,
                   "SELECT EXISTS (SELECT 1 FROM queue WHERE lease_until = 0) OR EXISTS "
                   "(SELECT 1 FROM study_unit WHERE lease_until = 0 AND study <> ?1)",
                   seq, &wait);
    *out = wait != 0;
    return st;
}

static enum store_status go_on(struct store_session *s, int64_t seq, const struct store_ticket *t,
                               const struct store_batch *batch, bool *kept)
{
    bool wait = false;
    enum store_status st = STORE_OK;
    if (batch->move == STORE_UNIT_YIELD) {
        st = others_wait(s, seq, &wait);
    }
    *kept = batch->move != STORE_UNIT_RELEASE && !wait;
    struct sql q = sql_begin(s, "UPDATE study_unit SET lost = CASE WHEN next < ?1 THEN 0 "
                                "ELSE lost END, next = ?1, lease_until = CASE WHEN ?2 "
                                "THEN lease_until ELSE 0 END WHERE study = ?3 AND unit = ?4");
    sql_int(&q, batch->next);
    sql_int(&q, *kept);
    sql_int(&q, seq);
    sql_int(&q, t->unit);
    const enum store_status moved = sql_run(&q);
    return st == STORE_OK ? moved : st;
}

enum store_status sqlite_publish_cells(struct store_session *s, const struct store_ticket *t,
                                       const struct store_batch *batch, int64_t now,
                                       struct store_progress *out)
{
    int64_t seq = 0, last = 0;
    struct store_progress progress = {.kept = false};
    enum store_status st = sqlite_redeem_unit(s, t, &seq, &progress.state);
    for (int i = 0; st == STORE_OK && i < batch->n; i++) {
        st = insert_cell(s, seq, &batch->cell[i]);
    }
    if (st == STORE_OK) {
        struct sql q = sql_begin(s, "SELECT last FROM study_unit WHERE study = ?1 AND unit = ?2");
        sql_int(&q, seq);
        sql_int(&q, t->unit);
        if (sql_row(&q)) {
            last = sqlite3_column_int64(q.stmt, 0);
        }
        st = sql_end(&q);
    }
    if (st == STORE_OK && (batch->next >= last || progress.state == JOB_CANCELLING)) {
        st = remove_unit(s, seq, t->unit);
        if (st == STORE_OK) {
            st = close_study(s, seq, &progress.state, now);
        }
    } else if (st == STORE_OK) {
        st = go_on(s, seq, t, batch, &progress.kept);
    }
    if (st == STORE_OK) {
        *out = progress;
    }
    return st;
}

enum store_status sqlite_stop_study(struct store_session *s, int64_t seq, int64_t now)
{
    int64_t cells = 0;
    enum job_state state = JOB_CANCELLING;
    enum store_status st = ask_number(s, "SELECT n_cell FROM study WHERE job = ?1", seq, &cells);
    if (st != STORE_OK) {
        return st == STORE_NONE ? STORE_OK : st; /* a job without cells */
    }
    struct sql q = sql_begin(s, "DELETE FROM study_unit WHERE study = ?1 AND lease_until = 0");
    sql_int(&q, seq);
    st = sql_run(&q);
    return st == STORE_OK ? close_study(s, seq, &state, now) : st;
}

/* -- recovery --------------------------------------------------------------------------- */

struct lost_unit {
    int64_t seq;
    int unit;
    enum job_state state;
};

static enum store_status next_lost_unit(struct store_session *s, const char *owner, int64_t now,
                                        struct lost_unit *out)
{
    struct sql q = sql_begin(s, "SELECT study, unit, state FROM study_unit JOIN job ON seq = study "
                                "WHERE lease_until > 0 AND (owner <> ?1 OR lease_until < ?2) "
                                "LIMIT 1");
    sql_text(&q, owner);
    sql_int(&q, now);
    if (!sql_row(&q)) {
        const enum store_status st = sql_end(&q);
        return st == STORE_OK ? STORE_NONE : st;
    }
    const char *state = (const char *)sqlite3_column_text(q.stmt, 2);
    out->seq = sqlite3_column_int64(q.stmt, 0);
    out->unit = sqlite3_column_int(q.stmt, 1);
    if (state == NULL || !job_state_parse(state, &out->state)) {
        q.status = STORE_CORRUPT;
    }
    return sql_end(&q);
}

enum store_status sqlite_recover_unit(struct store_session *s, const char *owner, int64_t now,
                                      struct store_recovered *count)
{
    struct lost_unit u = {.unit = 0};
    enum store_status st = next_lost_unit(s, owner, now, &u);
    if (st != STORE_OK) {
        return st;
    }
    if (u.state == JOB_CANCELLING) {
        st = remove_unit(s, u.seq, u.unit);
        if (st == STORE_OK) {
            st = close_study(s, u.seq, &u.state, now);
        }
        count->cancelled += u.state == JOB_CANCELLED;
        return st;
    }
    struct sql q = sql_begin(s, "UPDATE study_unit SET lease_until = 0, owner = '', "
                                "lost = lost + 1 WHERE study = ?1 AND unit = ?2");
    sql_int(&q, u.seq);
    sql_int(&q, u.unit);
    count->units++;
    return sql_run(&q);
}
