/* core/analysis/linear.h
 * The coupled system linearised about a static aeroelastic equilibrium: y' = A y.
 *
 * y holds the modal amplitudes q, the modal velocities q', and the states of the wake. Lags of
 * stations of one chord have one rate, and a filter commutes with the sum over the modes: a beam of
 * constant chord has ATTACHED_LAGS states a mode, any other ATTACHED_LAGS states a station.
 *
 * With dynamic stall every station has its STALL_STATES more.
 *
 * A struct linear belongs to one thread; linear_done accepts a zeroed struct. linear_fill allocates
 * nothing. */
#ifndef AEROM_CORE_ANALYSIS_LINEAR_H
#define AEROM_CORE_ANALYSIS_LINEAR_H

#include "core/coupling/loads.h"

#include <stdbool.h>

struct linear {
    int n_mode, n_station;
    int n_wake;               /* states of the wake for each lag: modes or stations, 0 without */
    bool modal_wake;          /* of the modes */
    int n_stall;              /* stations with states of stall: all, or 0 without */
    int n_state;              /* 2 n_mode + ATTACHED_LAGS n_wake + STALL_STATES n_stall */
    double *block;            /* owned: holds the arrays below */
    double *a;                /* A (n_state x n_state), column-major */
    double *static_stiffness; /* Omega^2 - d load/d q in steady flow [1/s^2] (n_mode x n_mode) */
    double *angle;            /* d alpha_effective / d y (n_station x n_state) */
    /* scratch */
    double *given;  /* d of the angle the lifting line starts from (n_station x n_state) */
    double *plunge; /* d v/c, d theta_dot c/V likewise */
    double *pitch;
    double *force;              /* d of one station's load, projected (n_mode x n_state) */
    double *relief;             /* d alpha_effective / d alpha_given (n_station x n_station) */
    double *dense;              /* inversion (n_station x n_station) */
    struct linear_slope *slope; /* (n_station), owned */
    int *pivot;                 /* (n_station), owned */
};

struct linear_gain {
    double cl, cd, cm;
};

/* Derivatives at a station. */
struct linear_slope {
    struct linear_gain steady_alpha, steady_plunge; /* of the polar [1/rad], per v/c */
    struct linear_gain alpha, plunge;       /* at once: of the polar too, unless stall has states */
    struct linear_gain stall[STALL_STATES]; /* of the states of stall */
    /* Their time derivatives by angle, plunge and themselves [1/s]. */
    double stall_rate[STALL_STATES][2 + STALL_STATES];
    double cl; /* the steady lift coefficient itself */
};

MUST_CHECK enum status linear_init(const struct model *m, struct linear *out);
void linear_done(struct linear *l);

/* Fills a and static_stiffness at the equilibrium in w (q; q' is taken as zero) and the speed of
 * the model. ST_SINGULAR when the lifting line has no unique answer there, ST_NOT_FINITE when
 * a derivative is none. The model has no network: its memory is no state. */
MUST_CHECK enum status linear_fill(const struct model *m, struct workspace *w, struct linear *l);

#endif
