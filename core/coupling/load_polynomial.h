/* core/coupling/load_polynomial.h
 * Extrapolation of the modal loads over the next time step, Eq. (C.9).
 *
 * DEVIATION: (C.9) as printed is exact for linear histories only. Newton's backward form of the
 * chosen order is exact for polynomials up to that order; the order is lower at the start, while
 * the history is short. The result is a polynomial in tau = t/dt in [0, 1]. */
#ifndef AEROM_CORE_COUPLING_LOAD_POLYNOMIAL_H
#define AEROM_CORE_COUPLING_LOAD_POLYNOMIAL_H

#include "core/limits.h"

enum { LOAD_COEFFICIENTS = LIMIT_LOAD_ORDER + 1 };

struct load_polynomial {
    int n_mode;
    int order;   /* wanted, 0..LIMIT_LOAD_ORDER */
    int n_known; /* load sets in the history, at most order + 1 */
    double history[LOAD_COEFFICIENTS][LIMIT_MODES]; /* newest first */
    int degree;                                     /* of the present polynomial */
    double c[LOAD_COEFFICIENTS][LIMIT_MODES];       /* load(tau) = sum c[k] tau^k */
};

void load_polynomial_init(int n_mode, int order, struct load_polynomial *p);
/* Takes the loads (n_mode) at the new time and rebuilds the polynomial. */
void load_polynomial_push(struct load_polynomial *p, const double *load);
/* Load of a mode at tau. */
double load_polynomial_at(const struct load_polynomial *p, int mode, double tau);

#endif
