/* core/coupling/exponential.h
 * Exact step of the modal equations q'' + 2 zeta omega q' + omega^2 q = polynomial load.
 * Immutable after exponential_init; the step allocates nothing. */
#ifndef AEROM_CORE_COUPLING_EXPONENTIAL_H
#define AEROM_CORE_COUPLING_EXPONENTIAL_H

#include "core/coupling/load_polynomial.h"
#include "core/status.h"

struct exponential {
    int n_mode;
    /* (q, q')(dt) = p (q, q')(0) + sum_k w[k] c[k], for each mode. */
    double p[4][LIMIT_MODES]; /* p11 p12 p21 p22 */
    double w[LOAD_COEFFICIENTS][2][LIMIT_MODES];
};

/* omega2: squared frequencies [1/s^2]; damping: 2 zeta omega, zeta < 1 (n_mode each); dt [s]. */
void exponential_init(int n_mode, const double *omega2, const double *damping, double dt,
                      struct exponential *out);
void exponential_step(const struct exponential *e, const struct load_polynomial *load, double *q,
                      double *qd);

#endif
