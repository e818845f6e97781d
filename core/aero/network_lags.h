/* core/aero/network_lags.h
 * The inputs by which a feed-forward network knows the past: angle of attack and pitch rate behind
 * first-order lags, x' = (V/c)(u - x)/T with T in c/V, one state a lag, station and quantity.
 *
 * The states are the inputs themselves: `in` (NET_IN_COUNT rows of n stations, as network_eval
 * takes them) keeps them from one step to the next. Training, loops and the coupled march all come
 * through here, so that they cannot differ. A struct network_lags is immutable; only the init
 * allocates. */
#ifndef AEROM_CORE_AERO_NETWORK_LAGS_H
#define AEROM_CORE_AERO_NETWORK_LAGS_H

#include "core/aero/dynamic_stall.h"
#include "core/aero/network.h"

struct network_lags {
    int n, n_lag;
    double *step; /* factors of a step (n x LAG_FACTORS x n_lag), owned */
};

/* n stations of chord [m] (n), speed V [m/s], dt [s]. */
MUST_CHECK enum status network_lags_init(int n, const double *chord, double speed, double dt,
                                         const struct network_frame *frame,
                                         struct network_lags *out);
/* Accepts a zeroed struct. */
void network_lags_done(struct network_lags *l);

/* Sets the rows NET_IN_ALPHA and NET_IN_PITCH_RATE to alpha [rad] and theta_dot c/V (n each) and
 * takes those behind the lags over one step in which both run linearly from the old values in those
 * rows to the new ones: exact. */
void network_lags_step(const struct network_lags *l, const double *alpha, const double *pitch_rate,
                       double *in);
/* The same rows when alpha and pitch rate have stood for long. */
void network_lags_steady(const struct network_lags *l, const double *alpha,
                         const double *pitch_rate, double *in);

/* The rows that are states x (n x STALL_STATES at least, station fastest) of dynamic stall. */
void network_stall_inputs(int n, const double *x, double *in);

#endif
