/* core/analysis/equilibrium.h
 * Static aeroelastic equilibrium in modal coordinates by Newton's method. */
#ifndef AEROM_CORE_ANALYSIS_EQUILIBRIUM_H
#define AEROM_CORE_ANALYSIS_EQUILIBRIUM_H

#include "core/coupling/march.h"

/* Solves omega^2 q = load(q, q' = 0) from the state in w->q; leaves q there and q' = 0.
 * ST_NOT_CONVERGED (and *residual, the relative load that is left) when there is none near. */
MUST_CHECK enum status equilibrium_solve(const struct model *m, struct workspace *w,
                                         double *residual);

/* How the last state of a march, in w, lies about the static equilibrium near it, beside the state
 * (q0, qd0) it began from. Not found: there is none near. Leaves another q and q' in w, and its
 * counters as they were. */
struct march_rest equilibrium_near(const struct model *m, struct workspace *w, const double *q0,
                                   const double *qd0);

#endif
