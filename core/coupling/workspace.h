/* core/coupling/workspace.h
 * Everything one thread writes while it marches, listed in the order the data flow each step:
 * modes -> stations -> angle of attack -> lifting line -> polar + dynamic increment -> modal loads.
 *
 * One aligned allocation; the time loop allocates nothing. */
#ifndef AEROM_CORE_COUPLING_WORKSPACE_H
#define AEROM_CORE_COUPLING_WORKSPACE_H

#include "core/coupling/model.h"

struct workspace {
    int n_mode, n_station;
    double *block; /* owned: one 64-byte aligned allocation, holds the arrays below */

    /* modal state (n_mode each) */
    double *q;            /* amplitudes [kg^0.5 m] */
    double *qd;           /* velocities */
    double *qdd;          /* accelerations, with the load extrapolated to the new time */
    double *qdd_previous; /* those one time step earlier, for the jerk of the plunge */

    /* stations (n_station each) */
    double *plunge;      /* v/c */
    double *plunge_rate; /* v_dot/V */
    double *twist;       /* theta [rad] */
    /* What moves the stations from outside the modes, zero without: core/coupling/excitation.h,
     * and the rest of a static deflection. */
    double *imposed_twist;        /* part of theta [rad] */
    double *imposed_plunge;       /* of v [m] */
    double *imposed_plunge_rate;  /* of v_dot [m/s] */
    double *imposed_acceleration; /* of v_ddot [m/s^2] */
    double *alpha_geometric;      /* alpha_0 + theta - v_dot/V [rad] */
    double *pitch_rate;           /* theta_dot c/V, with a wake that lags or a network */
    double *alpha_34;             /* at three quarters of the chord, with a wake that lags [rad] */
    double *alpha_34_previous;    /* one time step earlier */
    double *wake;                 /* states of the wake's lag (n_station x ATTACHED_LAGS) [rad] */
    double *gust_lag;             /* states of the gust's lag (n_station x KUESSNER_LAGS) [rad] */
    double *alpha_wake;           /* alpha_34 as far as the wake lets it act, else unused [rad] */
    double *alpha;                /* effective: less the induced angle [rad] */
    double *induced;              /* w_i/V [rad] */
    double *stall;                /* states of stall and their targets (n_station x STALL_ARRAYS) */
    double *net_in;               /* inputs of the network, its lags among them (n_station x
                                     NET_IN_COUNT) */
    double *net_out;              /* increments of c_l c_m c_d (n_station x NET_OUT_COUNT) */
    double *cl, *cd, *cm;         /* total coefficients; cd holds profile and induced drag */
    double *force_x;              /* per length, towards the leading edge [N/m] */
    double *force_y;              /* per length, up [N/m] */
    double *moment;               /* per length, nose-up about mid-chord [N] */

    /* sliding mean of the angle of attack: ring of the last `window` steps */
    int window; /* one period of the first mode in time steps */
    int ring_count, ring_next;
    double *ring;     /* (n_station x window), only with a network that sees the mean */
    double *ring_sum; /* (n_station) */

    double *load;                           /* modal loads (n_mode) */
    double *imposed_load;                   /* of them, inertia of the root's motion (n_mode) */
    struct drive_state root_pitch;          /* of the clamp [rad] */
    struct drive_state root_plunge;         /* [m] */
    double axes_cos, axes_sin;              /* of the angle of the beam's axes to the stream */
    double gust, gust_previous;             /* vertical velocity now and a time step ago [m/s] */
    struct lifting_line_state lifting_line; /* n = 0 without one */

    /* of the last evaluation */
    bool any_outside, any_stalled; /* stations with an angle outside the polar, its linear range */

    struct workspace_counters {
        long outside_polar, outside_hull, not_converged, lifting_line_iterations;
        long lifting_line_regularised;
        double lifting_line_residual, lifting_line_smoothing;
    } counters;
};

/* ST_LIMIT when the ring of the sliding mean would hold more than LIMIT_SERIES_VALUES: very many
 * time steps in a period of the first mode. */
MUST_CHECK enum status workspace_init(const struct model *m, struct workspace *out);
void workspace_done(struct workspace *w);

/* out (n_station) += factor * shape (n_station x n_mode) * modal (n_mode). */
void stations_add(const struct model *m, const double *shape, const double *modal, double factor,
                  double *restrict out);
void stations_fill(int n, double value, double *x);

#endif
