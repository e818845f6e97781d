#include "core/aero/gust.h"

#include "core/aero/lag.h"
#include "core/num.h"
#include "core/range.h"

#include <stdio.h>
#include <stdlib.h>

static const double share[KUESSNER_LAGS] = {0.034968, 0.248865, 0.423745,
                                            0.192708, 0.073950, 0.025764};
static const double rate[KUESSNER_LAGS] = {0.009920, 0.090937,  0.362423,
                                           2.057553, 20.205769, 506.374575};

void gust_check(const struct gust_def *g, const char *pointer, struct failure_list *out)
{
    if (!g->given) {
        return;
    }
    if (g->type == GUST_TABLE) {
        range_check_table(g->n, g->time, g->velocity, pointer, "velocity_m_s", out);
        return;
    }
    char start[160], length[160], duration[160];
    (void)snprintf(start, sizeof start, "%.120s/start_s", pointer);
    (void)snprintf(length, sizeof length, "%.120s/length_m", pointer);
    (void)snprintf(duration, sizeof duration, "%.120s/duration_s", pointer);
    const struct range rule[] = {{start, g->start, 0.0, HUGE_VAL, false, false},
                                 {length, g->length, 0.0, HUGE_VAL, false, false},
                                 {duration, g->duration, 0.0, HUGE_VAL, false, false}};
    RANGE_CHECK(rule, out);
}

static double duration_of(const struct gust_def *g, double speed)
{
    return g->length > 0.0 ? g->length / speed : g->duration;
}

double gust_at(const struct gust_def *g, double speed, double t)
{
    if (!g->given) {
        return 0.0;
    }
    if (g->type == GUST_STEP) {
        return t > g->start ? g->amplitude : 0.0;
    }
    if (g->type == GUST_ONE_MINUS_COSINE) {
        const double x = (t - g->start) / duration_of(g, speed);
        return x > 0.0 && x < 1.0 ? 0.5 * g->amplitude * (1.0 - cos(2.0 * NUM_PI * x)) : 0.0;
    }
    int i = 0;
    while (i + 2 < g->n && t >= g->time[i + 1]) {
        i++;
    }
    const double x = num_clamp((t - g->time[i]) / (g->time[i + 1] - g->time[i]), 0.0, 1.0);
    return g->velocity[i] + x * (g->velocity[i + 1] - g->velocity[i]);
}

double gust_end(const struct gust_def *g, double speed)
{
    if (!g->given) {
        return 0.0;
    }
    if (g->type == GUST_TABLE) {
        return g->time[g->n - 1];
    }
    return g->start + (g->type == GUST_STEP ? 0.0 : duration_of(g, speed));
}

enum status kuessner_init(int n, const double *chord, double speed, double dt, struct kuessner *out)
{
    struct kuessner k = {.n = n};
    k.step = malloc((size_t)n * LAG_FACTORS * KUESSNER_LAGS * sizeof *k.step);
    if (k.step == NULL) {
        return ST_NO_MEMORY;
    }
    for (int lag = 0; lag < KUESSNER_LAGS; lag++) {
        for (int i = 0; i < n; i++) {
            lag_fill(lag_factors(k.step, n, lag), n, i, rate[lag] * 2.0 * speed / chord[i] * dt);
        }
    }
    *out = k;
    return ST_OK;
}

void kuessner_done(struct kuessner *k)
{
    free(k->step);
    *k = (struct kuessner){0};
}

void kuessner_step(const struct kuessner *k, double angle_old, double angle_new, double *x)
{
    for (int lag = 0; lag < KUESSNER_LAGS; lag++) {
        const double *factor = lag_factors(k->step, k->n, lag);
        double *restrict state = x + num_at(0, lag, k->n);
        for (int i = 0; i < k->n; i++) {
            state[i] = lag_next(factor, k->n, i, state[i], angle_old, angle_new);
        }
    }
}

void kuessner_steady(const struct kuessner *k, double angle, double *x)
{
    for (int i = 0; i < k->n * KUESSNER_LAGS; i++) {
        x[i] = angle;
    }
}

void kuessner_add(const struct kuessner *k, const double *x, double *angle)
{
    for (int lag = 0; lag < KUESSNER_LAGS; lag++) {
        const double *restrict state = x + num_at(0, lag, k->n);
        for (int i = 0; i < k->n; i++) {
            angle[i] += share[lag] * state[i];
        }
    }
}
