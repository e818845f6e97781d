#include "core/aero/attached.h"

#include "core/aero/lag.h"
#include "core/num.h"

#include <math.h>
#include <stdlib.h>

static const double share[ATTACHED_LAGS] = {0.0198333, 0.1225634, 0.2693821, 0.0882212};
static const double rate[ATTACHED_LAGS] = {0.00635589, 0.05401174, 0.20526856, 0.69061335};

double attached_rate(int lag)
{
    return rate[lag];
}

double attached_share(int lag)
{
    return share[lag];
}

enum status attached_init(int n, const double *chord, double speed, double dt, struct attached *out)
{
    struct attached a = {.n = n};
    a.step = malloc((size_t)n * LAG_FACTORS * ATTACHED_LAGS * sizeof *a.step);
    if (a.step == NULL) {
        return ST_NO_MEMORY;
    }
    for (int lag = 0; lag < ATTACHED_LAGS; lag++) {
        for (int i = 0; i < n; i++) {
            lag_fill(lag_factors(a.step, n, lag), n, i, rate[lag] * 2.0 * speed / chord[i] * dt);
        }
    }
    *out = a;
    return ST_OK;
}

void attached_done(struct attached *a)
{
    free(a->step);
    *a = (struct attached){0};
}

void attached_step(const struct attached *a, const double *alpha_old, const double *alpha_new,
                   double *x)
{
    for (int lag = 0; lag < ATTACHED_LAGS; lag++) {
        const double *factor = lag_factors(a->step, a->n, lag);
        double *restrict state = x + num_at(0, lag, a->n);
        for (int i = 0; i < a->n; i++) {
            state[i] = lag_next(factor, a->n, i, state[i], alpha_old[i], alpha_new[i]);
        }
    }
}

void attached_steady(int n, const double *alpha, double *x)
{
    for (int lag = 0; lag < ATTACHED_LAGS; lag++) {
        for (int i = 0; i < n; i++) {
            x[num_at(i, lag, n)] = alpha[i];
        }
    }
}

void attached_angle(int n, const double *alpha, const double *x, double *out)
{
    for (int i = 0; i < n; i++) {
        out[i] = 0.5 * alpha[i];
    }
    for (int lag = 0; lag < ATTACHED_LAGS; lag++) {
        const double *restrict state = x + num_at(0, lag, n);
        for (int i = 0; i < n; i++) {
            out[i] += share[lag] * state[i];
        }
    }
}

double attached_mass(double density, double chord)
{
    return 0.25 * NUM_PI * density * num_sq(chord);
}

double attached_inertia(double density, double chord)
{
    return NUM_PI / 128.0 * density * num_sq(num_sq(chord));
}

/* pi rho b^2 V theta_dot and -pi rho b^3 V theta_dot/2 over rho V^2 c/2 and rho V^2 c^2/2. */
double attached_cl_rate(void)
{
    return 0.5 * NUM_PI;
}

double attached_cm_rate(void)
{
    return -0.125 * NUM_PI;
}
