/* core/aero/attached.h
 * Unsteady attached flow: thin-aerofoil theory with the lag of the wake (Theodorsen, in time:
 * Wagner) and apparent mass, for pitch and plunge referred to mid-chord.
 *
 * The circulation follows the angle at three quarters of the chord, alpha_34 = alpha + c theta_dot/
 * (4 V), through Theodorsen's function C(k). Here C is the rational function
 *     C(s) = 1/2 + sum_i a_i b_i/(s + b_i),  s in units of 2V/c,  sum a_i = 1/2,
 * so each station carries ATTACHED_LAGS states x_i, x_i' = b_i (2V/c) (alpha_34 - x_i), each of
 * them an angle [rad] that equals alpha_34 in steady flow; the angle that counts is
 *     alpha_wake = alpha_34/2 + sum_i a_i x_i.
 * The coefficients are a minimax fit of this form to C(k), k = omega c/(2 V): 0.153 % of |C| at the
 * worst frequency between 0.001 and 100.
 *
 * A struct attached is immutable. Nothing here allocates but attached_init. */
#ifndef AEROM_CORE_AERO_ATTACHED_H
#define AEROM_CORE_AERO_ATTACHED_H

#include "core/status.h"

enum { ATTACHED_LAGS = 4 };

/* b_i of a lag, non-dimensional; its rate is b_i 2V/c [1/s]. */
double attached_rate(int lag);
/* a_i of a lag: its share in the angle that counts. The angle itself has the share 1/2. */
double attached_share(int lag);

/* One time step of the lags of n stations. */
struct attached {
    int n;
    double *step; /* factors of x, of the old and of the new angle (n x 3 x ATTACHED_LAGS), owned */
};

/* chord [m] (n), speed V [m/s], dt [s]. */
MUST_CHECK enum status attached_init(int n, const double *chord, double speed, double dt,
                                     struct attached *out);
/* Accepts a zeroed struct. */
void attached_done(struct attached *a);

/* Advances the states x (n x ATTACHED_LAGS) over one step in which alpha_34 [rad] (n) goes
 * linearly from its old to its new value: exact. */
void attached_step(const struct attached *a, const double *alpha_old, const double *alpha_new,
                   double *x);
/* The states of steady flow at alpha_34. */
void attached_steady(int n, const double *alpha, double *x);
/* alpha_wake [rad] (n) of angle and states. */
void attached_angle(int n, const double *alpha, const double *x, double *out);

/* Apparent mass of a strip of chord c in air of density rho: pi rho c^2/4 [kg/m] against normal
 * acceleration of mid-chord, pi rho c^4/128 [kg m] against pitching about it. */
double attached_mass(double density, double chord);
double attached_inertia(double density, double chord);
/* What apparent mass adds at a pitch rate, in c/V units (theta_dot c/V): to c_l, and to c_m. */
double attached_cl_rate(void);
double attached_cm_rate(void);

#endif
