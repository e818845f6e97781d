/* core/aero/dynamic_stall.h
 * Dynamic stall of the Beddoes-Leishman kind, as states that lag behind the steady polar
 * (Hansen, Gaunaa & Madsen 2004, with the vortex lift of Leishman & Beddoes 1989).
 *
 * The input is the effective angle alpha of a station: after the lag of the wake and the lifting
 * line. What a moving section does at once is potential flow: lift of slope a_t at the centre
 * kappa ahead of mid-chord. Everything the steady polar says beyond that belongs to the boundary
 * layer and comes late. With a_s the slope of the polar in its linear range, alpha_0 its angle of
 * zero lift, K(f) = ((1 + sqrt f)/2)^2 the share of lift that Kirchhoff's flow keeps when it leaves
 * the upper face at f (0 leading edge, 1 trailing edge), the states of a station are
 *
 *   state             meaning, unit                                  lags  behind
 *   STALL_PRESSURE    angle p of the pressure at the nose [rad]      T_p   alpha
 *   STALL_BUBBLE      b, linear lift beyond potential flow           T_f   (a_s - a_t)(p - alpha_0)
 *   STALL_SEPARATION  f, point of separation over the chord          T_f   f_s(p), of the polar
 *   STALL_RESIDUE     q, what Kirchhoff's flow misses in the polar   T_f   a_s (p - alpha_0)
 *                                                                            K(f_s(p)) - c_l,s(p)
 *   STALL_MOMENT      m, moment beyond potential flow                T_f   c_m,s(p) -
 *                                                                            kappa a_t (p -
 * alpha_0) STALL_LOST        z, lift lost to separation                     T_v   d
 *
 * each by x' = (2V/c) (target - x)/T, with
 *   l = a_t (alpha - alpha_0) + b            lift without separation
 *   d = l (1 - K(f)) + q                     lift that separation costs once the vortex is gone
 *   c_l = l - z,  c_m = kappa a_t (alpha - alpha_0) + m,
 *   c_d = c_d,s(alpha) + (c_l - c_l,s(alpha)) sin(alpha).
 * d - z is the lift of the vortex: what separation takes is only missed after the vortex, which
 * rides over the section, has left. Lift beyond the steady one has no suction at the nose and
 * acts normal to the chord. In steady flow all states meet their targets and the coefficients are
 * those of the polar, at every angle and whatever the parameters. There is no other criterion of
 * onset: f_s falls where the polar bends, T_p later.
 *
 * A struct dynamic_stall is immutable and borrows the polar. Only dynamic_stall_init allocates. */
#ifndef AEROM_CORE_AERO_DYNAMIC_STALL_H
#define AEROM_CORE_AERO_DYNAMIC_STALL_H

#include "core/aero/polar.h"

enum stall_state {
    STALL_PRESSURE,
    STALL_BUBBLE,
    STALL_SEPARATION,
    STALL_RESIDUE,
    STALL_MOMENT,
    STALL_LOST,
    STALL_STATES
};

enum { STALL_LAGS = 3 }; /* T_p, T_f, T_v */

struct dynamic_stall {
    int n;
    const struct polar *polar; /* borrowed */
    struct stall_def def;
    double polar_slope; /* a_s [1/rad] */
    double zero_lift;   /* alpha_0 [rad] */
    double *rate;       /* 2V/c [1/s] (n), owned */
    double *step; /* of a time step: factors of x, of the old and new target (n x 3 x STALL_LAGS) */
};

/* n stations of chord [m] (n), speed V [m/s], dt [s]. */
MUST_CHECK enum status dynamic_stall_init(int n, const double *chord, double speed, double dt,
                                          const struct polar *polar, const struct stall_def *def,
                                          struct dynamic_stall *out);
/* Accepts a zeroed struct. */
void dynamic_stall_done(struct dynamic_stall *ds);

/* Doubles a station needs: its states and what they are driven to. */
enum { STALL_ARRAYS = 2 * STALL_STATES };

/* Advances the states x (n x STALL_ARRAYS, station fastest) over one step to the effective angles
 * alpha [rad] (n) at plunge v/c (n). Targets run linearly over the step: exact for the pressure,
 * second order for the rest, stable for any step. */
void dynamic_stall_step(const struct dynamic_stall *ds, const double *alpha, const double *plunge,
                        double *x);
/* The states of steady flow. */
void dynamic_stall_steady(const struct dynamic_stall *ds, const double *alpha, const double *plunge,
                          double *x);
/* Turns the steady coefficients at alpha (n each) into those of the states. */
void dynamic_stall_coefficients(const struct dynamic_stall *ds, const double *alpha,
                                const double *x, double *cl, double *cd, double *cm);

/* Of one station with the states x (STALL_STATES): time derivatives [1/s]. */
void dynamic_stall_derivative(const struct dynamic_stall *ds, int station, double alpha,
                              double plunge, const double *x, double *out);
struct stall_value {
    double cl, cd, cm;
};
/* Of one station with the states x (STALL_STATES): coefficients. */
struct stall_value dynamic_stall_output(const struct dynamic_stall *ds, double alpha, double plunge,
                                        const double *x);

/* K(f), and its inverse over 1/4..1, held outside. */
double dynamic_stall_lift_share(double separation);
double dynamic_stall_separation(double lift_share);

#endif
