#include "core/network/perceptron.h"

#include "core/aero/tanh_lanes.h"
#include "core/num.h"
#include "core/random.h"
#include "core/simd.h"

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

/* tanh of w1 x + sign b1, of all neurons: hidden (n_hidden). */
static void activate(const struct perceptron *s, const double *p, const double *x, double sign,
                     double *hidden)
{
    const double *b1 = p + layout_of(s).b1;
    for (int first = 0; first < s->n_hidden; first += LANES) {
        const int used = s->n_hidden - first < LANES ? s->n_hidden - first : LANES;
        lanes v = {0};
        for (int l = 0; l < used; l++) {
            const double *w = p + num_at(0, first + l, s->n_in);
            double sum = sign * b1[first + l];
            for (int i = 0; i < s->n_in; i++) {
                sum += w[i] * x[i];
            }
            v[l] = sum;
        }
        tanh_lanes(&v);
        memcpy(hidden + first, &v, (size_t)used * sizeof *hidden);
    }
}

/* What the neurons give, and its derivatives by w1 x and by b1 (n_hidden each). */
struct neurons {
    double value[LIMIT_NET_HIDDEN], by_input[LIMIT_NET_HIDDEN], by_bias[LIMIT_NET_HIDDEN];
};

static void neurons_at(const struct perceptron *s, const double *p, const double *x,
                       struct neurons *out)
{
    double other[LIMIT_NET_HIDDEN];
    activate(s, p, x, 1.0, out->value);
    if (s->paired) {
        activate(s, p, x, -1.0, other);
    }
    for (int k = 0; k < s->n_hidden; k++) {
        const double d = 1.0 - num_sq(out->value[k]);
        const double d_other = s->paired ? 1.0 - num_sq(other[k]) : 0.0;
        out->value[k] += s->paired ? other[k] : 0.0;
        out->by_input[k] = d + d_other;
        out->by_bias[k] = d - d_other;
    }
}

static void outputs(const struct perceptron *s, const double *p, const double *hidden, double *y)
{
    const struct layout at = layout_of(s);
    for (int o = 0; o < s->n_out; o++) {
        const double *w = p + at.w2 + num_at(0, o, s->n_hidden);
        y[o] = s->paired ? 0.0 : p[at.b2 + o];
        for (int k = 0; k < s->n_hidden; k++) {
            y[o] += w[k] * hidden[k];
        }
    }
}

void perceptron_eval(const struct perceptron *s, const double *p, const double *x, double *hidden,
                     double *y)
{
    double other[LIMIT_NET_HIDDEN];
    activate(s, p, x, 1.0, hidden);
    if (s->paired) {
        activate(s, p, x, -1.0, other);
        for (int k = 0; k < s->n_hidden; k++) {
            hidden[k] += other[k];
        }
    }
    outputs(s, p, hidden, y);
}

double perceptron_error(const struct perceptron *s, const double *p, int n, const double *x,
                        const double *t, const double *w)
{
    double hidden[LIMIT_NET_HIDDEN], y[LIMIT_NET_OUTPUTS], sum = 0.0;
    for (int k = 0; k < n; k++) {
        double square = 0.0;
        perceptron_eval(s, p, x + num_at(0, k, s->n_in), hidden, y);
        for (int o = 0; o < s->n_out; o++) {
            square += num_sq(y[o] - t[num_at(o, k, s->n_out)]);
        }
        sum += w != NULL ? w[k] * square : square;
    }
    return sum / ((double)n * s->n_out);
}

/* Rows that are not zero. */
static int basis_used(const struct perceptron *s)
{
    return (s->n_in + 2) * s->n_hidden + (s->paired ? 0 : 1);
}

int perceptron_basis_rows(const struct perceptron *s)
{
    return simd_padded(basis_used(s));
}

void perceptron_basis(const struct perceptron *s, const double *p, int n, const double *x,
                      const double *t, const double *w, double *e, double *z)
{
    const int rows = perceptron_basis_rows(s);
    double y[LIMIT_NET_OUTPUTS];
    struct neurons at;
    for (int k = 0; k < n; k++) {
        const double *in = x + num_at(0, k, s->n_in);
        const double root = w != NULL ? sqrt(w[k]) : 1.0;
        double *row = z + num_at(0, k, rows);
        double *bias = row + num_at(0, s->n_hidden, s->n_in), *hidden = bias + s->n_hidden;
        neurons_at(s, p, in, &at);
        outputs(s, p, at.value, y);
        for (int i = 0; i < s->n_hidden; i++) {
            for (int j = 0; j < s->n_in; j++) {
                row[num_at(j, i, s->n_in)] = root * at.by_input[i] * in[j];
            }
            bias[i] = root * at.by_bias[i];
            hidden[i] = root * at.value[i];
        }
        for (int i = (s->n_in + 2) * s->n_hidden; i < rows; i++) {
            row[i] = i < basis_used(s) ? root : 0.0;
        }
        for (int o = 0; o < s->n_out; o++) {
            e[num_at(k, o, n)] = root * (y[o] - t[num_at(o, k, s->n_out)]);
        }
    }
}

/* Neuron of row r of the basis, of those that belong to the weights before the hidden layer. */
static int neuron_of(const struct perceptron *s, int r)
{
    const int weights = s->n_in * s->n_hidden;
    return r < weights ? r / s->n_in : r - weights;
}

/* Place in p of what output o multiplies with row l of hidden and one. */
static int output_place(const struct perceptron *s, const struct layout *at, int o, int l)
{
    return l < s->n_hidden ? at->w2 + o * s->n_hidden + l : at->b2 + o;
}

/* Column c of the block of the hidden layer: w2 of both neurons, summed over the outputs. */
static void hidden_block(const struct perceptron *s, const double *w2, const double *zz, int c,
                         double *gram)
{
    const int rows = perceptron_basis_rows(s), count = perceptron_count(s);
    const int before = (s->n_in + 1) * s->n_hidden, k = neuron_of(s, c);
    for (int r = c; r < before; r++) {
        const int l = neuron_of(s, r);
        double both = 0.0;
        for (int o = 0; o < s->n_out; o++) {
            both += w2[num_at(k, o, s->n_hidden)] * w2[num_at(l, o, s->n_hidden)];
        }
        gram[num_at(r, c, count)] = both * zz[num_at(r, c, rows)];
    }
}

/* Rows of the basis that an output has weights for: neurons, and one. */
static int output_rows(const struct perceptron *s)
{
    return s->n_hidden + (s->paired ? 0 : 1);
}

void perceptron_normal(const struct perceptron *s, const double *p, const double *zz,
                       const double *ze, double *gram, double *slope)
{
    const struct layout at = layout_of(s);
    const int rows = perceptron_basis_rows(s), before = (s->n_in + 1) * s->n_hidden;
    const double *w2 = p + at.w2;
    memset(gram, 0, (size_t)at.count * (size_t)at.count * sizeof *gram);
    memset(slope, 0, (size_t)at.count * sizeof *slope);
    for (int c = 0; c < before; c++) {
        hidden_block(s, w2, zz, c, gram);
        for (int o = 0; o < s->n_out; o++) {
            const double w = w2[num_at(neuron_of(s, c), o, s->n_hidden)];
            slope[c] += w * ze[num_at(c, o, rows)];
            for (int l = 0; l < output_rows(s); l++) {
                gram[num_at(output_place(s, &at, o, l), c, at.count)] =
                    w * zz[num_at(before + l, c, rows)];
            }
        }
    }
    for (int o = 0; o < s->n_out; o++) {
        for (int m = 0; m < output_rows(s); m++) {
            const int c = output_place(s, &at, o, m);
            slope[c] = ze[num_at(before + m, o, rows)];
            for (int l = m; l < output_rows(s); l++) {
                gram[num_at(output_place(s, &at, o, l), c, at.count)] =
                    zz[num_at(before + l, before + m, rows)];
            }
        }
    }
}

void perceptron_gradient_add(const struct perceptron *s, const double *p, const double *x,
                             const double *t, double weight, double *g)
{
    const struct layout layout = layout_of(s);
    double y[LIMIT_NET_OUTPUTS];
    struct neurons at;
    neurons_at(s, p, x, &at);
    outputs(s, p, at.value, y);
    for (int o = 0; o < s->n_out; o++) {
        y[o] = weight * (y[o] - t[o]);
        if (!s->paired) {
            g[layout.b2 + o] += y[o];
        }
    }
    for (int k = 0; k < s->n_hidden; k++) {
        double back = 0.0;
        for (int o = 0; o < s->n_out; o++) {
            const ptrdiff_t w2 = layout.w2 + num_at(k, o, s->n_hidden);
            back += p[w2] * y[o];
            g[w2] += at.value[k] * y[o];
        }
        for (int i = 0; i < s->n_in; i++) {
            g[num_at(i, k, s->n_in)] += back * at.by_input[k] * x[i];
        }
        g[layout.b1 + k] += back * at.by_bias[k];
    }
}
