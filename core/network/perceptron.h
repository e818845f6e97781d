/* core/network/perceptron.h
 * The network while it is trained: one hidden layer, tanh, linear output, all parameters in one
 * vector p, in scaled inputs and outputs. Evaluation, normal equations and gradient.
 *
 * Order of p: w1 (n_in x n_hidden), b1 (n_hidden), w2 (n_hidden x n_out), b2 (n_out), the arrays of
 * struct network_def one after the other. Samples: x (n_in x n), t (n_out x n), weights w (n) of a
 * mean of one, NULL for all alike. Free of state; nothing allocates. */
#ifndef AEROM_CORE_NETWORK_PERCEPTRON_H
#define AEROM_CORE_NETWORK_PERCEPTRON_H

#include "core/limits.h"

#include <stdbool.h>
#include <stdint.h>

struct perceptron {
    int n_in, n_hidden, n_out; /* 1..LIMIT_NET_INPUTS, _HIDDEN, _OUTPUTS */
    /* Each neuron is a pair, tanh(w1 x + b1) + tanh(w1 x - b1), and there is no b2: an odd function
     * of x whatever the weights, as c_l and c_m of a section with two equal faces are. */
    bool paired;
};

/* Length of p. */
int perceptron_count(const struct perceptron *s);

/* Random start: uniform weights that keep the neurons in the range of unit inputs and outputs, and
 * biases that spread the neurons over it. The same seed gives the same bits. */
void perceptron_start(const struct perceptron *s, uint64_t seed, double *p);

/* Weighted mean square of y - t over samples and outputs. */
double perceptron_error(const struct perceptron *s, const double *p, int n, const double *x,
                        const double *t, const double *w);

/* Length of what the derivatives and residuals of one sample are made of: with d = 1 - tanh^2 the
 * products d x of each input and neuron, then d, the neurons, one unless they are pairs, and the
 * residuals y - t, filled up with zeros to whole lanes; of a pair the d of both, by the bias their
 * difference. The derivatives of output o by the hidden layer are the first two times w2, those by
 * its own w2 and b2 the neurons and one: all outputs share them. */
int perceptron_basis_rows(const struct perceptron *s);
/* The basis of n samples, z (basis rows x n), times the root of the weight. */
void perceptron_basis(const struct perceptron *s, const double *p, int n, const double *x,
                      const double *t, const double *w, double *z);
/* From zz = z z' (basis rows x basis rows, lower triangle), summed over samples: J'J (count x
 * count, lower triangle). */
void perceptron_normal(const struct perceptron *s, const double *p, const double *zz, double *gram);
/* Row of the basis at which the n_out residuals begin. */
int perceptron_residual_row(const struct perceptron *s);
/* J'e (count), half the gradient of the sum of squares, from the products of the residuals with the
 * rows before them, summed over samples: that of output o and row c is ze[o + c stride]. */
void perceptron_slope(const struct perceptron *s, const double *p, int stride, const double *ze,
                      double *slope);

#endif
