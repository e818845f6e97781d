/* core/control.h
 * How a caller watches and stops a long computation from another thread. */
#ifndef AEROM_CORE_CONTROL_H
#define AEROM_CORE_CONTROL_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>

/* Both pointers may be NULL. */
struct sim_control {
    const atomic_bool *cancel; /* set to true by another thread to stop */
    _Atomic double *progress;  /* receives 0..1 */
    int part, parts; /* the computation is one of several, from 0; parts 0: it is the whole */
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

#endif
