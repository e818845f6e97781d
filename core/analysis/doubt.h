/* core/analysis/doubt.h
 * Reasons to take no verdict from a march: a load that turns its direction at every time step, and
 * a network asked beyond its training. Stateless. */
#ifndef AEROM_CORE_ANALYSIS_DOUBT_H
#define AEROM_CORE_ANALYSIS_DOUBT_H

#include "core/coupling/march.h"

struct doubt {
    double alternations; /* share of the steps of the last third at which the load turned back */
    double outside_hull; /* share of the evaluations of the network; 0 without one */
};
/* Shares from which on a verdict says nothing: white noise turns back at two thirds of the steps,
 * an oscillation resolved by eight steps a period at a quarter. */
extern const double doubt_alternations_max, doubt_outside_hull_max;
/* Share of evaluations outside the hull from which on the reason of the verdict tells it. */
extern const double doubt_outside_hull_told;

struct doubt doubt_of(const struct march *march);

/* Steps from sample `from` on at which the change of the total lift or moment coefficient has the
 * sign opposite to that of the step before. Changes below 1e-6 are rest. */
long doubt_alternations(const struct record *r, int from);

#endif
