/* core/coupling/march.h
 * Time marching of the coupled system (App. C): loads once per step, extrapolated inside it.
 *
 * A struct march belongs to one thread. march_run allocates nothing. */
#ifndef AEROM_CORE_COUPLING_MARCH_H
#define AEROM_CORE_COUPLING_MARCH_H

#include "core/control.h"
#include "core/coupling/exponential.h"
#include "core/coupling/record.h"
#include "core/coupling/rk4.h"

/* Why the marching ended. */
enum stop_reason {
    STOP_DURATION,
    STOP_AMPLITUDE,
    STOP_OUTSIDE_POLAR,
    STOP_NOT_FINITE,
    STOP_REASON_COUNT
};

/* The static equilibrium near the state in which a march was stopped by its amplitude, set by
 * equilibrium_near (core/analysis/equilibrium.h). */
struct march_rest {
    bool found;
    double energy_ratio; /* energy of the motion about it: of the last state over the first */
    double tip_plunge;   /* [m] */
    double tip_twist;    /* [rad] */
};

struct march {
    const struct model *model; /* borrowed */
    struct workspace *w;       /* borrowed; q and qd hold the initial state */
    struct record *record;     /* borrowed */
    struct exponential exponential;
    struct rk4 rk4;
    struct load_polynomial load;
    long outside_steps; /* states with a station whose angle is outside the polar */
    enum stop_reason stop;
    struct march_rest rest; /* of STOP_AMPLITUDE */
    int steps;              /* taken */
};

void march_init(const struct model *m, struct workspace *w, struct record *record,
                struct march *out);

/* Marches to the end of the case or to a stop rule. ST_CANCELLED when the flag was raised; other
 * codes are failures of the integrator. A state that is not finite is a stop reason, and is not
 * recorded. */
MUST_CHECK enum status march_run(struct march *march, const struct sim_control *control);

#endif
