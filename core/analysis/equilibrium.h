/* core/analysis/equilibrium.h
 * Static aeroelastic equilibrium in modal coordinates by Newton's method. */
#ifndef AEROM_CORE_ANALYSIS_EQUILIBRIUM_H
#define AEROM_CORE_ANALYSIS_EQUILIBRIUM_H

#include "core/coupling/loads.h"

/* Solves omega^2 q = load(q, q' = 0) from the state in w->q; leaves q there and q' = 0.
 * ST_NOT_CONVERGED (and *residual, the relative load that is left) when there is none near. */
MUST_CHECK enum status equilibrium_solve(const struct model *m, struct workspace *w,
                                         double *residual);

#endif
