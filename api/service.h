/* api/service.h
 * The port between the contract (api) and the process (server): what a handler may ask for.
 *
 * The server implements it over its store; tests implement it in memory. All pointers a call
 * returns are owned by the caller and freed with the function named. Reads are synchronous and
 * safe from any thread; writes answer through a callback once they are on stable storage (or have
 * failed), from any thread, exactly once. */
#ifndef AEROM_API_SERVICE_H
#define AEROM_API_SERVICE_H

#include "api/study_map.h"
#include "core/case_def.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { JOB_ID_SIZE = 37 }; /* UUIDv7 as text with its terminating zero */

/* X(code, name on the wire) */
#define JOB_STATE_LIST(X)                                                                          \
    X(JOB_QUEUED, "queued")                                                                        \
    X(JOB_RUNNING, "running")                                                                      \
    X(JOB_CANCELLING, "cancelling")                                                                \
    X(JOB_DONE, "done")                                                                            \
    X(JOB_FAILED, "failed")                                                                        \
    X(JOB_CANCELLED, "cancelled")
#define JOB_STATE_ENUM(code, name) code,
enum job_state { JOB_STATE_LIST(JOB_STATE_ENUM) JOB_STATE_COUNT };
#undef JOB_STATE_ENUM

/* Kind of a job: that of its case, enum case_kind, or a study. */
enum { JOB_STUDY = CASE_KIND_COUNT, JOB_KIND_COUNT };
const char *job_kind_name(int kind); /* "simulation" ... "study" */
bool job_kind_parse(const char *name, int *out);

const char *job_state_name(enum job_state state);
bool job_state_parse(const char *name, enum job_state *out);

/* Outcome of a request to the service. */
enum service_status {
    SERVICE_OK,
    SERVICE_NOT_FOUND, /* no such job, result or channel */
    SERVICE_NOT_READY, /* the job exists and has no result yet, or will never have one */
    SERVICE_BUSY,      /* queue full or shutting down: try again later */
    SERVICE_DISK_FULL,
    SERVICE_ERROR /* logged by the server */
};

/* One accepted case on its way in. All text is borrowed until the callback has been called. */
struct service_submit {
    int kind;                      /* job_kind_name */
    const char *name;              /* label of the case, may be "" */
    const char *case_json;         /* canonical case or study, every default filled in */
    const char *content_hash;      /* identity of case + core + library entries, hexadecimal */
    const struct study_plan *plan; /* how a study is cut (api/study.h); NULL for a case */
};

struct service_submitted {
    char id[JOB_ID_SIZE];
    enum job_state state;
    bool reused; /* an equal case was already known and its job is returned */
};

/* What a list shows and GET /v1/jobs/{id} returns. */
struct job_record {
    char id[JOB_ID_SIZE];
    int kind; /* job_kind_name */
    enum job_state state;
    char name[128];
    char content_hash[LIMIT_HASH];
    double progress;                             /* 0..1 */
    int attempt;                                 /* claims so far */
    int64_t created_us, started_us, finished_us; /* UTC, 0 = not yet */
    char verdict[24];                            /* "" unless a simulation is done */
    char error_code[40];                         /* failed: stable word */
    char error_detail[512];                      /* failed: sentence with place and time */
};

struct service_filter {
    int limit;         /* 1..1000 */
    const char *after; /* id of the last job of the previous page, NULL = from the newest */
    int kind;          /* as of a job, or -1 */
    int state;         /* enum job_state or -1 */
    const char *name;  /* exact label or NULL */
};

/* How far a study is. */
struct service_study {
    int n_cell, done, failed;
    int reused;   /* of the done: known before, from another study or a job */
    double cpu_s; /* of the cells it computed itself */
};

/* A finished cell of a study. */
struct service_cell {
    int cell;
    enum study_cell_state state;
    bool reused;
    char content_hash[LIMIT_HASH];
    char verdict[24];
    char error_code[40], error_detail[512];
    double cpu_s;
    char *summary; /* JSON text; NULL when the cell failed, or when it was not asked for */
};
void service_cells_done(struct service_cell *cell, int n);

/* Recorded series as stored: columns in presented units (api/channel.h). */
struct series_column {
    char name[64]; /* "tip_twist_deg", "modal_amplitude[2]" */
    double *value; /* (n) */
};

struct series_data {
    double t0, step; /* time of value[0], sample distance [s] */
    int n;           /* samples of each column */
    int n_column;
    struct series_column *column;
};

typedef void (*service_submit_done)(void *arg, enum service_status status, int n,
                                    const struct service_submitted *result);
typedef void (*service_cancel_done)(void *arg, enum service_status status,
                                    const struct job_record *job);

struct service {
    void *ctx;

    /* All or nothing. `done` is called once, after the durable commit. */
    void (*submit)(void *ctx, int n, const struct service_submit *item, service_submit_done done,
                   void *arg);
    /* Idempotent. `done` gets the job after the change. */
    void (*cancel)(void *ctx, const char *id, service_cancel_done done, void *arg);

    enum service_status (*get)(void *ctx, const char *id, struct job_record *out);
    /* Newest first. *out holds *n records, freed with free(); *more tells of a next page. */
    enum service_status (*list)(void *ctx, const struct service_filter *filter,
                                struct job_record **out, int *n, bool *more);
    /* Canonical case as text, freed with free(). */
    enum service_status (*get_case)(void *ctx, const char *id, char **json);
    /* A stored result document (result.h names them), freed with free(). */
    enum service_status (*get_document)(void *ctx, const char *id, const char *document,
                                        char **json);
    /* Columns whose name, or name before '[', is in `channel` (n_channel = 0: all), samples with
     * from <= t <= to. Freed with series_data_done. An unknown channel: SERVICE_NOT_FOUND and its
     * index in *bad_channel (else -1). */
    enum service_status (*get_series)(void *ctx, const char *id, int n_channel,
                                      const char *const *channel, double from_s, double to_s,
                                      struct series_data *out, int *bad_channel);
    /* Names of the recorded columns, as one malloc'ed array of char[64]. */
    enum service_status (*get_columns)(void *ctx, const char *id, char (**out)[64], int *n);

    /* SERVICE_NOT_FOUND when the job is no study. */
    enum service_status (*get_study)(void *ctx, const char *id, struct service_study *out);
    /* Finished cells with numbers of at least `from`, in order, at most `limit` of them; with their
     * summaries if asked for. Freed with service_cells_done and free. */
    enum service_status (*get_cells)(void *ctx, const char *id, int from, int limit, bool summaries,
                                     struct service_cell **out, int *n);

    /* Ready to take work; *why (borrowed, static) says what is missing when not. */
    bool (*ready)(void *ctx, const char **why);
};

void series_data_done(struct series_data *data);

#endif
