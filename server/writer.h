/* server/writer.h
 * The one thread that writes to the store: requests are queued and committed in groups.
 *
 * A group is one transaction, each request in its own savepoint, so that a refused request leaves
 * nothing behind and does not harm its neighbours. When a whole group fails (a full disk, say) its
 * requests are tried again one by one. `done` is called after the commit, in the order of posting,
 * on the writer's thread and without a lock; it must not block. Memory of a request is the
 * caller's and must live until `done` has been called. */
#ifndef AEROM_SERVER_WRITER_H
#define AEROM_SERVER_WRITER_H

#include "server/log.h"
#include "server/store.h"

enum { WRITER_GROUP_MAX = 256 };

struct write_request {
    /* Does the writes; may be called again after a failed commit, so it starts from scratch. */
    enum store_status (*apply)(struct write_request *r, struct store_session *s);
    /* Outcome; STORE_OK means on stable storage. May be NULL. */
    void (*done)(struct write_request *r, enum store_status st);
    /* The writer's own. */
    struct write_request *next;
    enum store_status status;
    struct write_waiter *waiter;
};

struct writer_stats {
    int64_t requests, commits, retries; /* retries: groups taken apart */
};

struct writer;

/* Starts the thread. Borrows store and log. */
enum store_status writer_create(struct store *st, const struct log *log, struct writer **out);
/* Queues a request; false when the writer is stopping (then nothing is called). */
bool writer_post(struct writer *w, struct write_request *r);
/* Queues a request and waits for its outcome; STORE_ERROR when the writer is stopping. */
enum store_status writer_call(struct writer *w, struct write_request *r);
void writer_stats(struct writer *w, struct writer_stats *out);
/* Finishes what is queued, tidies the log, ends the thread; later posts are refused. Accepts NULL.
 */
void writer_stop(struct writer *w);
/* Stops if need be, then frees; nobody may post any more. Accepts NULL. */
void writer_destroy(struct writer *w);

#endif
