#include "core/network/perceptron.h"

#include "core/aero/tanh_lanes.h"
#include "core/network/dataset.h"
#include "core/num.h"

#include <string.h>

/* Where the arrays stand in p. */
struct layout {
    int b1, w2, b2, count;
};

static struct layout layout_of(const struct perceptron *s)
{
    const int b1 = s->n_in * s->n_hidden, w2 = b1 + s->n_hidden;
    const int b2 = w2 + s->n_hidden * s->n_out;
    return (struct layout){.b1 = b1, .w2 = w2, .b2 = b2, .count = b2 + s->n_out};
}

int perceptron_count(const struct perceptron *s)
{
    return layout_of(s).count;
}

static double within(uint64_t *seed, double size)
{
    return size * (2.0 * dataset_uniform(seed) - 1.0);
}

void perceptron_start(const struct perceptron *s, uint64_t seed, double *p)
{
    const struct layout at = layout_of(s);
    /* Variance 1 of the sum over inputs of variance 1, and of the outputs. */
    const double in = sqrt(3.0 / s->n_in), out = sqrt(3.0 / s->n_hidden);
    for (int i = 0; i < at.count; i++) {
        p[i] = i < at.b1   ? within(&seed, in)
               : i < at.w2 ? within(&seed, 1.0)
               : i < at.b2 ? within(&seed, out)
                           : 0.0;
    }
}

void perceptron_eval(const struct perceptron *s, const double *p, const double *x, double *hidden,
                     double *y)
{
    const struct layout at = layout_of(s);
    for (int first = 0; first < s->n_hidden; first += LANES) {
        const int used = s->n_hidden - first < LANES ? s->n_hidden - first : LANES;
        lanes v = {0};
        for (int l = 0; l < used; l++) {
            const double *w = p + num_at(0, first + l, s->n_in);
            double sum = p[at.b1 + first + l];
            for (int i = 0; i < s->n_in; i++) {
                sum += w[i] * x[i];
            }
            v[l] = sum;
        }
        tanh_lanes(&v);
        memcpy(hidden + first, &v, (size_t)used * sizeof *hidden);
    }
    for (int o = 0; o < s->n_out; o++) {
        const double *w = p + at.w2 + num_at(0, o, s->n_hidden);
        y[o] = p[at.b2 + o];
        for (int k = 0; k < s->n_hidden; k++) {
            y[o] += w[k] * hidden[k];
        }
    }
}

double perceptron_error(const struct perceptron *s, const double *p, int n, const double *x,
                        const double *t)
{
    double hidden[LIMIT_NET_HIDDEN], y[LIMIT_NET_OUTPUTS], sum = 0.0;
    for (int k = 0; k < n; k++) {
        perceptron_eval(s, p, x + num_at(0, k, s->n_in), hidden, y);
        for (int o = 0; o < s->n_out; o++) {
            sum += num_sq(y[o] - t[num_at(o, k, s->n_out)]);
        }
    }
    return sum / ((double)n * s->n_out);
}

/* Derivatives of output o, the hidden layer known, into row (count). */
static void row_of(const struct perceptron *s, const double *p, const double *x,
                   const double *hidden, int o, double *row)
{
    const struct layout at = layout_of(s);
    const double *w2 = p + at.w2 + num_at(0, o, s->n_hidden);
    for (int k = 0; k < s->n_hidden; k++) {
        const double back = w2[k] * (1.0 - num_sq(hidden[k]));
        for (int i = 0; i < s->n_in; i++) {
            row[num_at(i, k, s->n_in)] = back * x[i];
        }
        row[at.b1 + k] = back;
    }
    memset(row + at.w2, 0, (size_t)(at.count - at.w2) * sizeof *row);
    memcpy(row + at.w2 + num_at(0, o, s->n_hidden), hidden, (size_t)s->n_hidden * sizeof *row);
    row[at.b2 + o] = 1.0;
}

void perceptron_jacobian(const struct perceptron *s, const double *p, int n, const double *x,
                         const double *t, double *e, double *j)
{
    const int count = perceptron_count(s);
    double hidden[LIMIT_NET_HIDDEN], y[LIMIT_NET_OUTPUTS];
    for (int k = 0; k < n; k++) {
        const double *in = x + num_at(0, k, s->n_in);
        perceptron_eval(s, p, in, hidden, y);
        for (int o = 0; o < s->n_out; o++) {
            const ptrdiff_t column = num_at(o, k, s->n_out);
            e[column] = y[o] - t[column];
            row_of(s, p, in, hidden, o, j + column * count);
        }
    }
}

void perceptron_gradient_add(const struct perceptron *s, const double *p, const double *x,
                             const double *t, double *g)
{
    const struct layout at = layout_of(s);
    double hidden[LIMIT_NET_HIDDEN], y[LIMIT_NET_OUTPUTS];
    perceptron_eval(s, p, x, hidden, y);
    for (int o = 0; o < s->n_out; o++) {
        y[o] -= t[o];
        g[at.b2 + o] += y[o];
    }
    for (int k = 0; k < s->n_hidden; k++) {
        double back = 0.0;
        for (int o = 0; o < s->n_out; o++) {
            const ptrdiff_t w2 = at.w2 + num_at(k, o, s->n_hidden);
            back += p[w2] * y[o];
            g[w2] += hidden[k] * y[o];
        }
        back *= 1.0 - num_sq(hidden[k]);
        for (int i = 0; i < s->n_in; i++) {
            g[num_at(i, k, s->n_in)] += back * x[i];
        }
        g[at.b1 + k] += back;
    }
}
