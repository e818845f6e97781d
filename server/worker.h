/* server/worker.h
 * The worker threads: claim a job or a unit of a study, run it, publish its end, again. One claim
 * per thread at a time. Jobs and studies that wait at the same time get equal shares of the time.
 *
 * The writer's thread does all storing; a worker waits for it. Every end of a job is bound to the
 * ticket of its claim, so that a worker that lost its lease changes nothing. */
#ifndef AEROM_SERVER_WORKER_H
#define AEROM_SERVER_WORKER_H

#include "api/library.h"
#include "server/dispatch.h"
#include "server/log.h"
#include "server/writer.h"

enum { LEASE_S = 30, HEARTBEAT_S = 10 };

/* What all workers share; borrowed. */
struct worker_env {
    struct store *store; /* readers of it */
    struct writer *writer;
    struct dispatch *dispatch;
    const struct library *library;
    const struct log *log;
    const char *owner; /* identity of this process on its leases */
    int attempts_max;  /* claims that may be lost before a job fails */
};

struct workers;

/* Has a request that ends a claim, or stores a part of it, done: a result is worth waiting for, so
 * a full disk is waited out and other failures are tried again a few times. Gives up when the
 * process stops; the lease then runs out and the work is done again. */
enum store_status worker_store(const struct worker_env *env, struct write_request *r);

/* Starts one thread for each slot of the dispatch. */
enum store_status workers_start(const struct worker_env *env, struct workers **out);
/* Stops the dispatch, hands running jobs back to the queue, joins. Accepts NULL. */
void workers_stop(struct workers *w);

/* Extends the leases of the running jobs, then takes back leases that ran out. Asynchronous; a
 * call while the last one is still queued does nothing. One thread calls it. */
void workers_keep(struct workers *w);

/* Takes back the jobs of previous processes; before workers_start. */
enum store_status workers_recover(const struct worker_env *env);

#endif
