/* Identification of damping: the signals of the validation data, an oscillator with a limit cycle,
 * and the whole path from a marched signal. */
#include "core/analysis/damping.h"
#include "core/analysis/pencil.h"
#include "core/num.h"
#include "tests/support/fixture.h"
#include "tests/verify/check.h"

#include <math.h>
#include <stdlib.h>

struct component {
    double amplitude, hz, ratio, phase;
};

struct signal {
    const char *name;
    struct component part[2];
    int n_part;
    double offset;
    double duration, rate; /* [s], [Hz] */
    double noise;          /* standard deviation */
    int order;             /* given to the pencil */
};

static const struct signal signals[] = {
    {"A", {{1.0, 4.1, 0.01, 0.0}}, 1, 0.0, 2.0, 250.0, 0.0, 40},
    {"B", {{1.0, 4.1, 0.02, 0.0}, {0.3, 33.0, 0.01, 0.3}}, 2, 0.0, 2.0, 500.0, 0.0, 40},
    {"C", {{1.0, 4.1, 0.02, 0.0}, {0.7, 4.5, 0.005, 0.5}}, 2, 0.0, 2.0, 250.0, 0.0, 40},
    {"D", {{1.0, 4.1, 0.03, 0.0}, {0.05, 33.0, -0.002, 0.0}}, 2, 0.4, 1.0, 500.0, 0.0, 40},
    {"A + 5 % noise", {{1.0, 4.1, 0.01, 0.0}}, 1, 0.0, 2.0, 250.0, 0.05, 2},
    {"C + 2 % noise", {{1.0, 4.1, 0.02, 0.0}, {0.7, 4.5, 0.005, 0.5}}, 2, 0.0, 2.0, 250.0, 0.02, 4},
};

static double component_at(const struct component *c, double t)
{
    const double omega = 2.0 * NUM_PI * c->hz;
    return c->amplitude * exp(-c->ratio * omega * t) *
           cos(omega * sqrt(1.0 - c->ratio * c->ratio) * t + c->phase);
}

static int sample(const struct signal *s, uint64_t seed, double *y)
{
    const int n = (int)(s->duration * s->rate);
    for (int i = 0; i < n; i++) {
        y[i] = s->offset + s->noise * fixture_normal(&seed);
        for (int k = 0; k < s->n_part; k++) {
            y[i] += component_at(&s->part[k], i / s->rate);
        }
    }
    return n;
}

/* The oscillating root of the fit nearest to a component; NaN without one. */
struct found {
    double hz, ratio;
};

static struct found nearest(const struct pencil_fit *fit, const struct component *c)
{
    struct found best = {.hz = (double)NAN, .ratio = (double)NAN};
    for (int k = 0; k < fit->n; k++) {
        const struct pencil_root *r = &fit->root[k];
        const double size = hypot(r->sigma, r->omega), hz = size / (2.0 * NUM_PI);
        if (r->omega > 0.0 && !(fabs(hz - c->hz) >= fabs(best.hz - c->hz))) {
            best = (struct found){.hz = hz, .ratio = -r->sigma / size};
        }
    }
    return best;
}

enum { SAMPLES = 1000, SEEDS = 20 };

static void clean_signal(struct check_list *list, const struct signal *s)
{
    static double y[SAMPLES];
    struct pencil_fit fit = {0};
    const int n = sample(s, 1, y);
    if (pencil_identify(n, y, 1.0 / s->rate, 1e-3, s->order, &fit) != ST_OK) {
        fit.n = 0;
    }
    for (int k = 0; k < s->n_part; k++) {
        const struct found f = nearest(&fit, &s->part[k]);
        check_add(list, CHECK_ABSOLUTE, "", f.ratio, s->part[k].ratio, 0.0003, "exact signal",
                  "signal %s, %.1f Hz: damping ratio", s->name, s->part[k].hz);
        check_add(list, CHECK_RELATIVE, "Hz", f.hz, s->part[k].hz, 0.002, "exact signal",
                  "signal %s, %.1f Hz: frequency", s->name, s->part[k].hz);
    }
}

/* One draw of noise says little: the rms error over several is compared. */
static void noisy_signal(struct check_list *list, const struct signal *s)
{
    static double y[SAMPLES];
    double ratio[2] = {0}, hz[2] = {0};
    for (uint64_t seed = 1; seed <= SEEDS; seed++) {
        struct pencil_fit fit = {0};
        const int n = sample(s, seed, y);
        if (pencil_identify(n, y, 1.0 / s->rate, 1e-3, s->order, &fit) != ST_OK) {
            fit.n = 0;
        }
        for (int k = 0; k < s->n_part; k++) {
            const struct found f = nearest(&fit, &s->part[k]);
            ratio[k] += num_sq(f.ratio - s->part[k].ratio) / SEEDS;
            hz[k] += num_sq(f.hz / s->part[k].hz - 1.0) / SEEDS;
        }
    }
    for (int k = 0; k < s->n_part; k++) {
        check_add(list, CHECK_AT_MOST, "", sqrt(ratio[k]), 0.0, 0.0015, "exact signal",
                  "signal %s, %.1f Hz: rms error of the ratio, %d draws", s->name, s->part[k].hz,
                  SEEDS);
        check_add(list, CHECK_AT_MOST, "", sqrt(hz[k]), 0.0, 0.002, "exact signal",
                  "signal %s, %.1f Hz: rms relative error of the frequency", s->name,
                  s->part[k].hz);
    }
}

/* x'' - mu (1 - x^2) x' + x = 0 by fine Runge-Kutta steps, sampled every `every` of them. */
static void van_der_pol(double mu, double dt, int every, int n, double *y)
{
    double x = 0.05, v = 0.0;
    for (int i = 0; i < n * every; i++) {
        double kx[4], kv[4];
        for (int s = 0; s < 4; s++) {
            const double share = s == 0 ? 0.0 : (s == 3 ? 1.0 : 0.5);
            const double px = x + (s > 0 ? share * dt * kx[s - 1] : 0.0);
            const double pv = v + (s > 0 ? share * dt * kv[s - 1] : 0.0);
            kx[s] = pv;
            kv[s] = mu * (1.0 - px * px) * pv - px;
        }
        if (i % every == 0) {
            y[i / every] = x;
        }
        x += dt * (kx[0] + 2.0 * kx[1] + 2.0 * kx[2] + kx[3]) / 6.0;
        v += dt * (kv[0] + 2.0 * kv[1] + 2.0 * kv[2] + kv[3]) / 6.0;
    }
}

static void limit_cycle(struct check_list *list)
{
    enum { WINDOWS = 5, PER_WINDOW = 240 };
    static const double expected[WINDOWS] = {-0.0249, -0.023, -0.0115, -0.0012, -1e-5};
    static const double allowed[WINDOWS] = {0.0003, 0.001, 0.001, 0.0003, 0.0001};
    static double y[WINDOWS * PER_WINDOW];
    const struct component c = {.hz = 0.5 / NUM_PI};
    van_der_pol(0.05, 0.0125, 20, WINDOWS * PER_WINDOW, y);
    for (int k = 0; k < WINDOWS; k++) {
        struct pencil_fit fit = {0};
        if (pencil_identify(PER_WINDOW, y + k * PER_WINDOW, 0.25, 1e-3, 2, &fit) != ST_OK) {
            fit.n = 0;
        }
        check_add(list, CHECK_ABSOLUTE, "", nearest(&fit, &c).ratio, expected[k], allowed[k],
                  "[C], validation data 6", "van der Pol mu 0.05, t %d to %d: ratio", 60 * k,
                  60 * (k + 1));
    }
}

/* The path of a run: 3 s at 2e-4 s, window, block means, pencil, cross-checks. */
static void marched_signal(struct check_list *list)
{
    enum { N = 15001 };
    static const struct component part[2] = {{0.02, 4.1, 0.02, 0.4}, {0.005, 33.0, 0.01, 1.0}};
    static double y[N];
    const double dt = 2e-4;
    for (int i = 0; i < N; i++) {
        y[i] = 0.01 + component_at(&part[0], dt * i) + component_at(&part[1], dt * i);
    }
    const struct damping_system system = {
        .n_mode = 4, .frequency_low = 4.1, .frequency_high = 72.0, .frequency_torsion = 34.0};
    struct damping_result r = {0};
    if (damping_identify(N, y, dt, &system, &r) != ST_OK || r.n_root < 2) {
        r = (struct damping_result){.root = {{.ratio = (double)NAN}, {.ratio = (double)NAN}}};
    }
    for (int k = 0; k < 2; k++) {
        const double omega = 2.0 * NUM_PI * part[k].hz;
        const double start = part[k].amplitude * exp(-part[k].ratio * omega * r.window_from);
        check_add(list, CHECK_ABSOLUTE, "", r.root[k].ratio, part[k].ratio, 0.0003, "exact signal",
                  "marched signal, %.1f Hz: damping ratio", part[k].hz);
        check_add(list, CHECK_RELATIVE, "Hz", r.root[k].frequency_hz,
                  part[k].hz * sqrt(1.0 - num_sq(part[k].ratio)), 0.002, "exact signal",
                  "marched signal, %.1f Hz: damped frequency", part[k].hz);
        check_add(list, CHECK_RELATIVE, "", r.root[k].amplitude, start, 0.01, "exact signal",
                  "marched signal, %.1f Hz: amplitude at the start of the window", part[k].hz);
    }
    check_add(list, CHECK_ABSOLUTE, "", r.torsion, 1.0, 0.0, "exact signal",
              "marched signal: index of the torsion root");
    check_add(list, CHECK_ABSOLUTE, "", r.hilbert_ratio, part[0].ratio, 0.001, "exact signal",
              "marched signal: ratio from the envelope");
}

static void single_mode(struct check_list *list)
{
    enum { N = 15001 };
    static const struct component c = {1.0, 4.1, 0.01, 0.0};
    static double y[N];
    const double dt = 2e-4;
    for (int i = 0; i < N; i++) {
        y[i] = component_at(&c, dt * i);
    }
    const struct damping_system system = {.n_mode = 1, .frequency_low = 4.1, .frequency_high = 4.1};
    struct damping_result r = {0};
    if (damping_identify(N, y, dt, &system, &r) != ST_OK) {
        r.hilbert_ratio = r.log_decrement = (double)NAN;
    }
    check_add(list, CHECK_ABSOLUTE, "", r.root[0].ratio, 0.01, 0.0003, "exact signal",
              "one mode: ratio from the pencil");
    check_add(list, CHECK_ABSOLUTE, "", r.hilbert_ratio, 0.01, 0.0003, "exact signal",
              "one mode: ratio from the envelope");
    const double d = r.log_decrement;
    check_add(list, CHECK_ABSOLUTE, "", d / sqrt(4.0 * NUM_PI * NUM_PI + d * d), 0.01, 0.0005,
              "exact signal", "one mode: ratio from the logarithmic decrement");
}

static void fill(struct check_list *list)
{
    for (size_t i = 0; i < sizeof signals / sizeof signals[0]; i++) {
        if (signals[i].noise > 0.0) {
            noisy_signal(list, &signals[i]);
        } else {
            clean_signal(list, &signals[i]);
        }
    }
    limit_cycle(list);
    marched_signal(list);
    single_mode(list);
}

const struct check_group group_damping = {
    .name = "damping",
    .title = "Damping of a time signal",
    .text = "Signals A to D of the validation data, section 6, through the matrix pencil: order by "
            "the singular values (1e-3) for the clean ones, given for the noisy ones. The van der "
            "Pol oscillator shows that damping of a limit cycle belongs to a window. The marched "
            "signal goes the way of a run: window, block means, pencil, envelope.",
    .fill = fill,
};
