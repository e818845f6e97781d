/* core/aero/polar.h
 * Steady section coefficients as a table over angle of attack and plunge.
 *
 * `struct polar_def` is the raw table as given; `struct polar` is the prepared, immutable
 * interpolant shared by all threads. Shape-preserving cubic (Fritsch-Carlson) in the angle, linear
 * in the plunge; outside the grid the value of the border is held and the caller is told. */
#ifndef AEROM_CORE_AERO_POLAR_H
#define AEROM_CORE_AERO_POLAR_H

#include "core/limits.h"
#include "core/status.h"

#include <stdbool.h>

/* What the dynamic stall model takes besides the table (core/aero/dynamic_stall.h). */
struct stall_def {
    double lift_slope;  /* of potential flow [1/rad], > 0 */
    double lift_centre; /* where its lift acts, ahead of mid-chord, in chords */
    /* Time constants in c/(2V), > 0: of the pressure at the nose, of the boundary layer, and of the
     * vortex that carries the lift of stalling away. */
    double pressure_lag, boundary_layer_lag, vortex_lag;
};

/* Thin-aerofoil theory (2 pi at a quarter of the chord) and the time constants of Leishman &
 * Beddoes 1989 at low Mach number: 1.7, 3 and 6. */
struct stall_def stall_def_default(void);

struct polar_def {
    char name[LIMIT_NAME];
    char hash[LIMIT_HASH]; /* content hash of the table, filled by the border; may be "" */
    int n_alpha, n_plunge;
    double *alpha;  /* [rad], strictly increasing   (n_alpha) */
    double *plunge; /* v/c, strictly increasing     (n_plunge) */
    double *cl;     /* lift coefficient             (n_alpha x n_plunge), alpha runs fastest */
    double *cd;     /* drag coefficient             (n_alpha x n_plunge), or NULL: not known */
    double *cm;     /* moment about mid-chord, nose-up positive (n_alpha x n_plunge) */
    /* Range of attached, linear behaviour: beyond it an oscillation counts as stalled. [rad] */
    double linear_from, linear_to;
    struct stall_def stall;
};

/* Without drag the loads count none of the section; what reports drag has to say so. */
bool polar_def_has_drag(const struct polar_def *def);

/* Appends what is wrong with the table. */
void polar_def_check(const struct polar_def *def, const char *pointer, struct failure_list *out);
/* Frees the five arrays (not the struct) and clears the pointers. Accepts a zeroed struct. */
void polar_def_done(struct polar_def *def);

struct polar;

/* Prepares the interpolant from a checked table. The table is copied. */
MUST_CHECK enum status polar_create(const struct polar_def *def, struct polar **out);
void polar_destroy(struct polar *p);

struct polar_value {
    double cl, cd, cm;
    double cl_slope;    /* d cl / d alpha [1/rad], 0 where the value is held */
    double cm_slope;    /* d cm / d alpha [1/rad] */
    bool outside;       /* the angle or the plunge was outside the grid */
    bool outside_alpha; /* the angle was: what is held is not the flow at this angle at all */
};

/* Coefficients at one angle [rad] and plunge v/c. */
struct polar_value polar_at(const struct polar *p, double alpha, double plunge);

/* The cubic piece of the lift curve an angle is on: with t = alpha - origin,
 * c_l = lift[0] + t (lift[1] + t (lift[2] + t lift[3])) for from <= alpha < to. The same bits as
 * polar_at. A piece beyond the table is constant; an angle that is not a number gets such a one. */
struct polar_piece {
    double from, to, origin; /* [rad] */
    double lift[4];
};
struct polar_piece polar_piece_at(const struct polar *p, double alpha, double plunge);

/* Steepest fall of the lift with the angle anywhere in the table [1/rad], >= 0. */
double polar_steepest_fall(const struct polar *p);

/* The linear range stated by the table [rad]. */
struct polar_range {
    double from, to;
};
struct polar_range polar_linear_range(const struct polar *p);
/* What the table says about dynamic stall. */
const struct stall_def *polar_stall(const struct polar *p);
/* True where the angle is outside the linear range. */
bool polar_is_stalled(const struct polar *p, double alpha);

#endif
