/* The library entries of the SQLite back end. */
#include "server/store_sqlite.h"

#include <stdlib.h>
#include <string.h>

#define ENTRY_COLUMNS "SELECT seq, name, version, hash, created_us, job, head FROM library_entry "

static enum store_status find_equal(struct store_session *s, const struct shelf_item *item,
                                    int *version)
{
    struct sql q = sql_begin(s, "SELECT version FROM library_entry "
                                "WHERE kind = ?1 AND name = ?2 AND hash = ?3");
    sql_text(&q, shelf_kind_name(item->kind));
    sql_text(&q, item->name);
    sql_text(&q, item->hash);
    const bool found = sql_row(&q);
    if (found) {
        *version = sqlite3_column_int(q.stmt, 0);
    }
    const enum store_status st = sql_end(&q);
    return st == STORE_OK && !found ? STORE_NONE : st;
}

/* The next version of a name, which counts on over what was deleted. */
static enum store_status next_version(struct store_session *s, const struct shelf_item *item,
                                      int *version)
{
    struct sql q = sql_begin(s, "INSERT INTO library_name (kind, name, newest) VALUES (?1, ?2, 1) "
                                "ON CONFLICT (kind, name) DO UPDATE SET newest = newest + 1 "
                                "RETURNING newest");
    sql_text(&q, shelf_kind_name(item->kind));
    sql_text(&q, item->name);
    if (sql_row(&q)) {
        *version = sqlite3_column_int(q.stmt, 0);
    }
    return sql_run(&q);
}

static enum store_status insert(struct store_session *s, const struct shelf_item *item, int version,
                                int64_t now)
{
    struct sql q =
        sql_begin(s, "INSERT INTO library_entry (kind, name, version, hash, created_us, job, head) "
                     "VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7)");
    sql_text(&q, shelf_kind_name(item->kind));
    sql_text(&q, item->name);
    sql_int(&q, version);
    sql_text(&q, item->hash);
    sql_int(&q, now);
    sql_text(&q, item->job);
    sql_text(&q, item->head);
    const enum store_status st = sql_run(&q);
    if (st != STORE_OK) {
        return st;
    }
    struct sql d = sql_begin(s, "INSERT INTO library_data (entry, data) VALUES (?1, ?2)");
    sql_int(&d, sqlite3_last_insert_rowid(sqlite_session_of(s)->db));
    sql_blob(&d, item->data, item->size);
    return sql_run(&d);
}

enum store_status sqlite_shelf_put(struct store_session *s, const struct shelf_item *item,
                                   int64_t now, int *version, bool *reused)
{
    enum store_status st = find_equal(s, item, version);
    *reused = st == STORE_OK;
    if (st != STORE_NONE) {
        return st;
    }
    st = next_version(s, item, version);
    return st == STORE_OK ? insert(s, item, *version, now) : st;
}

/* Does a training that is not finished need this version? Its case names it in full. */
static enum store_status find_use(struct store_session *s, const char *name, int version,
                                  bool *used)
{
    struct sql q = sql_begin(
        s, "SELECT 1 FROM queue JOIN job ON job.seq = queue.job "
           "JOIN job_case ON job_case.job = queue.job JOIN library_entry AS e "
           "ON json_extract(job_case.json, '$.training.dataset') = e.name || '@' || e.version "
           "WHERE job.kind = 'training' AND e.kind = 'dataset' AND e.name = ?1 "
           "AND (?2 = 0 OR e.version = ?2) LIMIT 1");
    sql_text(&q, name);
    sql_int(&q, version);
    *used = sql_row(&q);
    return sql_end(&q);
}

enum store_status sqlite_shelf_drop(struct store_session *s, enum shelf_kind kind, const char *name,
                                    int version)
{
    bool used = false;
    if (kind == SHELF_DATASET) {
        const enum store_status st = find_use(s, name, version, &used);
        if (st != STORE_OK || used) {
            return st != STORE_OK ? st : STORE_NOT_READY;
        }
    }
    struct sql q = sql_begin(s, "DELETE FROM library_entry WHERE kind = ?1 AND name = ?2 "
                                "AND (?3 = 0 OR version = ?3)");
    sql_text(&q, shelf_kind_name(kind));
    sql_text(&q, name);
    sql_int(&q, version);
    const enum store_status st = sql_run(&q);
    return st == STORE_OK && sqlite3_changes(sqlite_session_of(s)->db) == 0 ? STORE_NONE : st;
}

static void read_entry(struct sql *q, struct shelf_entry *out)
{
    struct shelf_entry e = {.version = sqlite3_column_int(q->stmt, 2),
                            .created_us = sqlite3_column_int64(q->stmt, 4)};
    sql_copy(q, 1, e.name, sizeof e.name);
    sql_copy(q, 3, e.hash, sizeof e.hash);
    sql_copy(q, 5, e.job, sizeof e.job);
    e.head = sql_strdup(q, 6);
    *out = e;
}

enum store_status sqlite_shelf_list(struct store_session *s, enum shelf_kind kind,
                                    struct shelf_entry **out, int *n)
{
    struct shelf_entry *list = NULL;
    int count = 0;
    struct sql q = sql_begin(s, ENTRY_COLUMNS "WHERE kind = ?1 ORDER BY name, version");
    sql_text(&q, shelf_kind_name(kind));
    while (sql_row(&q)) {
        struct shelf_entry *grown = realloc(list, ((size_t)count + 1) * sizeof *list);
        if (grown == NULL) {
            q.status = STORE_ERROR;
            break;
        }
        list = grown;
        read_entry(&q, &list[count++]);
    }
    const enum store_status st = sql_end(&q);
    if (st != STORE_OK) {
        shelf_entries_done(list, count);
        return st;
    }
    *out = list;
    *n = count;
    return STORE_OK;
}

static enum store_status read_data(struct store_session *s, int64_t seq, struct shelf_entry *e)
{
    struct sql q = sql_begin(s, "SELECT data FROM library_data WHERE entry = ?1");
    sql_int(&q, seq);
    if (sql_row(&q)) {
        const void *data = sqlite3_column_blob(q.stmt, 0);
        e->size = (size_t)sqlite3_column_bytes(q.stmt, 0);
        e->data = malloc(e->size + 1);
        if (e->data != NULL) {
            memcpy(e->data, data, e->size);
            ((char *)e->data)[e->size] = '\0';
        }
    }
    const enum store_status st = sql_end(&q);
    return st == STORE_OK && e->data == NULL ? STORE_ERROR : st;
}

enum store_status sqlite_shelf_get(struct store_session *s, enum shelf_kind kind, const char *name,
                                   int version, struct shelf_entry *out)
{
    struct shelf_entry e = {.version = 0};
    int64_t seq = 0;
    struct sql q = sql_begin(s, ENTRY_COLUMNS "WHERE kind = ?1 AND name = ?2 "
                                              "AND (?3 = 0 OR version = ?3) "
                                              "ORDER BY version DESC LIMIT 1");
    sql_text(&q, shelf_kind_name(kind));
    sql_text(&q, name);
    sql_int(&q, version);
    const bool found = sql_row(&q);
    if (found) {
        seq = sqlite3_column_int64(q.stmt, 0);
        read_entry(&q, &e);
    }
    enum store_status st = sql_end(&q);
    if (st == STORE_OK) {
        st = found ? read_data(s, seq, &e) : STORE_NONE;
    }
    if (st != STORE_OK) {
        shelf_entry_done(&e);
        return st;
    }
    *out = e;
    return STORE_OK;
}
