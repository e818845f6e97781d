/* core/coupling/rk4.h
 * The paper's integrator (App. C): classical Runge-Kutta with an adaptive inner step.
 *
 * DEVIATION (C.7): the fourth stage uses f3; with f2 as printed the scheme is of third order.
 * A struct rk4 is one thread's; nothing is allocated. */
#ifndef AEROM_CORE_COUPLING_RK4_H
#define AEROM_CORE_COUPLING_RK4_H

#include "core/coupling/load_polynomial.h"
#include "core/status.h"

enum { RK4_STATES = 2 * LIMIT_MODES };

struct rk4 {
    int n_mode;
    const double *omega2;  /* borrowed (n_mode) */
    const double *damping; /* borrowed (n_mode) */
    double dt;             /* outer step [s] */
    double tolerance;      /* error per outer step, relative, in the energy norm */
    double inner;          /* last accepted inner step, as a share of dt */
    long inner_steps;      /* taken so far */
};

/* One classical step of length h = share * dt from tau to tau + share; x = (q, q') of length
 * 2 n_mode, changed in place. Eqs. (C.7), (C.8). */
void rk4_step(const struct rk4 *rk, const struct load_polynomial *load, double tau, double share,
              double *x);

/* Advances (q, q') over dt. Error by step doubling: one step against two halves. ST_NOT_CONVERGED
 * when more than 4096 inner steps would be needed. */
MUST_CHECK enum status rk4_advance(struct rk4 *rk, const struct load_polynomial *load, double *q,
                                   double *qd);

#endif
