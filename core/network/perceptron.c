#include "core/network/perceptron.h"

#include "core/num.h"
#include "core/random.h"
#include "core/simd.h"

#include <assert.h>
#include <string.h>

/* Where the arrays stand in p. */
struct layout {
    int b1, w2, b2, count;
};

static struct layout layout_of(const struct perceptron *s)
{
    const int b1 = s->n_in * s->n_hidden, w2 = b1 + s->n_hidden;
    const int b2 = w2 + s->n_hidden * s->n_out;
    return (struct layout){.b1 = b1, .w2 = w2, .b2 = b2, .count = b2 + (s->paired ? 0 : s->n_out)};
}

int perceptron_count(const struct perceptron *s)
{
    return layout_of(s).count;
}

static double within(uint64_t *seed, double size)
{
    return size * (2.0 * random_uniform(seed) - 1.0);
}

void perceptron_start(const struct perceptron *s, uint64_t seed, double *p)
{
    const struct layout at = layout_of(s);
    /* Variance 1 of the sum over inputs of variance 1, and of the outputs. */
    const double in = sqrt(3.0 / s->n_in);
    const double out = sqrt(3.0 / s->n_hidden) * (s->paired ? 0.5 : 1.0);
    for (int i = 0; i < at.count; i++) {
        p[i] = i < at.b1   ? within(&seed, in)
               : i < at.w2 ? within(&seed, 1.0)
               : i < at.b2 ? within(&seed, out)
                           : 0.0;
    }
}

/* The parameters as the kernel takes them: neurons next to each other, filled up with zeros to
 * whole lanes, of which nothing comes. */
struct pass {
    int n_in, n_hidden, n_out, padded, rows;
    bool paired;
    double w1[LIMIT_NET_INPUTS * LIMIT_NET_HIDDEN], b1[LIMIT_NET_HIDDEN];   /* w1 (padded x n_in) */
    double w2[LIMIT_NET_OUTPUTS * LIMIT_NET_HIDDEN], b2[LIMIT_NET_OUTPUTS]; /* (padded x n_out) */
};
static_assert(LIMIT_NET_HIDDEN % LANES == 0, "room for whole lanes");

/* The sum of the weighted squares of the residuals of n samples; z as perceptron_basis, NULL:
 * only the sum. */
typedef double (*pass_fn)(const struct pass *q, int n, const double *x, const double *t,
                          const double *w, double *z);

#define KERNEL_STEM pass
#define KERNEL_FILE "core/network/perceptron_kernel.inc"
#include "core/simd_levels.inc"

static void prepare(const struct perceptron *s, const double *p, struct pass *q)
{
    const struct layout at = layout_of(s);
    q->n_in = s->n_in;
    q->n_hidden = s->n_hidden;
    q->n_out = s->n_out;
    q->padded = simd_padded(s->n_hidden);
    q->rows = perceptron_basis_rows(s);
    q->paired = s->paired;
    memset(q->w1, 0, (size_t)q->padded * (size_t)s->n_in * sizeof *q->w1);
    memset(q->w2, 0, (size_t)q->padded * (size_t)s->n_out * sizeof *q->w2);
    memset(q->b1, 0, (size_t)q->padded * sizeof *q->b1);
    memset(q->b2, 0, sizeof q->b2);
    for (int k = 0; k < s->n_hidden; k++) {
        for (int i = 0; i < s->n_in; i++) {
            q->w1[num_at(k, i, q->padded)] = p[num_at(i, k, s->n_in)];
        }
        for (int o = 0; o < s->n_out; o++) {
            q->w2[num_at(k, o, q->padded)] = p[at.w2 + num_at(k, o, s->n_hidden)];
        }
        q->b1[k] = p[at.b1 + k];
    }
    for (int o = 0; o < s->n_out && !s->paired; o++) {
        q->b2[o] = p[at.b2 + o];
    }
}

static double run(const struct perceptron *s, const double *p, int n, const double *x,
                  const double *t, const double *w, double *z)
{
    static const pass_fn table[SIMD_LEVELS] = {pass_portable, pass_avx2, pass_avx512};
    struct pass q;
    prepare(s, p, &q);
    return table[simd_level_of_machine()](&q, n, x, t, w, z);
}

double perceptron_error(const struct perceptron *s, const double *p, int n, const double *x,
                        const double *t, const double *w)
{
    return run(s, p, n, x, t, w, NULL) / ((double)n * s->n_out);
}

/* After the neurons, and after one. */
int perceptron_residual_row(const struct perceptron *s)
{
    return (s->n_in + 2) * s->n_hidden + (s->paired ? 0 : 1);
}

int perceptron_basis_rows(const struct perceptron *s)
{
    return simd_padded(perceptron_residual_row(s) + s->n_out);
}

void perceptron_basis(const struct perceptron *s, const double *p, int n, const double *x,
                      const double *t, const double *w, double *z)
{
    (void)run(s, p, n, x, t, w, z);
}

/* A row of the basis before those of the hidden layer's outputs: its neuron, and its place in p. */
struct weight_row {
    int neuron, place;
};

static struct weight_row weight_row(const struct perceptron *s, int r)
{
    const int input = r / s->n_hidden, k = r % s->n_hidden;
    const int place = input < s->n_in ? k * s->n_in + input : r; /* of w1, of b1 */
    return (struct weight_row){.neuron = k, .place = place};
}

/* Place in p of what output o multiplies with row l of hidden and one. */
static int output_place(const struct perceptron *s, const struct layout *at, int o, int l)
{
    return l < s->n_hidden ? at->w2 + o * s->n_hidden + l : at->b2 + o;
}

/* Rows of the basis that an output has weights for: neurons, and one. */
static int output_rows(const struct perceptron *s)
{
    return s->n_hidden + (s->paired ? 0 : 1);
}

/* Sum over the outputs of the products of w2 of neuron k with that of each other: (n_hidden). */
static void both_outputs(const struct perceptron *s, const double *w2, int k, double *both)
{
    for (int l = 0; l < s->n_hidden; l++) {
        both[l] = 0.0;
        for (int o = 0; o < s->n_out; o++) {
            both[l] += w2[num_at(k, o, s->n_hidden)] * w2[num_at(l, o, s->n_hidden)];
        }
    }
}

void perceptron_normal(const struct perceptron *s, const double *p, const double *zz, double *gram)
{
    const struct layout at = layout_of(s);
    const int rows = perceptron_basis_rows(s), before = (s->n_in + 1) * s->n_hidden;
    const double *w2 = p + at.w2;
    double both[LIMIT_NET_HIDDEN];
    memset(gram, 0, (size_t)at.count * (size_t)at.count * sizeof *gram);
    for (int c = 0; c < before; c++) {
        const struct weight_row column = weight_row(s, c);
        both_outputs(s, w2, column.neuron, both);
        for (int r = c; r < before; r++) {
            const struct weight_row row = weight_row(s, r);
            const int low = row.place > column.place ? row.place : column.place;
            gram[num_at(low, row.place + column.place - low, at.count)] =
                both[row.neuron] * zz[num_at(r, c, rows)];
        }
        for (int o = 0; o < s->n_out; o++) {
            const double w = w2[num_at(column.neuron, o, s->n_hidden)];
            for (int l = 0; l < output_rows(s); l++) {
                gram[num_at(output_place(s, &at, o, l), column.place, at.count)] =
                    w * zz[num_at(before + l, c, rows)];
            }
        }
    }
    for (int o = 0; o < s->n_out; o++) {
        for (int m = 0; m < output_rows(s); m++) {
            const int c = output_place(s, &at, o, m);
            for (int l = m; l < output_rows(s); l++) {
                gram[num_at(output_place(s, &at, o, l), c, at.count)] =
                    zz[num_at(before + l, before + m, rows)];
            }
        }
    }
}

void perceptron_slope(const struct perceptron *s, const double *p, int stride, const double *ze,
                      double *slope)
{
    const struct layout at = layout_of(s);
    const int before = (s->n_in + 1) * s->n_hidden;
    memset(slope, 0, (size_t)at.count * sizeof *slope);
    for (int o = 0; o < s->n_out; o++) {
        for (int c = 0; c < before; c++) {
            const struct weight_row column = weight_row(s, c);
            slope[column.place] +=
                p[at.w2 + num_at(column.neuron, o, s->n_hidden)] * ze[num_at(o, c, stride)];
        }
        for (int m = 0; m < output_rows(s); m++) {
            slope[output_place(s, &at, o, m)] = ze[num_at(o, before + m, stride)];
        }
    }
}
