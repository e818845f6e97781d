#include "server/dispatch.h"

#include "api/both_threads.h"

#include <assert.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

struct slot {
    struct store_ticket ticket; /* id "" = idle */
    atomic_bool cancel;
    _Atomic double progress;
};

struct dispatch {
    pthread_mutex_t mutex; /* guards the tickets, rings and stopping */
    pthread_cond_t bell;
    uint64_t rings;
    bool stopping;
    _Atomic int64_t depth;
    int n_slot;
    struct slot slot[];
};

struct dispatch *dispatch_create(int n_slot, int64_t depth)
{
    assert(n_slot >= 0);
    struct dispatch *d = calloc(1, sizeof *d + (size_t)n_slot * sizeof d->slot[0]);
    if (d == NULL) {
        return NULL;
    }
    d->n_slot = n_slot;
    atomic_init(&d->depth, depth);
    (void)pthread_mutex_init(&d->mutex, NULL);
    pthread_condattr_t attr;
    (void)pthread_condattr_init(&attr);
    (void)pthread_condattr_setclock(&attr, CLOCK_MONOTONIC);
    (void)pthread_cond_init(&d->bell, &attr);
    (void)pthread_condattr_destroy(&attr);
    return d;
}

void dispatch_destroy(struct dispatch *d)
{
    if (d == NULL) {
        return;
    }
    (void)pthread_cond_destroy(&d->bell);
    (void)pthread_mutex_destroy(&d->mutex);
    free(d);
}

void dispatch_enter(struct dispatch *d, int slot, const struct store_ticket *ticket)
{
    assert(slot >= 0 && slot < d->n_slot);
    (void)pthread_mutex_lock(&d->mutex);
    d->slot[slot].ticket = *ticket;
    atomic_store(&d->slot[slot].cancel, d->stopping);
    atomic_store(&d->slot[slot].progress, 0.0);
    (void)pthread_mutex_unlock(&d->mutex);
}

void dispatch_leave(struct dispatch *d, int slot)
{
    assert(slot >= 0 && slot < d->n_slot);
    (void)pthread_mutex_lock(&d->mutex);
    d->slot[slot].ticket = (struct store_ticket){.fence = 0};
    (void)pthread_mutex_unlock(&d->mutex);
}

struct sim_control dispatch_control(struct dispatch *d, int slot)
{
    return (struct sim_control){.cancel = &d->slot[slot].cancel,
                                .progress = &d->slot[slot].progress,
                                .both = d->n_slot > 1 ? both_threads : NULL};
}

/* Whether a slot runs a job, or a unit of it; the mutex is held. */
static bool runs(const struct slot *s, const char *id, int64_t fence)
{
    const struct store_ticket *t = &s->ticket;
    return t->id[0] != '\0' && strcmp(t->id, id) == 0 && (fence == 0 || t->fence == fence);
}

bool dispatch_cancel(struct dispatch *d, const char *id, int64_t fence)
{
    bool found = false;
    (void)pthread_mutex_lock(&d->mutex);
    for (int i = 0; i < d->n_slot; i++) {
        if (runs(&d->slot[i], id, fence)) {
            atomic_store(&d->slot[i].cancel, true);
            found = true;
        }
    }
    (void)pthread_mutex_unlock(&d->mutex);
    return found;
}

bool dispatch_progress(struct dispatch *d, const char *id, double *out)
{
    bool found = false;
    (void)pthread_mutex_lock(&d->mutex);
    for (int i = 0; i < d->n_slot && !found; i++) {
        if (runs(&d->slot[i], id, 0) && d->slot[i].ticket.unit == 0) {
            *out = atomic_load(&d->slot[i].progress);
            found = true;
        }
    }
    (void)pthread_mutex_unlock(&d->mutex);
    return found;
}

int dispatch_tickets(struct dispatch *d, struct store_ticket *out)
{
    int n = 0;
    (void)pthread_mutex_lock(&d->mutex);
    for (int i = 0; i < d->n_slot; i++) {
        if (d->slot[i].ticket.id[0] != '\0') {
            out[n++] = d->slot[i].ticket;
        }
    }
    (void)pthread_mutex_unlock(&d->mutex);
    return n;
}

int dispatch_slots(const struct dispatch *d)
{
    return d->n_slot;
}

void dispatch_depth_add(struct dispatch *d, int64_t n)
{
    atomic_fetch_add(&d->depth, n);
}

int64_t dispatch_depth(const struct dispatch *d)
{
    return atomic_load(&d->depth);
}

void dispatch_ring(struct dispatch *d)
{
    (void)pthread_mutex_lock(&d->mutex);
    d->rings++;
    (void)pthread_cond_broadcast(&d->bell);
    (void)pthread_mutex_unlock(&d->mutex);
}

uint64_t dispatch_rings(struct dispatch *d)
{
    (void)pthread_mutex_lock(&d->mutex);
    const uint64_t rings = d->rings;
    (void)pthread_mutex_unlock(&d->mutex);
    return rings;
}

void dispatch_wait(struct dispatch *d, uint64_t seen, int seconds)
{
    struct timespec until;
    (void)clock_gettime(CLOCK_MONOTONIC, &until);
    until.tv_sec += seconds;
    int rc = 0;
    (void)pthread_mutex_lock(&d->mutex);
    while (d->rings == seen && !d->stopping && rc == 0) {
        rc = pthread_cond_timedwait(&d->bell, &d->mutex, &until);
    }
    (void)pthread_mutex_unlock(&d->mutex);
}

void dispatch_stop(struct dispatch *d)
{
    (void)pthread_mutex_lock(&d->mutex);
    d->stopping = true;
    for (int i = 0; i < d->n_slot; i++) {
        atomic_store(&d->slot[i].cancel, true);
    }
    (void)pthread_cond_broadcast(&d->bell);
    (void)pthread_mutex_unlock(&d->mutex);
}

bool dispatch_stopping(struct dispatch *d)
{
    (void)pthread_mutex_lock(&d->mutex);
    const bool stopping = d->stopping;
    (void)pthread_mutex_unlock(&d->mutex);
    return stopping;
}
