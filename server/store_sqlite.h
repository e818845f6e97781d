/* server/store_sqlite.h
 * Inside of the SQLite back end, shared by the store_sqlite*.c files only. */
#ifndef AEROM_SERVER_STORE_SQLITE_H
#define AEROM_SERVER_STORE_SQLITE_H

#include "server/store.h"

#include <pthread.h>
#include <sqlite3.h>

enum { SQLITE_READERS = 8, SQL_CACHE = 128, SQL_TIME_LIMIT_S = 5, SQL_LOG_PAGES = 1000 };

/* One connection with its prepared statements. */
struct sqlite_session {
    struct store_session base;
    sqlite3 *db;
    /* Statements by the address of their text, which is a constant: prepared once, then reused. */
    struct {
        const char *sql;
        sqlite3_stmt *stmt;
    } cache[SQL_CACHE];
    int n_cache;
    int log_pages;       /* writer: length of the write-ahead log after the last commit */
    int64_t deadline_us; /* monotonic; a reader's statement is interrupted after it, 0 = none */
    struct sqlite_session *next_free;
};

struct sqlite_store {
    struct store base;
    char path[1024];
    int lock_fd;
    struct sqlite_session writer;
    pthread_mutex_t mutex; /* guards free_reader and n_reader */
    pthread_cond_t returned;
    struct sqlite_session *free_reader;
    int n_reader; /* opened so far, <= SQLITE_READERS */
};

/* store_open for "sqlite:PATH". */
enum store_status sqlite_store_open(const char *path, struct store **out, char why[STORE_MESSAGE]);

/* The one place that opens a connection to the database. A writer may write and checkpoint;
 * a reader can do neither (SQLite 3.40 may corrupt the log when two connections do). */
enum store_status sqlite_connect(const char *path, bool writer, sqlite3 **out,
                                 char why[STORE_MESSAGE]);

static inline struct sqlite_session *sqlite_session_of(struct store_session *s)
{
    return (struct sqlite_session *)s; /* base is the first member */
}

/* Meaning of an SQLite result code. */
enum store_status sqlite_status(int rc);

/* A statement in use: bind, step, read, finish. The first failure sticks in `status` and turns the
 * remaining calls into no-ops, so that callers check once. Parameters are counted from 1 in the
 * order of the calls. */
struct sql {
    sqlite3_stmt *stmt;
    int bound;
    enum store_status status;
};

/* `text` must be a string constant: it is the key of the statement cache. */
struct sql sql_begin(struct store_session *s, const char *text);
void sql_int(struct sql *q, int64_t value);
void sql_real(struct sql *q, double value);
void sql_text(struct sql *q, const char *value);
void sql_blob(struct sql *q, const void *data, size_t size);
/* True when there is a row to read. */
bool sql_row(struct sql *q);
/* Ends the use; returns the status, STORE_OK when everything went well. */
enum store_status sql_end(struct sql *q);
/* Runs to the end, for statements without rows. */
enum store_status sql_run(struct sql *q);
/* Copies a text column into a fixed buffer, cut to its size. */
void sql_copy(struct sql *q, int column, char *out, size_t size);
/* Text column as malloc'ed string; sets the status to STORE_ERROR when out of memory. */
char *sql_strdup(struct sql *q, int column);

/* Sequence number of a job and its state. STORE_NONE: unknown id. */
enum store_status sqlite_find_job(struct store_session *s, const char *id, int64_t *seq,
                                  enum job_state *state);

/* Ends a job: its final state, and out of the queue with all that waits for it. */
enum store_status sqlite_finish_job(struct store_session *s, int64_t seq, enum job_state from,
                                    enum job_state to, int64_t now);
/* The only statement that changes a state; `finished` 0 keeps a job open. */
enum store_status sqlite_move_job(struct store_session *s, int64_t seq, enum job_state from,
                                  enum job_state to, int64_t finished);

/* The units of a study: made when it is accepted; taken back, STORE_NONE when none is
 * lost; the waiting ones of a study that is being cancelled taken away, which ends it unless some
 * are leased. */
enum store_status sqlite_insert_study(struct store_session *s, int64_t seq,
                                      const struct study_plan *plan);
enum store_status sqlite_recover_unit(struct store_session *s, const char *owner, int64_t now,
                                      struct store_recovered *count);
enum store_status sqlite_stop_study(struct store_session *s, int64_t seq, int64_t now);
/* Sequence number and state of the job that the ticket still holds: `lease` finds its row by
 * sequence number, unit and fence. STORE_CONFLICT when it does not. */
enum store_status sqlite_redeem(struct store_session *s, const char *lease,
                                const struct store_ticket *t, int64_t *seq, enum job_state *state);
/* The same of a unit and its study. */
enum store_status sqlite_redeem_unit(struct store_session *s, const struct store_ticket *t,
                                     int64_t *seq, enum job_state *state);

/* Number of the stored answer to an equal case; *out is unchanged when there is none. */
enum store_status sqlite_find_answer(struct store_session *s, const char *content_hash,
                                     int64_t *out);

/* Stores the result of a job whose fence has been checked. */
enum store_status sqlite_insert_result(struct store_session *s, int64_t seq, int64_t fence,
                                       const struct store_result *result, int64_t now);

/* Operations, by file. */
enum store_status sqlite_begin(struct store_session *s);
enum store_status sqlite_mark(struct store_session *s);
enum store_status sqlite_release(struct store_session *s);
enum store_status sqlite_undo(struct store_session *s);
enum store_status sqlite_commit(struct store_session *s);
void sqlite_rollback(struct store_session *s);
bool sqlite_in_transaction(struct store_session *s);
enum store_status sqlite_checkpoint(struct store_session *s, enum store_tidy when);

enum store_status sqlite_submit(struct store_session *s, const struct service_submit *item,
                                const char *new_id, int64_t now, struct service_submitted *out);
enum store_status sqlite_claim(struct store_session *s, const char *owner, int64_t now,
                               int64_t lease_until, struct store_claim *out);
enum store_status sqlite_heartbeat(struct store_session *s, const struct store_ticket *t,
                                   int64_t lease_until);
enum store_status sqlite_claim_unit(struct store_session *s, const char *owner, int64_t now,
                                    int64_t lease_until, struct store_claim *out);
enum store_status sqlite_publish_cells(struct store_session *s, const struct store_ticket *t,
                                       const struct store_batch *batch, int64_t now,
                                       struct store_progress *out);
enum store_status sqlite_get_study(struct store_session *s, const char *id,
                                   struct service_study *out);
enum store_status sqlite_get_cells(struct store_session *s, const char *id, int from, int limit,
                                   bool summaries, struct store_cell_row **out, int *n);
enum store_status sqlite_find_known(struct store_session *s, const char *content_hash,
                                    struct store_known *out);
enum store_status sqlite_read_known(struct store_session *s, int64_t known, char **summary);
enum store_status sqlite_publish(struct store_session *s, const struct store_ticket *t,
                                 const struct store_result *result, int64_t now);
enum store_status sqlite_fail(struct store_session *s, const struct store_ticket *t,
                              const char *code, const char *detail, int64_t now);
enum store_status sqlite_hand_back(struct store_session *s, const struct store_ticket *t);
enum store_status sqlite_stopped(struct store_session *s, const struct store_ticket *t,
                                 int64_t now);
enum store_status sqlite_cancel(struct store_session *s, const char *id, int64_t now,
                                struct job_record *out);
enum store_status sqlite_recover(struct store_session *s, const char *owner, int64_t now,
                                 int attempts_max, struct store_recovered *out);

enum store_status sqlite_get(struct store_session *s, const char *id, struct job_record *out);
enum store_status sqlite_list(struct store_session *s, const struct service_filter *filter,
                              struct job_record **out, int *n, bool *more);
enum store_status sqlite_get_case(struct store_session *s, const char *id, char **json);
enum store_status sqlite_get_document(struct store_session *s, const char *id, const char *name,
                                      char **json);
enum store_status sqlite_get_series(struct store_session *s, const char *id,
                                    struct series_data *out);
enum store_status sqlite_get_samples(struct store_session *s, const char *id, int position,
                                     int from, int n, double *value);
enum store_status sqlite_depth(struct store_session *s, int64_t *out);
enum store_status sqlite_newest_id(struct store_session *s, char out[JOB_ID_SIZE]);

enum store_status sqlite_shelf_put(struct store_session *s, const struct shelf_item *item,
                                   int64_t now, int *version, bool *reused);
enum store_status sqlite_shelf_drop(struct store_session *s, enum shelf_kind kind, const char *name,
                                    int version);
enum store_status sqlite_shelf_list(struct store_session *s, enum shelf_kind kind,
                                    struct shelf_entry **out, int *n);
enum store_status sqlite_shelf_get(struct store_session *s, enum shelf_kind kind, const char *name,
                                   int version, struct shelf_entry *out);

#endif
