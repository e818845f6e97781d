/* core/network/perceptron.h
 * The network while it is trained: one hidden layer, tanh, linear output, all parameters in one
 * vector p, in scaled inputs and outputs. Evaluation, Jacobian and gradient.
 *
 * Order of p: w1 (n_in x n_hidden), b1 (n_hidden), w2 (n_hidden x n_out), b2 (n_out), the arrays of
 * struct network_def one after the other. Samples: x (n_in x n), t (n_out x n). Free of state;
 * nothing allocates. */
#ifndef AEROM_CORE_NETWORK_PERCEPTRON_H
#define AEROM_CORE_NETWORK_PERCEPTRON_H

#include "core/limits.h"

#include <stdint.h>

struct perceptron {
    int n_in, n_hidden, n_out; /* 1..LIMIT_NET_INPUTS, _HIDDEN, _OUTPUTS */
};

/* Length of p. */
int perceptron_count(const struct perceptron *s);

/* Random start: uniform weights that keep the neurons in the range of unit inputs and outputs, and
 * biases that spread the neurons over it. The same seed gives the same bits. */
void perceptron_start(const struct perceptron *s, uint64_t seed, double *p);

/* One sample: hidden (LIMIT_NET_HIDDEN) receives tanh(w1 x + b1), y (n_out) the outputs. */
void perceptron_eval(const struct perceptron *s, const double *p, const double *x, double *hidden,
                     double *y);

/* Mean square of y - t over samples and outputs. */
double perceptron_error(const struct perceptron *s, const double *p, int n, const double *x,
                        const double *t);

/* Residuals e = y - t (n_out x n) and their derivatives by p: column o + n_out k of j
 * (count x n_out n) belongs to output o of sample k. */
void perceptron_jacobian(const struct perceptron *s, const double *p, int n, const double *x,
                         const double *t, double *e, double *j);

/* g (count) += derivative of half the sum of squares of the residuals of one sample. */
void perceptron_gradient_add(const struct perceptron *s, const double *p, const double *x,
                             const double *t, double *g);

#endif
