#include "core/aero/network_lags.h"

#include "core/aero/lag.h"
#include "core/num.h"

#include <stdlib.h>
#include <string.h>

enum status network_lags_init(int n, const double *chord, double speed, double dt,
                              const struct network_frame *frame, struct network_lags *out)
{
    struct network_lags l = {.n = n, .n_lag = frame->n_lag};
    l.step = malloc((size_t)n * LAG_FACTORS * NETWORK_LAGS * sizeof *l.step);
    if (l.step == NULL) {
        return ST_NO_MEMORY;
    }
    for (int k = 0; k < l.n_lag; k++) {
        for (int i = 0; i < n; i++) {
            lag_fill(lag_factors(l.step, n, k), n, i, speed / chord[i] * dt / frame->lag[k]);
        }
    }
    *out = l;
    return ST_OK;
}

void network_lags_done(struct network_lags *l)
{
    free(l->step);
    *l = (struct network_lags){0};
}

static double *row(double *in, int n, int input)
{
    return in + num_at(0, input, n);
}

/* One quantity: its row and, from `first` on, those behind the lags. */
static void advance(const struct network_lags *l, const double *now, int input, int first,
                    double *in)
{
    double *old = row(in, l->n, input);
    for (int k = 0; k < l->n_lag; k++) {
        const double *factor = lag_factors(l->step, l->n, k);
        double *state = row(in, l->n, first + k);
        for (int i = 0; i < l->n; i++) {
            state[i] = lag_next(factor, l->n, i, state[i], old[i], now[i]);
        }
    }
    memcpy(old, now, (size_t)l->n * sizeof *now);
}

void network_lags_step(const struct network_lags *l, const double *alpha, const double *pitch_rate,
                       double *in)
{
    advance(l, alpha, NET_IN_ALPHA, NET_IN_ALPHA_LAG_1, in);
    advance(l, pitch_rate, NET_IN_PITCH_RATE, NET_IN_PITCH_LAG_1, in);
}

void network_lags_steady(const struct network_lags *l, const double *alpha,
                         const double *pitch_rate, double *in)
{
    const size_t bytes = (size_t)l->n * sizeof *alpha;
    memcpy(row(in, l->n, NET_IN_ALPHA), alpha, bytes);
    memcpy(row(in, l->n, NET_IN_PITCH_RATE), pitch_rate, bytes);
    for (int k = 0; k < NETWORK_LAGS; k++) {
        double *a = row(in, l->n, NET_IN_ALPHA_LAG_1 + k);
        double *p = row(in, l->n, NET_IN_PITCH_LAG_1 + k);
        for (int i = 0; i < l->n; i++) {
            a[i] = k < l->n_lag ? alpha[i] : 0.0;
            p[i] = k < l->n_lag ? pitch_rate[i] : 0.0;
        }
    }
}

void network_stall_inputs(int n, const double *x, double *in)
{
    static const struct {
        int input, state;
    } copy[] = {{NET_IN_STALL_BUBBLE, STALL_BUBBLE},
                {NET_IN_STALL_MOMENT, STALL_MOMENT},
                {NET_IN_STALL_LOST, STALL_LOST}};
    for (size_t k = 0; k < sizeof copy / sizeof copy[0]; k++) {
        memcpy(row(in, n, copy[k].input), x + num_at(0, copy[k].state, n), (size_t)n * sizeof *in);
    }
}
