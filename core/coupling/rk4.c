#include "core/coupling/rk4.h"

#include <assert.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

enum { STAGES = 4, INNER_MAX = 4096 };

/* Butcher tableau of the classical scheme: node and weight of each stage. */
static const double node[STAGES] = {0.0, 0.5, 0.5, 1.0};
static const double weight[STAGES] = {1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0};

/* x' = A x + b of Eq. (C.6) as a first-order system. */
static void derivative(const struct rk4 *rk, const struct load_polynomial *load, double tau,
                       const double *x, double *dx)
{
    const int n = rk->n_mode;
    for (int j = 0; j < n; j++) {
        dx[j] = x[n + j];
        dx[n + j] =
            load_polynomial_at(load, j, tau) - rk->damping[j] * x[n + j] - rk->omega2[j] * x[j];
    }
}

void rk4_step(const struct rk4 *rk, const struct load_polynomial *load, double tau, double share,
              double *x)
{
    const int n = 2 * rk->n_mode;
    const double h = share * rk->dt;
    double slope[RK4_STATES], stage[RK4_STATES], sum[RK4_STATES];
    memset(slope, 0, sizeof slope);
    memset(sum, 0, sizeof sum);
    for (int s = 0; s < STAGES; s++) {
        for (int i = 0; i < n; i++) {
            stage[i] = x[i] + h * node[s] * slope[i];
        }
        derivative(rk, load, tau + share * node[s], stage, slope);
        for (int i = 0; i < n; i++) {
            sum[i] += weight[s] * slope[i];
        }
    }
    for (int i = 0; i < n; i++) {
        x[i] += h * sum[i];
    }
}

/* Error of x against y over the size of y, both in the energy norm. */
static double energy_error(const struct rk4 *rk, const double *x, const double *y)
{
    const int n = rk->n_mode;
    double error = 0.0, size = 1e-300;
    for (int j = 0; j < n; j++) {
        const double dq = x[j] - y[j], dv = x[n + j] - y[n + j];
        error += rk->omega2[j] * dq * dq + dv * dv;
        size += rk->omega2[j] * y[j] * y[j] + y[n + j] * y[n + j];
    }
    return sqrt(error / size);
}

enum status rk4_advance(struct rk4 *rk, const struct load_polynomial *load, double *q, double *qd)
{
    assert(rk->n_mode <= LIMIT_MODES);
    const size_t half = (size_t)rk->n_mode * sizeof *q;
    double x[RK4_STATES], one[RK4_STATES], two[RK4_STATES];
    memcpy(x, q, half);
    memcpy(x + rk->n_mode, qd, half);
    double tau = 0.0;
    double share = rk->inner > 0.0 ? rk->inner : 1.0;
    for (int count = 0; tau < 1.0; count++) {
        if (count == INNER_MAX) {
            return ST_NOT_CONVERGED;
        }
        const bool last = tau + share >= 1.0 - 1e-12;
        const double h = last ? 1.0 - tau : share;
        memcpy(one, x, 2 * half);
        memcpy(two, x, 2 * half);
        rk4_step(rk, load, tau, h, one);
        rk4_step(rk, load, tau, 0.5 * h, two);
        rk4_step(rk, load, tau + 0.5 * h, 0.5 * h, two);
        rk->inner_steps++;
        /* Two half steps are 16 times as good as one, so the difference is 15 errors. */
        const double error = energy_error(rk, one, two) / 15.0;
        if (!isfinite(error)) {
            return ST_NOT_FINITE;
        }
        const double allowed = rk->tolerance * h; /* the tolerance is for the whole outer step */
        if (error > allowed && h > 1e-6) {
            share = 0.5 * h;
            continue;
        }
        memcpy(x, two, 2 * half);
        tau = last ? 1.0 : tau + h;
        if (!last || h >= share) {
            share = error < allowed / 40.0 && share < 1.0 ? fmin(1.0, 2.0 * share) : share;
        }
    }
    rk->inner = share;
    memcpy(q, x, half);
    memcpy(qd, x + rk->n_mode, half);
    return ST_OK;
}
