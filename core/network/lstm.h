/* core/network/lstm.h
 * Long short-term memory (Hochreiter & Schmidhuber 1997, with the forget gate of Gers et al. 2000):
 * one layer, linear output, for comparison with the feed-forward network on records of prescribed
 * motion (App. B). No march uses it.
 *
 *     i, f, o = sigmoid(W x + U h + b),  g = tanh(W x + U h + b)
 *     c' = f c + i g,  h' = o tanh c',   y = W2 h' + b2
 *
 * Eight sequences run side by side, one a lane. All parameters stand in one vector p: w1
 * (n_in x 4 n_hidden), u (n_hidden x 4 n_hidden), b1 (4 n_hidden), rows in the order i f g o, then
 * w2 (n_hidden x n_out), b2 (n_out). Scaled inputs and outputs. Free of state; nothing allocates.
 */
#ifndef AEROM_CORE_NETWORK_LSTM_H
#define AEROM_CORE_NETWORK_LSTM_H

#include "core/limits.h"
#include "core/simd.h"

#include <stdint.h>

enum { LSTM_HIDDEN_MAX = 64 };

struct lstm {
    int n_in, n_hidden, n_out; /* 1..LIMIT_NET_INPUTS, LSTM_HIDDEN_MAX, LIMIT_NET_OUTPUTS */
};

/* Length of p. */
int lstm_count(const struct lstm *s);
/* Rows of the tape: what one step leaves for the way back. */
int lstm_tape_rows(const struct lstm *s);

/* Random start: uniform weights, no biases but 1 of the forget gates, so that a network remembers
 * before it has learnt to. The same seed gives the same bits. */
void lstm_start(const struct lstm *s, uint64_t seed, double *p);

/* n steps: x (n_in x n), tape (tape rows x n + 1) whose column 0 holds the state before; receives
 * columns 1..n and y (n_out x n). A zeroed column is the state of a network that has seen nothing.
 */
void lstm_forward(const struct lstm *s, const double *p, int n, const lanes *x, lanes *tape,
                  lanes *y);
/* Way back over the same steps: dy (n_out x n), the derivatives of an objective by y, give those by
 * p, which are added to g (count), each lane its own. The state before counts as given. */
void lstm_backward(const struct lstm *s, const double *p, int n, const lanes *x, const lanes *tape,
                   const lanes *dy, lanes *g);

#endif
