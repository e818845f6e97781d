/* core/control.h
 * How a caller watches and stops a long computation from another thread. */
#ifndef AEROM_CORE_CONTROL_H
#define AEROM_CORE_CONTROL_H

#include <stdatomic.h>

/* Both pointers may be NULL. */
struct sim_control {
    const atomic_bool *cancel; /* set to true by another thread to stop */
    _Atomic double *progress;  /* receives 0..1 */
    int part, parts; /* a training that is one of several, from 0; parts 0: it is the whole */
};

#endif
