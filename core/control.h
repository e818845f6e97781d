/* core/control.h
 * How a caller watches and stops a long computation from another thread, and lends it one. */
#ifndef AEROM_CORE_CONTROL_H
#define AEROM_CORE_CONTROL_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>

/* Does work(first) and work(second), at the same time where it can, and returns when both are
 * done. */
typedef void (*sim_both_fn)(void (*work)(void *), void *first, void *second);

/* All pointers may be NULL. */
struct sim_control {
    const atomic_bool *cancel; /* set to true by another thread to stop */
    _Atomic double *progress;  /* receives 0..1 */
    int part, parts;  /* the computation is one of several, from 0; parts 0: it is the whole */
    sim_both_fn both; /* NULL: one after the other. The answer is the same to the bit. */
};

/* Is it to stop? Not without a control, as everywhere here. */
static inline bool sim_control_cancelled(const struct sim_control *c)
{
    return c != NULL && c->cancel != NULL && atomic_load(c->cancel);
}

/* Tells which share of its part is done. */
static inline void sim_control_tell(const struct sim_control *c, double share)
{
    if (c != NULL && c->progress != NULL) {
        atomic_store(c->progress, (c->part + share) / (c->parts > 0 ? c->parts : 1));
    }
}

static inline void sim_control_both(const struct sim_control *c, void (*work)(void *), void *first,
                                    void *second)
{
    if (c != NULL && c->both != NULL) {
        c->both(work, first, second);
    } else {
        work(first);
        work(second);
    }
}

#endif
