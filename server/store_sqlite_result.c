/* Writes of the SQLite back end: what a finished job leaves behind. */
#include "server/store_sqlite.h"

static enum store_status insert_documents(struct store_session *s, int64_t seq, int64_t fence,
                                          const struct store_result *result, int64_t now)
{
    struct sql q = sql_begin(s, "INSERT INTO result (job, fence, finished_us, cpu_s) "
                                "VALUES (?1, ?2, ?3, ?4)");
    sql_int(&q, seq);
    sql_int(&q, fence);
    sql_int(&q, now);
    sql_real(&q, result->cpu_s);
    enum store_status st = sql_run(&q);
    for (int i = 0; st == STORE_OK && i < result->n_document; i++) {
        struct sql d = sql_begin(s, "INSERT INTO document (job, name, json) VALUES (?1, ?2, ?3)");
        sql_int(&d, seq);
        sql_text(&d, result->document[i].name);
        sql_text(&d, result->document[i].json);
        st = sql_run(&d);
    }
    if (st == STORE_OK) {
        struct sql v = sql_begin(s, "UPDATE job SET verdict = ?1 WHERE seq = ?2");
        sql_text(&v, result->verdict);
        sql_int(&v, seq);
        st = sql_run(&v);
    }
    return st;
}

static enum store_status insert_column(struct store_session *s, int64_t seq, int position,
                                       const struct store_column *column, int n_chunk)
{
    struct sql c = sql_begin(s, "INSERT INTO series_column (job, position, name) "
                                "VALUES (?1, ?2, ?3)");
    sql_int(&c, seq);
    sql_int(&c, position);
    sql_text(&c, column->name);
    enum store_status st = sql_run(&c);
    for (int i = 0; st == STORE_OK && i < n_chunk; i++) {
        const struct series_chunk *chunk = &column->chunk[i];
        struct sql q = sql_begin(s, "INSERT INTO series_chunk (job, position, chunk, codec, n, "
                                    "checksum, data) VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7)");
        sql_int(&q, seq);
        sql_int(&q, position);
        sql_int(&q, i);
        sql_int(&q, chunk->codec);
        sql_int(&q, chunk->n);
        sql_int(&q, (int64_t)chunk->checksum);
        sql_blob(&q, chunk->data, chunk->size);
        st = sql_run(&q);
    }
    return st;
}

static enum store_status insert_series(struct store_session *s, int64_t seq,
                                       const struct store_series *series)
{
    struct sql q = sql_begin(s, "INSERT INTO series (job, t0, step, n, n_column) "
                                "VALUES (?1, ?2, ?3, ?4, ?5)");
    sql_int(&q, seq);
    sql_real(&q, series->t0);
    sql_real(&q, series->step);
    sql_int(&q, series->n);
    sql_int(&q, series->n_column);
    enum store_status st = sql_run(&q);
    for (int j = 0; st == STORE_OK && j < series->n_column; j++) {
        st = insert_column(s, seq, j, &series->column[j], series_chunks(series->n));
    }
    return st;
}

enum store_status sqlite_insert_result(struct store_session *s, int64_t seq, int64_t fence,
                                       const struct store_result *result, int64_t now)
{
    enum store_status st = insert_documents(s, seq, fence, result, now);
    if (st == STORE_OK && result->series != NULL) {
        st = insert_series(s, seq, result->series);
    }
    return st;
}
