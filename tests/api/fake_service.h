/* tests/api/fake_service.h
 * A struct service in memory, and requests to the router without a socket. */
#ifndef AEROM_TESTS_API_FAKE_SERVICE_H
#define AEROM_TESTS_API_FAKE_SERVICE_H

#include "api/router.h"

enum { FAKE_JOBS_MAX = 1100, FAKE_SAMPLES = 1000, FAKE_ENTRIES_MAX = 16 };

struct fake_job {
    struct job_record record;
    char *case_json;
};

struct fake {
    struct service service;
    struct api api;
    struct library *library;
    struct shelf shelf;
    int n_entry;
    struct fake_entry {
        enum shelf_kind kind;
        struct shelf_entry entry;
    } entry[FAKE_ENTRIES_MAX];
    bool in_use; /* no entry can be dropped */
    struct api_reply reply;
    enum service_status refuse; /* what submit and cancel answer instead of working */
    bool not_ready;
    int n_job;
    struct fake_job job[FAKE_JOBS_MAX];
    int n_sent;                 /* replies so far */
    struct api_response answer; /* the last one, freed by the next request */
};

/* Builds the service and the built-in library. */
struct fake *fake_create(void);
void fake_destroy(struct fake *f);
/* Forgets every job and every entry. */
void fake_reset(struct fake *f);

/* Of the cells of every study the first is done, with verdict and c_l, and the second has failed.
 */

/* Adds a job as a worker would have left it. Returns it. */
struct fake_job *fake_add(struct fake *f, int kind, enum job_state state, const char *name);

/* One request; exactly one answer must come. The target is a path with its query. Headers may be
 * NULL. Returns the answer's status. */
int fake_request(struct fake *f, const char *method, const char *target, const char *content_type,
                 const char *body);
/* The same for any bytes as body. */
int fake_send(struct fake *f, const char *method, const char *target, const char *content_type,
              const char *body, size_t body_size);
int fake_get(struct fake *f, const char *target);
/* A GET with Accept and If-None-Match. */
int fake_get_with(struct fake *f, const char *target, const char *accept, const char *etag);
int fake_post(struct fake *f, const char *body);

/* Header of the last answer, NULL when absent. */
const char *fake_header(const struct fake *f, const char *name);
/* Whether the last answer's body contains the text. */
bool fake_says(const struct fake *f, const char *text);

#endif
