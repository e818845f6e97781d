#include "core/aero/network_memory.h"

#include "core/aero/lag.h"
#include "core/aero/oscillator.h"
#include "core/num.h"

#include <stdlib.h>
#include <string.h>

/* A quantity and the first of its rows behind lags and behind oscillators; behind an oscillator
 * stand the value and its rate. */
static const struct quantity {
    int now, lag, oscillator;
} angle = {NET_IN_ALPHA, NET_IN_ALPHA_LAG_1, NET_IN_ALPHA_OSCILLATOR_1},
  rate = {NET_IN_PITCH_RATE, NET_IN_PITCH_LAG_1, NET_IN_PITCH_OSCILLATOR_1};

enum status network_memory_init(int n, const double *chord, double speed, double dt,
                                const struct network_frame *frame, struct network_memory *out)
{
    struct network_memory m = {.n = n, .n_lag = frame->n_lag, .n_oscillator = frame->n_oscillator};
    const size_t lags = (size_t)n * LAG_FACTORS * NETWORK_LAGS;
    const size_t oscillators = (size_t)n * OSCILLATOR_FACTORS * NETWORK_OSCILLATORS;
    m.lag = malloc((lags + oscillators) * sizeof *m.lag);
    if (m.lag == NULL) {
        return ST_NO_MEMORY;
    }
    m.oscillator = m.lag + lags;
    for (int i = 0; i < n; i++) {
        const double step = speed / chord[i] * dt;
        for (int k = 0; k < m.n_lag; k++) {
            lag_fill(lag_factors(m.lag, n, k), n, i, step / frame->lag[k]);
        }
        for (int k = 0; k < m.n_oscillator; k++) {
            oscillator_fill(oscillator_factors(m.oscillator, n, k), n, i,
                            2.0 * NUM_PI * frame->oscillator[k].frequency * step,
                            frame->oscillator[k].damping);
        }
    }
    *out = m;
    return ST_OK;
}

void network_memory_done(struct network_memory *m)
{
    free(m->lag);
    *m = (struct network_memory){0};
}

static double *row(double *in, int n, int input)
{
    return in + num_at(0, input, n);
}

static void advance(const struct network_memory *m, const double *now, const struct quantity *q,
                    double *in)
{
    double *old = row(in, m->n, q->now);
    for (int k = 0; k < m->n_lag; k++) {
        const double *factor = lag_factors(m->lag, m->n, k);
        double *state = row(in, m->n, q->lag + k);
        for (int i = 0; i < m->n; i++) {
            state[i] = lag_next(factor, m->n, i, state[i], old[i], now[i]);
        }
    }
    for (int k = 0; k < m->n_oscillator; k++) {
        const double *factor = oscillator_factors(m->oscillator, m->n, k);
        double *x = row(in, m->n, q->oscillator + 2 * k), *y = x + m->n;
        for (int i = 0; i < m->n; i++) {
            oscillator_next(factor, m->n, i, old[i], now[i], &x[i], &y[i]);
        }
    }
    memcpy(old, now, (size_t)m->n * sizeof *now);
}

void network_memory_step(const struct network_memory *m, const double *alpha,
                         const double *pitch_rate, double *in)
{
    advance(m, alpha, &angle, in);
    advance(m, pitch_rate, &rate, in);
}

/* Rows of lags and oscillators that the network does not have are zero. */
static void stand(const struct network_memory *m, const double *now, const struct quantity *q,
                  double *in)
{
    const size_t bytes = (size_t)m->n * sizeof *now;
    memcpy(row(in, m->n, q->now), now, bytes);
    memset(row(in, m->n, q->lag), 0, NETWORK_LAGS * bytes);
    memset(row(in, m->n, q->oscillator), 0, 2 * NETWORK_OSCILLATORS * bytes);
    for (int k = 0; k < m->n_lag; k++) {
        memcpy(row(in, m->n, q->lag + k), now, bytes);
    }
    for (int k = 0; k < m->n_oscillator; k++) {
        memcpy(row(in, m->n, q->oscillator + 2 * k), now, bytes);
    }
}

void network_memory_steady(const struct network_memory *m, const double *alpha,
                           const double *pitch_rate, double *in)
{
    stand(m, alpha, &angle, in);
    stand(m, pitch_rate, &rate, in);
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
