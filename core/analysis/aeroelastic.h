/* core/analysis/aeroelastic.h
 * Static aeroelastic equilibrium of the whole beam: its stream, and the loads given with the case.
 *
 * The air acts on the stations through the modes of the beam, and what the modes leave out of its
 * flexibility is added from the full stiffness, so that the answer does not depend on how many are
 * kept. The dynamic pressure is raised from zero, which leads to the branch a slowly rising stream
 * would find; the state is watched by the eigenvalues of the linearised problem, so that a speed
 * beyond divergence is recognised instead of answered with an equilibrium that nothing reaches. */
#ifndef AEROM_CORE_ANALYSIS_AEROELASTIC_H
#define AEROM_CORE_ANALYSIS_AEROELASTIC_H

#include "core/coupling/loads.h"

/* X(code, name on the wire) */
#define AEROELASTIC_LIST(X)                                                                        \
    X(AEROELASTIC_EQUILIBRIUM, "equilibrium")                                                      \
    X(AEROELASTIC_DIVERGENCE, "divergence")                                                        \
    X(AEROELASTIC_NOT_CONVERGED, "not_converged")
#define AEROELASTIC_ENUM(code, name) code,
enum aeroelastic_state { AEROELASTIC_LIST(AEROELASTIC_ENUM) AEROELASTIC_STATE_COUNT };
#undef AEROELASTIC_ENUM

const char *aeroelastic_state_name(enum aeroelastic_state s);

/* One station of the span; angles [rad], per length in SI. */
struct aeroelastic_station {
    double z, chord;       /* [m] */
    double twist, plunge;  /* of mid-chord */
    double alpha, induced; /* effective angle, and what the lifting line took off */
    double cl, cd, cm;
    double lift, drag; /* [N/m] */
    double moment;     /* about mid-chord, nose-up [N] */
};

enum { AEROELASTIC_REASON = 200 };

struct aeroelastic_result {
    enum aeroelastic_state state;
    char reason[AEROELASTIC_REASON]; /* what decided, in one sentence */
    /* Lowest dynamic pressure [Pa] at which the problem, linearised at the equilibrium, diverges;
     * INFINITY when none does. Without an equilibrium: the lowest met on the way there. */
    double divergence_pressure;
    double divergence_speed; /* [m/s], at the density of the case */
    double share;            /* of the dynamic pressure up to which the branch was followed, 0..1 */
    int iterations;          /* of Newton, over all steps of the pressure */
    double residual;         /* relative, of the last equilibrium */
    bool lifting_line_converged;
    double lifting_line_residual;
    int outside_polar; /* stations outside the polar */
    /* NaN, and no stations, unless state is AEROELASTIC_EQUILIBRIUM. */
    struct load_totals total;
    int n_station;
    struct aeroelastic_station *station; /* (n_station), owned */
};

/* Equilibrium under the loads `given` (n_dof) and the stream of a static case with aerodynamics.
 * `x` (n_dof) receives the deflection. ST_OK also without an equilibrium: that is a state. *out
 * owns memory: aeroelastic_done, also on a zeroed struct. */
MUST_CHECK enum status aeroelastic_solve(const struct model *m, const double *given, double *x,
                                         struct aeroelastic_result *out);
void aeroelastic_done(struct aeroelastic_result *r);

/* The air's load per length on the beam's axis over station i of a result. */
struct beam_load aeroelastic_load(const struct model *m, const struct aeroelastic_station *s);

#endif
