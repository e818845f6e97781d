/* Reads of the SQLite back end: studies and their cells. */
#include "api/pack.h"
#include "server/store_sqlite.h"

#include <stdlib.h>
#include <string.h>

enum store_status sqlite_get_study(struct store_session *s, const char *id,
                                   struct service_study *out)
{
    struct sql q = sql_begin(s, "SELECT n_cell, done, failed, reused, cpu_s FROM study "
                                "WHERE job = (SELECT seq FROM job WHERE id = ?1)");
    sql_text(&q, id);
    const bool found = sql_row(&q);
    if (found) {
        *out = (struct service_study){.n_cell = sqlite3_column_int(q.stmt, 0),
                                      .done = sqlite3_column_int(q.stmt, 1),
                                      .failed = sqlite3_column_int(q.stmt, 2),
                                      .reused = sqlite3_column_int(q.stmt, 3),
                                      .cpu_s = sqlite3_column_double(q.stmt, 4)};
    }
    const enum store_status st = sql_end(&q);
    return st == STORE_OK && !found ? STORE_NONE : st;
}

/* A text that may lie in one of two tables' rows; the blob is copied. */
static void read_summary(struct sql *q, struct store_cell_row *row)
{
    const void *data = sqlite3_column_blob(q->stmt, 9);
    row->size = (size_t)sqlite3_column_int64(q->stmt, 8);
    row->packed_size = (size_t)sqlite3_column_bytes(q->stmt, 9);
    if (data == NULL || row->packed_size == 0) {
        return;
    }
    row->packed = malloc(row->packed_size);
    if (row->packed == NULL) {
        q->status = STORE_ERROR;
        return;
    }
    memcpy(row->packed, data, row->packed_size);
}

static void read_cell(struct sql *q, struct store_cell_row *row)
{
    struct service_cell *c = &row->cell;
    const char *state = (const char *)sqlite3_column_text(q->stmt, 3);
    c->cell = sqlite3_column_int(q->stmt, 0);
    c->reused = sqlite3_column_int(q->stmt, 1) != 0;
    c->state = state != NULL && strcmp(state, "done") == 0 ? STUDY_CELL_DONE : STUDY_CELL_FAILED;
    sql_copy(q, 2, c->content_hash, sizeof c->content_hash);
    sql_copy(q, 4, c->verdict, sizeof c->verdict);
    sql_copy(q, 5, c->error_code, sizeof c->error_code);
    sql_copy(q, 6, c->error_detail, sizeof c->error_detail);
    c->cpu_s = sqlite3_column_double(q->stmt, 7);
    read_summary(q, row);
}

#define CELL_COLUMNS                                                                               \
    "SELECT cell, reused, content_hash, state, verdict, error_code, error_detail, cpu_s, size, "
#define CELL_ROWS                                                                                  \
    " FROM study_cell JOIN cell_result ON id = result "                                            \
    "WHERE study = (SELECT seq FROM job WHERE job.id = ?1) AND cell >= ?2 ORDER BY cell LIMIT ?3"

enum store_status sqlite_get_cells(struct store_session *s, const char *id, int from, int limit,
                                   bool summaries, struct store_cell_row **out, int *n)
{
    struct store_cell_row *rows = calloc((size_t)limit + 1, sizeof *rows);
    if (rows == NULL) {
        return STORE_ERROR;
    }
    struct sql q =
        sql_begin(s, summaries ? CELL_COLUMNS "summary" CELL_ROWS : CELL_COLUMNS "NULL" CELL_ROWS);
    sql_text(&q, id);
    sql_int(&q, from);
    sql_int(&q, limit);
    int count = 0;
    while (sql_row(&q)) {
        read_cell(&q, &rows[count++]);
    }
    const enum store_status st = sql_end(&q);
    if (st != STORE_OK) {
        for (int i = 0; i < count; i++) {
            free(rows[i].packed);
        }
        free(rows);
        return st;
    }
    *out = rows;
    *n = count;
    return STORE_OK;
}

enum store_status sqlite_find_answer(struct store_session *s, const char *content_hash,
                                     int64_t *out)
{
    struct sql q = sql_begin(s, "SELECT id FROM cell_result WHERE content_hash = ?1 "
                                "AND state = 'done'");
    sql_text(&q, content_hash);
    if (sql_row(&q)) {
        *out = sqlite3_column_int64(q.stmt, 0);
    }
    return sql_end(&q);
}

enum store_status sqlite_find_known(struct store_session *s, const char *content_hash,
                                    struct store_known *out)
{
    struct store_known known = {.known = 0};
    enum store_status st = sqlite_find_answer(s, content_hash, &known.known);
    if (st == STORE_OK && known.known == 0) {
        struct sql j = sql_begin(s, "SELECT verdict, json FROM job JOIN document ON job = seq "
                                    "WHERE content_hash = ?1 "
                                    "AND state IN ('queued', 'running', 'done') "
                                    "AND state = 'done' AND document.name = 'summary'");
        sql_text(&j, content_hash);
        if (sql_row(&j)) {
            sql_copy(&j, 0, known.verdict, sizeof known.verdict);
            known.summary = sql_strdup(&j, 1);
        }
        st = sql_end(&j);
    }
    if (st == STORE_OK && known.known == 0 && known.summary == NULL) {
        return STORE_NONE;
    }
    if (st == STORE_OK) {
        *out = known;
    } else {
        free(known.summary);
    }
    return st;
}

enum store_status sqlite_read_known(struct store_session *s, int64_t known, char **summary)
{
    char *text = NULL;
    struct sql q = sql_begin(s, "SELECT summary, size FROM cell_result WHERE id = ?1");
    sql_int(&q, known);
    const bool found = sql_row(&q);
    if (found) {
        text = unpack_text(sqlite3_column_blob(q.stmt, 0), (size_t)sqlite3_column_bytes(q.stmt, 0),
                           (size_t)sqlite3_column_int64(q.stmt, 1));
    }
    enum store_status st = sql_end(&q);
    if (st == STORE_OK && text == NULL) {
        st = found ? STORE_CORRUPT : STORE_NONE;
    }
    if (st == STORE_OK) {
        *summary = text;
    } else {
        free(text);
    }
    return st;
}
