#include "core/network/lstm.h"

#include "core/num.h"
#include "core/random.h"

#include <assert.h>
#include <string.h>

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

#define KERNEL_STEM lstm
#define KERNEL_FILE "core/network/lstm_kernel.inc"
#include "core/simd_levels.inc"

void lstm_forward(const struct lstm *s, const double *p, int n, const lanes *x, lanes *tape,
                  lanes *y)
{
    static void (*const table[SIMD_LEVELS])(const struct lstm *, const double *, int, const lanes *,
                                            lanes *, lanes *) = {
        forward_lstm_portable, forward_lstm_avx2, forward_lstm_avx512};
    table[simd_level_of_machine()](s, p, n, x, tape, y);
}

void lstm_backward(const struct lstm *s, const double *p, int n, const lanes *x, const lanes *tape,
                   const lanes *dy, lanes *g)
{
    static void (*const table[SIMD_LEVELS])(const struct lstm *, const double *, int, const lanes *,
                                            const lanes *, const lanes *, lanes *) = {
        backward_lstm_portable, backward_lstm_avx2, backward_lstm_avx512};
    assert(s->n_hidden <= LSTM_HIDDEN_MAX);
    table[simd_level_of_machine()](s, p, n, x, tape, dy, g);
}
