/* server/store.h
 * Durable storage of jobs, their queue and their results: what the server needs of a back end.
 * Nothing above this interface knows SQL; one test suite runs against every back end.
 *
 * A struct store is one open database, shared by all threads. A struct store_session is one
 * connection and belongs to one thread at a time. There is exactly one writer session; only it may
 * be given to the functions of the groups "transactions" and "writes". Reader sessions are borrowed
 * for one call from a pool. Statuses say what happened; store_session_message has the details of
 * the last failure of a session for the log. Outputs are unchanged unless the status is STORE_OK.
 */
#ifndef AEROM_SERVER_STORE_H
#define AEROM_SERVER_STORE_H

#include "api/service.h"
#include "api/shelf.h"
#include "server/series.h"

enum store_status {
    STORE_OK,
    STORE_NONE,      /* no such row */
    STORE_CONFLICT,  /* the caller no longer owns the job, or the move is not allowed */
    STORE_NOT_READY, /* the job has no result (yet) */
    STORE_FULL,      /* no space on the device */
    STORE_LOCKED,    /* another process has the database open */
    STORE_REFUSED,   /* not our database, a newer schema, a changed migration, a bad location */
    STORE_CORRUPT,   /* stored data fail their check */
    STORE_ERROR      /* everything else */
};

enum { STORE_MESSAGE = 512 };

/* A claimed job, or unit of a study: the right to publish its result until the lease ends or the
 * fence moves on. Fences of all units of a study differ. */
struct store_ticket {
    char id[JOB_ID_SIZE];
    int unit; /* from 1; 0 = the whole job */
    int64_t fence;
};

struct store_claim {
    struct store_ticket ticket;
    int kind; /* job_kind_name */
    int attempt;
    char *case_json; /* of the case or the study; owned by the caller, free() */
    int next, last;  /* unit: places [next, last) of the order of cells are left to compute */
    int lost;        /* unit: claims in a row that ended without an answer for `next` */
};

/* What a finished cell leaves behind; borrowed for the call. */
struct store_cell {
    int cell; /* -1: of none, an answer that later searches may use */
    bool reused;
    int64_t known; /* the answer that is stored already; 0 = the members below are stored */
    enum study_cell_state state;
    const char *content_hash, *verdict, *error_code, *error_detail;
    double cpu_s;
    const void *summary; /* packed (api/pack.h); none when failed */
    size_t summary_size, summary_packed;
};

/* What becomes of a unit after some of its cells are stored. */
enum store_unit_move {
    STORE_UNIT_KEEP,    /* the lease goes on */
    STORE_UNIT_YIELD,   /* the same, unless others wait: then it waits with them */
    STORE_UNIT_RELEASE, /* it waits again */
};

struct store_batch {
    int n;
    const struct store_cell *cell;
    int next; /* places of the unit before it are done; at its end the unit is */
    enum store_unit_move move;
};

struct store_progress {
    bool kept;            /* the lease still holds */
    enum job_state state; /* of the study */
};

/* An answer to an equal case: either `known`, or the summary of a job. */
struct store_known {
    int64_t known;
    char verdict[24];
    char *summary; /* JSON text of a job's summary, owned by the caller; else NULL */
};

/* A stored cell as it is read: service_cell with its summary packed. */
struct store_cell_row {
    struct service_cell cell;
    void *packed; /* owned; NULL when there is none or it was not asked for */
    size_t packed_size, size;
};

struct store_document {
    const char *name; /* "summary" ... */
    const char *json;
};

struct store_column {
    char name[64];
    const struct series_chunk *chunk; /* (series_chunks(n)) */
};

struct store_series {
    double t0, step; /* [s] */
    int n;           /* samples of each column */
    int n_column;
    const struct store_column *column;
};

/* All a finished job leaves behind; borrowed for the call. */
struct store_result {
    const char *verdict; /* "" when the kind has none */
    double cpu_s;
    int n_document;
    const struct store_document *document;
    const struct store_series *series; /* NULL when the kind records nothing */
    const struct shelf_item *entry;    /* network that a training made, else NULL */
};

/* What became of the jobs a previous process, or a lost worker, had claimed. */
struct store_recovered {
    int queued;    /* to be run again */
    int failed;    /* attempts used up: failed with code "lost" */
    int cancelled; /* were being cancelled */
    int units;     /* of studies, to be run again */
};

/* When the writer offers to tidy up its log. */
enum store_tidy {
    STORE_TIDY_BUSY, /* after a commit with more work waiting: only when the log is long */
    STORE_TIDY_IDLE, /* nothing to do */
    STORE_TIDY_CLOSE /* before the end: also empty the log */
};

struct store_ops;
struct store;

struct store_session {
    const struct store_ops *ops;
};

struct store_ops {
    /* -- sessions ----------------------------------------------------------------------- */
    /* The writer session; always the same one. */
    struct store_session *(*writer)(struct store *st);
    /* Borrows a reader, waiting for one when all are out; NULL when none can be opened. */
    struct store_session *(*reader_take)(struct store *st);
    void (*reader_give)(struct store *st, struct store_session *s);
    const char *(*message)(const struct store_session *s);
    /* Bytes free for the database, -1 when unknown. */
    int64_t (*space)(struct store *st);
    void (*close)(struct store *st);

    /* -- transactions: begin, for each request mark + (release or undo), then commit ---- */
    enum store_status (*begin)(struct store_session *s);
    enum store_status (*mark)(struct store_session *s);
    enum store_status (*release)(struct store_session *s);
    enum store_status (*undo)(struct store_session *s);   /* back to the mark, mark removed */
    enum store_status (*commit)(struct store_session *s); /* durable on STORE_OK */
    void (*rollback)(struct store_session *s);
    /* False once a failure has rolled the whole transaction back. */
    bool (*in_transaction)(struct store_session *s);
    /* Moves the log into the database file as far as its readers allow, when it is due. */
    enum store_status (*checkpoint)(struct store_session *s, enum store_tidy when);

    /* -- writes, inside a transaction; all times are wall microseconds ------------------ */
    /* Accepts one case under the given new id, or finds the job that answers an equal one. */
    enum store_status (*submit)(struct store_session *s, const struct service_submit *item,
                                const char *new_id, int64_t now, struct service_submitted *out);
    /* The oldest waiting job, leased to `owner`. STORE_NONE: nothing waits. */
    enum store_status (*claim)(struct store_session *s, const char *owner, int64_t now,
                               int64_t lease_until, struct store_claim *out);
    /* The first waiting unit of the open study that was served longest ago; as claim. */
    enum store_status (*claim_unit)(struct store_session *s, const char *owner, int64_t now,
                                    int64_t lease_until, struct store_claim *out);
    /* Extends a lease. STORE_CONFLICT: the ticket is no longer valid. */
    enum store_status (*heartbeat)(struct store_session *s, const struct store_ticket *t,
                                   int64_t lease_until);
    /* The ends of a claim; STORE_CONFLICT when the ticket is no longer valid, or the job is being
     * cancelled and the end is another one than `stopped`. */
    enum store_status (*publish)(struct store_session *s, const struct store_ticket *t,
                                 const struct store_result *result, int64_t now);
    enum store_status (*fail)(struct store_session *s, const struct store_ticket *t,
                              const char *code, const char *detail, int64_t now);
    enum store_status (*hand_back)(struct store_session *s, const struct store_ticket *t);
    enum store_status (*stopped)(struct store_session *s, const struct store_ticket *t,
                                 int64_t now);
    /* Stores finished cells of a unit; a cell that is stored already stays as it is. With the last
     * unit its study ends. STORE_CONFLICT: as above. `fail` with the ticket of a unit fails the
     * whole study. */
    enum store_status (*publish_cells)(struct store_session *s, const struct store_ticket *t,
                                       const struct store_batch *batch, int64_t now,
                                       struct store_progress *out);
    /* Idempotent; *out is the job afterwards. STORE_NONE: no such job. */
    enum store_status (*cancel)(struct store_session *s, const char *id, int64_t now,
                                struct job_record *out);
    /* Takes back every lease of another owner, and those of this one that ran out before `now`. */
    enum store_status (*recover)(struct store_session *s, const char *owner, int64_t now,
                                 int attempts_max, struct store_recovered *out);

    /* Library. A new version, or the one of equal content. STORE_NOT_READY: a training needs it. */
    enum store_status (*shelf_put)(struct store_session *s, const struct shelf_item *item,
                                   int64_t now, int *version, bool *reused);
    enum store_status (*shelf_drop)(struct store_session *s, enum shelf_kind kind, const char *name,
                                    int version);

    /* -- reads, any session ------------------------------------------------------------- */
    enum store_status (*get)(struct store_session *s, const char *id, struct job_record *out);
    enum store_status (*list)(struct store_session *s, const struct service_filter *filter,
                              struct job_record **out, int *n, bool *more);
    enum store_status (*get_case)(struct store_session *s, const char *id, char **json);
    enum store_status (*get_document)(struct store_session *s, const char *id, const char *name,
                                      char **json);
    /* Names of all recorded columns with the time base; value pointers are NULL. */
    enum store_status (*get_series)(struct store_session *s, const char *id,
                                    struct series_data *out);
    /* Samples [from, from + n) of the column at `position`. */
    enum store_status (*get_samples)(struct store_session *s, const char *id, int position,
                                     int from, int n, double *value);
    /* Library, as struct shelf has it. */
    enum store_status (*shelf_list)(struct store_session *s, enum shelf_kind kind,
                                    struct shelf_entry **out, int *n);
    enum store_status (*shelf_get)(struct store_session *s, enum shelf_kind kind, const char *name,
                                   int version, struct shelf_entry *out);
    /* STORE_NONE: no such study. */
    enum store_status (*get_study)(struct store_session *s, const char *id,
                                   struct service_study *out);
    /* At most `limit` finished cells from number `from` on; free each `packed`, then the array. */
    enum store_status (*get_cells)(struct store_session *s, const char *id, int from, int limit,
                                   bool summaries, struct store_cell_row **out, int *n);
    /* The answer to a case with this identity. STORE_NONE: it is not known. */
    enum store_status (*find_known)(struct store_session *s, const char *content_hash,
                                    struct store_known *out);
    /* The summary (malloc'ed) of a stored answer. STORE_NONE: there is no such answer. */
    enum store_status (*read_known)(struct store_session *s, int64_t known, char **summary);
    /* Jobs without a final state. */
    enum store_status (*depth)(struct store_session *s, int64_t *out);
    /* The id accepted last, "" when there is none. */
    enum store_status (*newest_id)(struct store_session *s, char out[JOB_ID_SIZE]);
};

struct store {
    const struct store_ops *ops;
};

/* Opens the database at "sqlite:PATH", creating it and its directory when missing, keeps other
 * processes out, brings the schema up to date. On failure `why` says what is wrong. */
enum store_status store_open(const char *url, struct store **out, char why[STORE_MESSAGE]);
/* Accepts NULL. */
void store_close(struct store *st);

#endif
