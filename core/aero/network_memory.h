/* core/aero/network_memory.h
 * The inputs by which a feed-forward network knows the past: angle of attack and pitch rate behind
 * first-order lags, x' = (V/c)(u - x)/T with T in c/V, one state a lag, station and quantity, and
 * behind damped oscillators, x'' + 2 zeta w x' + w^2 (x - u) = 0 with w = 2 pi f V/c, two states
 * each. Lags know what slow stall remembers, oscillators answer as a wake that sheds vortices.
 *
 * The states are the inputs themselves: `in` (NET_IN_COUNT rows of n stations, as network_eval
 * takes them) keeps them from one step to the next. Training, loops and the coupled march all come
 * through here, so that they cannot differ. A struct network_memory is immutable; only the init
 * allocates. */
#ifndef AEROM_CORE_AERO_NETWORK_MEMORY_H
#define AEROM_CORE_AERO_NETWORK_MEMORY_H

#include "core/aero/dynamic_stall.h"
#include "core/aero/network.h"

struct network_memory {
    int n, n_lag, n_oscillator;
    double *lag;        /* factors of a step (n x LAG_FACTORS x n_lag), owned */
    double *oscillator; /* the same (n x OSCILLATOR_FACTORS x n_oscillator), behind the lags */
};

/* n stations of chord [m] (n), speed V [m/s], dt [s]. */
MUST_CHECK enum status network_memory_init(int n, const double *chord, double speed, double dt,
                                           const struct network_frame *frame,
                                           struct network_memory *out);
/* Accepts a zeroed struct. */
void network_memory_done(struct network_memory *m);

/* Sets the rows NET_IN_ALPHA and NET_IN_PITCH_RATE to alpha [rad] and theta_dot c/V (n each) and
 * takes those behind lags and oscillators over one step in which both run linearly from the old
 * values in those rows to the new ones: exact. */
void network_memory_step(const struct network_memory *m, const double *alpha,
                         const double *pitch_rate, double *in);
/* The same rows when alpha and pitch rate have stood for long. */
void network_memory_steady(const struct network_memory *m, const double *alpha,
                           const double *pitch_rate, double *in);

/* The rows that are states x (n x STALL_STATES at least, station fastest) of dynamic stall. */
void network_stall_inputs(int n, const double *x, double *in);

#endif
