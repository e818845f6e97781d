/* core/aero/network.h
 * Feed-forward network for the dynamic increment of the section coefficients (section 2.3 and
 * App. B of the paper): one hidden layer, tanh, linear output.
 *
 * `struct network_def` is the stored network; `struct network` the prepared, immutable evaluator
 * shared by all threads. */
#ifndef AEROM_CORE_AERO_NETWORK_H
#define AEROM_CORE_AERO_NETWORK_H

#include "core/limits.h"
#include "core/status.h"

#include <stddef.h>

/* X(code, name on the wire, meaning) */
#define NETWORK_INPUT_LIST(X)                                                                      \
    X(NET_IN_MEAN_ALPHA, "mean_alpha", "sliding mean of the angle of attack [rad]")                \
    X(NET_IN_DELTA_ALPHA, "delta_alpha", "angle of attack less its mean [rad]")                    \
    X(NET_IN_ALPHA_RATE, "alpha_rate", "alpha_dot c/V")                                            \
    X(NET_IN_ALPHA_ACCELERATION, "alpha_acceleration", "alpha_ddot (c/V)^2")                       \
    X(NET_IN_PLUNGE_RATE, "plunge_rate", "v_dot/V")

#define NETWORK_ENUM(code, name, text) code,
enum network_input { NETWORK_INPUT_LIST(NETWORK_ENUM) NET_IN_COUNT };
#undef NETWORK_ENUM

enum network_output { NET_OUT_CL, NET_OUT_CM, NET_OUT_CD, NET_OUT_COUNT }; /* "cl" "cm" "cd" */

struct network_def {
    char name[LIMIT_NAME];
    char hash[LIMIT_HASH];
    int n_in, n_hidden, n_out;
    enum network_input input[LIMIT_NET_INPUTS];
    enum network_output output[LIMIT_NET_OUTPUTS];
    /* scaled input = (x - in_offset) / in_scale; output = y * out_scale + out_offset */
    double in_offset[LIMIT_NET_INPUTS], in_scale[LIMIT_NET_INPUTS];
    double out_offset[LIMIT_NET_OUTPUTS], out_scale[LIMIT_NET_OUTPUTS];
    /* Training hull: an evaluation with an input outside [hull_min, hull_max] is counted. */
    double hull_min[LIMIT_NET_INPUTS], hull_max[LIMIT_NET_INPUTS];
    double *w1; /* hidden weights, one row per neuron, input fastest   (n_in x n_hidden) */
    double *b1; /* hidden biases                                       (n_hidden) */
    double *w2; /* output weights, one row per output, neuron fastest  (n_hidden x n_out) */
    double *b2; /* output biases                                       (n_out) */
};

const char *network_input_name(enum network_input input);

/* Appends what is wrong with the network. */
void network_def_check(const struct network_def *def, const char *pointer,
                       struct failure_list *out);
/* Frees the arrays (not the struct). Accepts a zeroed struct. */
void network_def_done(struct network_def *def);

struct network;

MUST_CHECK enum status network_create(const struct network_def *def, struct network **out);
void network_destroy(struct network *net);

/* Evaluates n stations. x holds NET_IN_COUNT rows of n values (row i = input i, in the units of the
 * list above); y receives NET_OUT_COUNT rows of n values (absent outputs are set to zero). Returns
 * how many stations were outside the training hull. Allocates nothing. */
int network_eval(const struct network *net, int n, const double *x, double *y);

#endif
