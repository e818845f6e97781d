#include "core/network/lstm.h"

#include "core/aero/tanh_lanes.h"
#include "core/num.h"
#include "core/random.h"

#include <assert.h>
#include <string.h>

/* One body for every instruction set. */
#define KERNEL static inline __attribute__((always_inline)) void

enum gate { INPUT, FORGET, CELL, OUTPUT, GATES };

/* Where the arrays stand in p. */
struct layout {
    int u, b1, w2, b2, count;
};

static struct layout layout_of(const struct lstm *s)
{
    const int rows = GATES * s->n_hidden, u = s->n_in * rows, b1 = u + s->n_hidden * rows;
    const int w2 = b1 + rows, b2 = w2 + s->n_hidden * s->n_out;
    return (struct layout){.u = u, .b1 = b1, .w2 = w2, .b2 = b2, .count = b2 + s->n_out};
}

/* A column of the tape: the gates, then the state and its tanh. */
struct moment {
    const lanes *gate; /* (n_hidden x GATES) */
    const lanes *c, *tanh_c, *h;
};

static struct moment moment_at(const struct lstm *s, const lanes *tape, int k)
{
    const lanes *column = tape + num_at(0, k, lstm_tape_rows(s));
    const lanes *c = column + GATES * (ptrdiff_t)s->n_hidden;
    return (struct moment){
        .gate = column, .c = c, .tanh_c = c + s->n_hidden, .h = c + 2 * (ptrdiff_t)s->n_hidden};
}

int lstm_count(const struct lstm *s)
{
    return layout_of(s).count;
}

int lstm_tape_rows(const struct lstm *s)
{
    return (GATES + 3) * s->n_hidden;
}

void lstm_start(const struct lstm *s, uint64_t seed, double *p)
{
    const struct layout at = layout_of(s);
    const double in = sqrt(3.0 / (s->n_in + s->n_hidden)), out = sqrt(3.0 / s->n_hidden);
    for (int i = 0; i < at.count; i++) {
        const double size = i < at.b1 ? in : i < at.w2 ? 0.0 : i < at.b2 ? out : 0.0;
        p[i] = size > 0.0 ? size * (2.0 * random_uniform(&seed) - 1.0) : 0.0;
    }
    for (int k = 0; k < s->n_hidden; k++) {
        p[at.b1 + FORGET * s->n_hidden + k] = 1.0;
    }
}

KERNEL gates(const struct lstm *s, const double *p, const lanes *x, const lanes *h, lanes *gate)
{
    const struct layout at = layout_of(s);
    for (int r = 0; r < GATES * s->n_hidden; r++) {
        const double *w = p + num_at(0, r, s->n_in), *u = p + at.u + num_at(0, r, s->n_hidden);
        const double half = r / s->n_hidden == CELL ? 1.0 : 0.5;
        lanes sum = {0};
        sum += p[at.b1 + r];
        for (int i = 0; i < s->n_in; i++) {
            sum += w[i] * x[i];
        }
        for (int k = 0; k < s->n_hidden; k++) {
            sum += u[k] * h[k];
        }
        sum *= half;
        tanh_lanes(&sum);
        gate[r] = half * sum + (1.0 - half); /* sigmoid a = (1 + tanh a/2)/2 */
    }
}

KERNEL forward(const struct lstm *s, const double *p, int n, const lanes *x, lanes *tape, lanes *y)
{
    const struct layout at = layout_of(s);
    const int rows = lstm_tape_rows(s), m = s->n_hidden;
    for (int k = 0; k < n; k++) {
        const struct moment before = moment_at(s, tape, k);
        lanes *gate = tape + num_at(0, k + 1, rows);
        lanes *c = gate + GATES * (ptrdiff_t)m, *tanh_c = c + m, *h = tanh_c + m;
        gates(s, p, x + num_at(0, k, s->n_in), before.h, gate);
        for (int j = 0; j < m; j++) {
            c[j] = gate[FORGET * m + j] * before.c[j] + gate[INPUT * m + j] * gate[CELL * m + j];
            tanh_c[j] = c[j];
            tanh_lanes(&tanh_c[j]);
            h[j] = gate[OUTPUT * m + j] * tanh_c[j];
        }
        for (int o = 0; o < s->n_out; o++) {
            const double *w = p + at.w2 + num_at(0, o, m);
            lanes sum = {0};
            sum += p[at.b2 + o];
            for (int j = 0; j < m; j++) {
                sum += w[j] * h[j];
            }
            y[num_at(o, k, s->n_out)] = sum;
        }
    }
}

/* Derivatives by the state behind a step. */
struct adjoint {
    lanes h[LSTM_HIDDEN_MAX], c[LSTM_HIDDEN_MAX];
};

/* By the outputs of one step: into the weights behind the state, and into the state. */
KERNEL output_back(const struct lstm *s, const double *p, const lanes *h, const lanes *dy,
                   struct adjoint *a, lanes *g)
{
    const struct layout at = layout_of(s);
    for (int o = 0; o < s->n_out; o++) {
        const ptrdiff_t w = at.w2 + num_at(0, o, s->n_hidden);
        g[at.b2 + o] += dy[o];
        for (int j = 0; j < s->n_hidden; j++) {
            g[w + j] += dy[o] * h[j];
            a->h[j] += dy[o] * p[w + j];
        }
    }
}

/* Through state and gates: d (n_hidden x GATES) receives the derivatives by the sums before the
 * gates, a->c those by the state before. */
KERNEL state_back(const struct lstm *s, const struct moment *before, const struct moment *now,
                  struct adjoint *a, lanes *d)
{
    const int m = s->n_hidden;
    for (int j = 0; j < m; j++) {
        const lanes i = now->gate[INPUT * m + j], f = now->gate[FORGET * m + j];
        const lanes g = now->gate[CELL * m + j], o = now->gate[OUTPUT * m + j];
        const lanes tanh_c = now->tanh_c[j];
        const lanes dc = a->c[j] + a->h[j] * o * (1.0 - tanh_c * tanh_c);
        d[INPUT * m + j] = dc * g * i * (1.0 - i);
        d[FORGET * m + j] = dc * before->c[j] * f * (1.0 - f);
        d[CELL * m + j] = dc * i * (1.0 - g * g);
        d[OUTPUT * m + j] = a->h[j] * tanh_c * o * (1.0 - o);
        a->c[j] = dc * f;
    }
}

/* Through the weights of the gates; a->h receives the derivatives by the state before. */
KERNEL gates_back(const struct lstm *s, const double *p, const lanes *x, const lanes *h,
                  const lanes *d, struct adjoint *a, lanes *g)
{
    const struct layout at = layout_of(s);
    memset(a->h, 0, (size_t)s->n_hidden * sizeof *a->h);
    for (int r = 0; r < GATES * s->n_hidden; r++) {
        const ptrdiff_t w = num_at(0, r, s->n_in), u = at.u + num_at(0, r, s->n_hidden);
        for (int i = 0; i < s->n_in; i++) {
            g[w + i] += d[r] * x[i];
        }
        for (int k = 0; k < s->n_hidden; k++) {
            g[u + k] += d[r] * h[k];
            a->h[k] += d[r] * p[u + k];
        }
        g[at.b1 + r] += d[r];
    }
}

KERNEL backward(const struct lstm *s, const double *p, int n, const lanes *x, const lanes *tape,
                const lanes *dy, lanes *g)
{
    struct adjoint a;
    lanes d[GATES * LSTM_HIDDEN_MAX];
    memset(&a, 0, sizeof a);
    for (int k = n - 1; k >= 0; k--) {
        const struct moment before = moment_at(s, tape, k), now = moment_at(s, tape, k + 1);
        output_back(s, p, now.h, dy + num_at(0, k, s->n_out), &a, g);
        state_back(s, &before, &now, &a, d);
        gates_back(s, p, x + num_at(0, k, s->n_in), before.h, d, &a, g);
    }
}

/* The bodies, compiled for one instruction set. */
#define FOR_LEVEL(name, target)                                                                    \
    target static void forward_##name(const struct lstm *s, const double *p, int n,                \
                                      const lanes *x, lanes *tape, lanes *y)                       \
    {                                                                                              \
        forward(s, p, n, x, tape, y);                                                              \
    }                                                                                              \
    target static void backward_##name(const struct lstm *s, const double *p, int n,               \
                                       const lanes *x, const lanes *tape, const lanes *dy,         \
                                       lanes *g)                                                   \
    {                                                                                              \
        backward(s, p, n, x, tape, dy, g);                                                         \
    }

FOR_LEVEL(portable, )
FOR_LEVEL(avx2, SIMD_TARGET_AVX2)
FOR_LEVEL(avx512, SIMD_TARGET_AVX512)

void lstm_forward(const struct lstm *s, const double *p, int n, const lanes *x, lanes *tape,
                  lanes *y)
{
    static void (*const table[SIMD_LEVELS])(const struct lstm *, const double *, int, const lanes *,
                                            lanes *, lanes *) = {forward_portable, forward_avx2,
                                                                 forward_avx512};
    table[simd_level_of_machine()](s, p, n, x, tape, y);
}

void lstm_backward(const struct lstm *s, const double *p, int n, const lanes *x, const lanes *tape,
                   const lanes *dy, lanes *g)
{
    static void (*const table[SIMD_LEVELS])(const struct lstm *, const double *, int, const lanes *,
                                            const lanes *, const lanes *, lanes *) = {
        backward_portable, backward_avx2, backward_avx512};
    assert(s->n_hidden <= LSTM_HIDDEN_MAX);
    table[simd_level_of_machine()](s, p, n, x, tape, dy, g);
}
