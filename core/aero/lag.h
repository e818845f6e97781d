/* core/aero/lag.h
 * One time step of first-order lags x' = (u - x)/T whose input runs linearly from its old to its
 * new value: exact. The factors of n stations stand one kind after the other, stations fastest, for
 * each lag. Stateless. */
#ifndef AEROM_CORE_AERO_LAG_H
#define AEROM_CORE_AERO_LAG_H

#include "core/num.h"

#include <math.h>

enum { LAG_STATE, LAG_OLD, LAG_NEW, LAG_FACTORS }; /* of x, of the old and the new input */

/* The factors of a lag (n x LAG_FACTORS) among those of several. */
static inline double *lag_factors(double *step, int n, int lag)
{
    return step + (ptrdiff_t)n * (lag * LAG_FACTORS);
}

/* Fills the factors of station i for z = dt/T > 0. */
static inline void lag_fill(double *factor, int n, int i, double z)
{
    const double gone = -expm1(-z); /* 1 - e^-z without cancellation */
    factor[num_at(i, LAG_STATE, n)] = 1.0 - gone;
    factor[num_at(i, LAG_OLD, n)] = gone / z - (1.0 - gone);
    factor[num_at(i, LAG_NEW, n)] = 1.0 - gone / z;
}

/* x of station i at the end of a step in which its input goes from `old` to `new`. */
static inline double lag_next(const double *factor, int n, int i, double x, double old, double new)
{
    return factor[num_at(i, LAG_STATE, n)] * x + factor[num_at(i, LAG_OLD, n)] * old +
           factor[num_at(i, LAG_NEW, n)] * new;
}

#endif
