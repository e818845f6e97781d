/* Reads of the SQLite back end: jobs, cases, results. */
#include "server/job.h"
#include "server/store_sqlite.h"

#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define JOB_COLUMNS                                                                                \
    "SELECT id, kind, state, name, content_hash, attempt, created_us, started_us, finished_us, "   \
    "verdict, error_code, error_detail, "                                                          \
    "(SELECT (done + failed) / CAST(n_cell AS REAL) FROM study WHERE study.job = seq) FROM job "

static void read_job(struct sql *q, struct job_record *out)
{
    struct job_record job = {.attempt = sqlite3_column_int(q->stmt, 5),
                             .created_us = sqlite3_column_int64(q->stmt, 6),
                             .started_us = sqlite3_column_int64(q->stmt, 7),
                             .finished_us = sqlite3_column_int64(q->stmt, 8)};
    const char *kind = (const char *)sqlite3_column_text(q->stmt, 1);
    const char *state = (const char *)sqlite3_column_text(q->stmt, 2);
    if (kind == NULL || !job_kind_parse(kind, &job.kind) || state == NULL ||
        !job_state_parse(state, &job.state)) {
        q->status = STORE_CORRUPT;
        return;
    }
    sql_copy(q, 0, job.id, sizeof job.id);
    sql_copy(q, 3, job.name, sizeof job.name);
    sql_copy(q, 4, job.content_hash, sizeof job.content_hash);
    sql_copy(q, 9, job.verdict, sizeof job.verdict);
    sql_copy(q, 10, job.error_code, sizeof job.error_code);
    sql_copy(q, 11, job.error_detail, sizeof job.error_detail);
    job.progress = job.state == JOB_DONE ? 1.0 : sqlite3_column_double(q->stmt, 12);
    *out = job;
}

enum store_status sqlite_get(struct store_session *s, const char *id, struct job_record *out)
{
    struct sql q = sql_begin(s, JOB_COLUMNS "WHERE id = ?1");
    sql_text(&q, id);
    const bool found = sql_row(&q);
    if (found) {
        read_job(&q, out);
    }
    const enum store_status st = sql_end(&q);
    return st == STORE_OK && !found ? STORE_NONE : st;
}

/* -- list: one constant statement for each set of filters ------------------------------- */

#define F_STATE "AND state = ?2 "
#define F_KIND "AND kind = ?3 "
#define F_NAME "AND name = ?4 AND name <> '' "
#define LIST(filters) JOB_COLUMNS "WHERE seq < ?1 " filters "ORDER BY seq DESC LIMIT ?5"

enum { BY_STATE = 1, BY_KIND = 2, BY_NAME = 4, LIST_COUNT = 8 };

static const char *const lists[LIST_COUNT] = {
    LIST(""),     LIST(F_STATE),        LIST(F_KIND),        LIST(F_STATE F_KIND),
    LIST(F_NAME), LIST(F_STATE F_NAME), LIST(F_KIND F_NAME), LIST(F_STATE F_KIND F_NAME),
};

/* Parameters are numbered, so an absent filter leaves its number unused: bind by number. */
static void bind_list(struct sql *q, const struct service_filter *f, int64_t before)
{
    const int n = sqlite3_bind_parameter_count(q->stmt);
    assert(n == 5); /* the limit is ?5 in every statement */
    int rc = sqlite3_bind_int64(q->stmt, 1, before);
    if (rc == SQLITE_OK && f->state >= 0) {
        rc = sqlite3_bind_text(q->stmt, 2, job_state_name((enum job_state)f->state), -1,
                               SQLITE_STATIC);
    }
    if (rc == SQLITE_OK && f->kind >= 0) {
        rc = sqlite3_bind_text(q->stmt, 3, job_kind_name(f->kind), -1, SQLITE_STATIC);
    }
    if (rc == SQLITE_OK && f->name != NULL) {
        rc = sqlite3_bind_text(q->stmt, 4, f->name, -1, SQLITE_STATIC);
    }
    if (rc == SQLITE_OK) {
        rc = sqlite3_bind_int64(q->stmt, 5,
                                (int64_t)f->limit + 1); /* one more tells of a next page */
    }
    if (rc != SQLITE_OK) {
        q->status = sqlite_status(rc);
    }
}

enum store_status sqlite_list(struct store_session *s, const struct service_filter *filter,
                              struct job_record **out, int *n, bool *more)
{
    int64_t before = INT64_MAX;
    if (filter->after != NULL) {
        enum job_state state;
        const enum store_status st = sqlite_find_job(s, filter->after, &before, &state);
        if (st != STORE_OK) {
            return st;
        }
    }
    struct job_record *rows = calloc((size_t)filter->limit + 1, sizeof *rows);
    if (rows == NULL) {
        return STORE_ERROR;
    }
    struct sql q =
        sql_begin(s, lists[(filter->state >= 0 ? BY_STATE : 0) | (filter->kind >= 0 ? BY_KIND : 0) |
                           (filter->name != NULL ? BY_NAME : 0)]);
    if (q.status == STORE_OK) {
        bind_list(&q, filter, before);
    }
    int count = 0;
    while (sql_row(&q)) {
        read_job(&q, &rows[count++]);
    }
    const enum store_status st = sql_end(&q);
    if (st != STORE_OK) {
        free(rows);
        return st;
    }
    *more = count > filter->limit;
    *n = *more ? filter->limit : count;
    *out = rows;
    return STORE_OK;
}

/* -- cases and results ------------------------------------------------------------------ */

static enum store_status read_text(struct sql *q, char **out)
{
    char *text = NULL;
    const bool found = sql_row(q);
    if (found) {
        text = sql_strdup(q, 0);
    }
    const enum store_status st = sql_end(q);
    if (st != STORE_OK || !found) {
        free(text);
        return st == STORE_OK ? STORE_NONE : st;
    }
    *out = text;
    return STORE_OK;
}

enum store_status sqlite_get_case(struct store_session *s, const char *id, char **json)
{
    struct sql q = sql_begin(s, "SELECT json FROM job_case JOIN job ON seq = job WHERE id = ?1");
    sql_text(&q, id);
    return read_text(&q, json);
}

/* Why a result is absent: no such job, or no result (yet), or the kind has none of this name. */
static enum store_status absent(struct store_session *s, const char *id)
{
    int64_t seq = 0;
    enum job_state state;
    const enum store_status st = sqlite_find_job(s, id, &seq, &state);
    if (st != STORE_OK) {
        return st;
    }
    return state == JOB_DONE ? STORE_NONE : STORE_NOT_READY;
}

enum store_status sqlite_get_document(struct store_session *s, const char *id, const char *name,
                                      char **json)
{
    struct sql q = sql_begin(s, "SELECT document.json FROM document JOIN job ON seq = job "
                                "WHERE id = ?1 AND document.name = ?2");
    sql_text(&q, id);
    sql_text(&q, name);
    const enum store_status st = read_text(&q, json);
    return st == STORE_NONE ? absent(s, id) : st;
}

static enum store_status read_columns(struct store_session *s, const char *id,
                                      struct series_data *data)
{
    struct sql q = sql_begin(s, "SELECT series_column.name FROM series_column "
                                "JOIN job ON seq = job WHERE id = ?1 ORDER BY position");
    sql_text(&q, id);
    int j = 0;
    while (sql_row(&q) && j < data->n_column) {
        sql_copy(&q, 0, data->column[j].name, sizeof data->column[j].name);
        j++;
    }
    if (q.status == STORE_OK && j != data->n_column) {
        q.status = STORE_CORRUPT;
    }
    return sql_end(&q);
}

enum store_status sqlite_get_series(struct store_session *s, const char *id,
                                    struct series_data *out)
{
    struct series_data data = {.n = 0};
    struct sql q = sql_begin(s, "SELECT t0, step, n, n_column FROM series JOIN job ON seq = job "
                                "WHERE id = ?1");
    sql_text(&q, id);
    const bool found = sql_row(&q);
    if (found) {
        data.t0 = sqlite3_column_double(q.stmt, 0);
        data.step = sqlite3_column_double(q.stmt, 1);
        data.n = sqlite3_column_int(q.stmt, 2);
        data.n_column = sqlite3_column_int(q.stmt, 3);
    }
    enum store_status st = sql_end(&q);
    if (st != STORE_OK || !found) {
        return st == STORE_OK ? absent(s, id) : st;
    }
    data.column = calloc((size_t)data.n_column + 1, sizeof *data.column);
    if (data.column == NULL) {
        return STORE_ERROR;
    }
    st = read_columns(s, id, &data);
    if (st != STORE_OK) {
        free(data.column);
        return st;
    }
    *out = data;
    return STORE_OK;
}

/* Decodes one stored chunk and copies what lies in [from, from + n) to value. */
static enum store_status read_chunk(struct sql *q, int from, int n, double *value)
{
    const int64_t first = sqlite3_column_int64(q->stmt, 0) * SERIES_CHUNK;
    const struct series_chunk chunk = {
        .codec = (enum series_codec)sqlite3_column_int(q->stmt, 1),
        .n = sqlite3_column_int(q->stmt, 2),
        .checksum = (uint64_t)sqlite3_column_int64(q->stmt, 3),
        .data = sqlite3_column_blob(q->stmt, 4),
        .size = (size_t)sqlite3_column_bytes(q->stmt, 4),
    };
    double sample[SERIES_CHUNK];
    if (series_decode(&chunk, sample) != ST_OK) {
        return STORE_CORRUPT;
    }
    const int64_t lo = first > from ? first : from;
    const int64_t end = (int64_t)from + n;
    const int64_t hi = first + chunk.n < end ? first + chunk.n : end;
    if (hi > lo) {
        memcpy(value + (lo - from), sample + (lo - first), (size_t)(hi - lo) * sizeof *value);
    }
    return STORE_OK;
}

enum store_status sqlite_get_samples(struct store_session *s, const char *id, int position,
                                     int from, int n, double *value)
{
    struct sql q = sql_begin(s, "SELECT chunk, codec, n, checksum, data FROM series_chunk "
                                "WHERE job = (SELECT seq FROM job WHERE id = ?1) "
                                "AND position = ?2 AND chunk BETWEEN ?3 AND ?4 ORDER BY chunk");
    const int first = from / SERIES_CHUNK;
    const int last = (from + n - 1) / SERIES_CHUNK;
    sql_text(&q, id);
    sql_int(&q, position);
    sql_int(&q, first);
    sql_int(&q, last);
    int found = 0;
    while (sql_row(&q)) {
        const enum store_status st = read_chunk(&q, from, n, value);
        if (st != STORE_OK) {
            q.status = st;
        }
        found++;
    }
    if (q.status == STORE_OK && found != last - first + 1) {
        q.status = STORE_CORRUPT; /* a chunk is missing */
    }
    return sql_end(&q);
}

enum store_status sqlite_depth(struct store_session *s, int64_t *out)
{
    struct sql q = sql_begin(s, "SELECT (SELECT count(*) FROM queue) + "
                                "(SELECT count(*) FROM study WHERE open = 1)");
    if (sql_row(&q)) {
        *out = sqlite3_column_int64(q.stmt, 0);
    }
    return sql_end(&q);
}

enum store_status sqlite_newest_id(struct store_session *s, char out[JOB_ID_SIZE])
{
    struct sql q =
        sql_begin(s, "SELECT coalesce((SELECT id FROM job ORDER BY seq DESC LIMIT 1), '')");
    if (sql_row(&q)) {
        sql_copy(&q, 0, out, JOB_ID_SIZE);
    }
    return sql_end(&q);
}
