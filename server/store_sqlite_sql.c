/* Statements, transactions and status codes of the SQLite back end. */
#include "server/clock.h"
#include "server/store_sqlite.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

enum store_status sqlite_status(int rc)
{
    switch (rc & 0xff) {
    case SQLITE_OK:
    case SQLITE_ROW:
    case SQLITE_DONE:
        return STORE_OK;
    case SQLITE_FULL:
        return STORE_FULL;
    case SQLITE_CORRUPT:
    case SQLITE_NOTADB:
        return STORE_CORRUPT;
    default:
        return STORE_ERROR;
    }
}

static sqlite3_stmt *prepared(struct sqlite_session *s, const char *text)
{
    for (int i = 0; i < s->n_cache; i++) {
        if (s->cache[i].sql == text) {
            return s->cache[i].stmt;
        }
    }
    assert(s->n_cache < SQL_CACHE); /* more constants than places: enlarge SQL_CACHE */
    sqlite3_stmt *stmt = NULL;
    if (sqlite3_prepare_v3(s->db, text, -1, SQLITE_PREPARE_PERSISTENT, &stmt, NULL) != SQLITE_OK) {
        return NULL;
    }
    s->cache[s->n_cache].sql = text;
    s->cache[s->n_cache++].stmt = stmt;
    return stmt;
}

struct sql sql_begin(struct store_session *s, const char *text)
{
    struct sqlite_session *session = sqlite_session_of(s);
    struct sql q = {.stmt = prepared(session, text)};
    if (q.stmt == NULL) {
        q.status = sqlite_status(sqlite3_extended_errcode(session->db));
    }
    return q;
}

static void keep(struct sql *q, int rc)
{
    if (rc != SQLITE_OK) {
        q->status = sqlite_status(rc);
    }
}

void sql_int(struct sql *q, int64_t value)
{
    if (q->status == STORE_OK) {
        keep(q, sqlite3_bind_int64(q->stmt, ++q->bound, value));
    }
}

void sql_real(struct sql *q, double value)
{
    if (q->status == STORE_OK) {
        keep(q, sqlite3_bind_double(q->stmt, ++q->bound, value));
    }
}

void sql_text(struct sql *q, const char *value)
{
    if (q->status == STORE_OK) {
        keep(q, sqlite3_bind_text(q->stmt, ++q->bound, value, -1, SQLITE_STATIC));
    }
}

void sql_blob(struct sql *q, const void *data, size_t size)
{
    if (q->status == STORE_OK) {
        keep(q, sqlite3_bind_blob64(q->stmt, ++q->bound, data, size, SQLITE_STATIC));
    }
}

bool sql_row(struct sql *q)
{
    if (q->status != STORE_OK) {
        return false;
    }
    const int rc = sqlite3_step(q->stmt);
    if (rc == SQLITE_ROW) {
        return true;
    }
    if (rc != SQLITE_DONE) {
        q->status = sqlite_status(rc);
    }
    return false;
}

enum store_status sql_end(struct sql *q)
{
    if (q->stmt != NULL) {
        (void)sqlite3_reset(q->stmt); /* repeats the error of the last step */
        (void)sqlite3_clear_bindings(q->stmt);
    }
    return q->status;
}

enum store_status sql_run(struct sql *q)
{
    while (sql_row(q)) {
    }
    return sql_end(q);
}

void sql_copy(struct sql *q, int column, char *out, size_t size)
{
    const unsigned char *text = sqlite3_column_text(q->stmt, column);
    const size_t n = text != NULL ? (size_t)sqlite3_column_bytes(q->stmt, column) : 0;
    const size_t kept = n < size ? n : size - 1;
    if (kept > 0) {
        memcpy(out, text, kept);
    }
    out[kept] = '\0';
}

char *sql_strdup(struct sql *q, int column)
{
    const unsigned char *text = sqlite3_column_text(q->stmt, column);
    char *copy = text != NULL ? strdup((const char *)text) : NULL;
    if (copy == NULL) {
        q->status = STORE_ERROR;
    }
    return copy;
}

static enum store_status run_text(struct store_session *s, const char *text)
{
    struct sql q = sql_begin(s, text);
    return sql_run(&q);
}

enum store_status sqlite_begin(struct store_session *s)
{
    return run_text(s, "BEGIN IMMEDIATE");
}

enum store_status sqlite_mark(struct store_session *s)
{
    return run_text(s, "SAVEPOINT request");
}

enum store_status sqlite_release(struct store_session *s)
{
    return run_text(s, "RELEASE request");
}

enum store_status sqlite_undo(struct store_session *s)
{
    const enum store_status st = run_text(s, "ROLLBACK TO request");
    return st == STORE_OK ? run_text(s, "RELEASE request") : st;
}

enum store_status sqlite_commit(struct store_session *s)
{
    return run_text(s, "COMMIT");
}

void sqlite_rollback(struct store_session *s)
{
    if (sqlite_in_transaction(s)) {
        (void)run_text(s, "ROLLBACK");
    }
}

bool sqlite_in_transaction(struct store_session *s)
{
    return sqlite3_get_autocommit(sqlite_session_of(s)->db) == 0;
}

enum store_status sqlite_checkpoint(struct store_session *s, enum store_tidy when)
{
    struct sqlite_session *session = sqlite_session_of(s);
    if (when == STORE_TIDY_BUSY ? session->log_pages < SQL_LOG_PAGES : session->log_pages == 0) {
        return STORE_OK;
    }
    const int mode =
        when == STORE_TIDY_CLOSE ? SQLITE_CHECKPOINT_TRUNCATE : SQLITE_CHECKPOINT_PASSIVE;
    const int rc = sqlite3_wal_checkpoint_v2(session->db, NULL, mode, NULL, NULL);
    session->log_pages = 0; /* counted anew by the next commit */
    /* Readers in the log only mean that less could be moved. */
    return (rc & 0xff) == SQLITE_BUSY ? STORE_OK : sqlite_status(rc);
}
