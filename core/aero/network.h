/* core/aero/network.h
 * Feed-forward network for the dynamic increment of the section coefficients (section 2.3 and
 * App. B of the paper): one hidden layer, tanh, linear output.
 *
 * `struct network_def` is the stored network; `struct network` the prepared, immutable evaluator
 * shared by all threads. */
#ifndef AEROM_CORE_AERO_NETWORK_H
#define AEROM_CORE_AERO_NETWORK_H

#include "core/aero/dynamic.h"
#include "core/limits.h"
#include "core/status.h"

#include <stdbool.h>
#include <stddef.h>

/* X(code, name on the wire, meaning) */
#define NETWORK_INPUT_LIST(X)                                                                      \
    X(NET_IN_MEAN_ALPHA, "mean_alpha", "sliding mean of the angle of attack [rad]")                \
    X(NET_IN_DELTA_ALPHA, "delta_alpha", "angle of attack less its mean [rad]")                    \
    X(NET_IN_ALPHA_RATE, "alpha_rate", "alpha_dot c/V")                                            \
    X(NET_IN_ALPHA_ACCELERATION, "alpha_acceleration", "alpha_ddot (c/V)^2")                       \
    X(NET_IN_PLUNGE_RATE, "plunge_rate", "v_dot/V")                                                \
    X(NET_IN_ALPHA, "alpha", "angle of attack of mid-chord: of the chord in the stream [rad]")     \
    X(NET_IN_PITCH_RATE, "pitch_rate", "theta_dot c/V")                                            \
    X(NET_IN_ALPHA_LAG_1, "alpha_lag_1", "alpha behind the first lag [rad]")                       \
    X(NET_IN_ALPHA_LAG_2, "alpha_lag_2", "alpha behind the second lag [rad]")                      \
    X(NET_IN_ALPHA_LAG_3, "alpha_lag_3", "alpha behind the third lag [rad]")                       \
    X(NET_IN_ALPHA_LAG_4, "alpha_lag_4", "alpha behind the fourth lag [rad]")                      \
    X(NET_IN_PITCH_LAG_1, "pitch_rate_lag_1", "pitch_rate behind the first lag")                   \
    X(NET_IN_PITCH_LAG_2, "pitch_rate_lag_2", "pitch_rate behind the second lag")                  \
    X(NET_IN_PITCH_LAG_3, "pitch_rate_lag_3", "pitch_rate behind the third lag")                   \
    X(NET_IN_PITCH_LAG_4, "pitch_rate_lag_4", "pitch_rate behind the fourth lag")                  \
    X(NET_IN_ALPHA_OSCILLATOR_1, "alpha_oscillator_1", "alpha behind the first oscillator [rad]")  \
    X(NET_IN_ALPHA_SWING_1, "alpha_oscillator_rate_1", "its rate by the frequency, x'/w [rad]")    \
    X(NET_IN_ALPHA_OSCILLATOR_2, "alpha_oscillator_2", "alpha behind the second one [rad]")        \
    X(NET_IN_ALPHA_SWING_2, "alpha_oscillator_rate_2", "its rate by the frequency [rad]")          \
    X(NET_IN_PITCH_OSCILLATOR_1, "pitch_rate_oscillator_1", "pitch_rate behind the first one")     \
    X(NET_IN_PITCH_SWING_1, "pitch_rate_oscillator_rate_1", "its rate by the frequency")           \
    X(NET_IN_PITCH_OSCILLATOR_2, "pitch_rate_oscillator_2", "pitch_rate behind the second one")    \
    X(NET_IN_PITCH_SWING_2, "pitch_rate_oscillator_rate_2", "its rate by the frequency")           \
    X(NET_IN_STALL_BUBBLE, "stall_bubble", "state b of dynamic stall")                             \
    X(NET_IN_STALL_MOMENT, "stall_moment", "state m of dynamic stall")                             \
    X(NET_IN_STALL_LOST, "stall_lost", "state z of dynamic stall")

#define NETWORK_ENUM(code, name, text) code,
enum network_input { NETWORK_INPUT_LIST(NETWORK_ENUM) NET_IN_COUNT };
#undef NETWORK_ENUM

enum { NETWORK_LAGS = 4, NETWORK_OSCILLATORS = 2 }; /* a network has at most */

/* What the increment is counted from: the steady polar, attached flow with its wake and apparent
 * mass, or these and the lags of stall. The last two carry what follows the accelerations as a mass
 * of the beam; a network of the first kind that has to learn it feeds the accelerations back as
 * loads, with a gain that grows as 1/(time step). */
#define NETWORK_BASE_LIST(X)                                                                       \
    X(NETWORK_ON_POLAR, "polar")                                                                   \
    X(NETWORK_ON_ATTACHED, "attached")                                                             \
    X(NETWORK_ON_STALL, "dynamic_stall")
#define NETWORK_BASE_ENUM(code, name) code,
enum network_base { NETWORK_BASE_LIST(NETWORK_BASE_ENUM) NETWORK_BASES };
#undef NETWORK_BASE_ENUM

struct network_oscillator {
    double frequency; /* f c/V, > 0 */
    double damping;   /* damping ratio, in (0, 1) */
};

/* What a network stands on and how long it remembers. */
struct network_frame {
    enum network_base base;
    int n_lag;                /* 0..NETWORK_LAGS */
    double lag[NETWORK_LAGS]; /* time constants of the lags [c/V], > 0 (n_lag) */
    int n_oscillator;         /* 0..NETWORK_OSCILLATORS */
    struct network_oscillator oscillator[NETWORK_OSCILLATORS]; /* (n_oscillator) */
};

enum network_output { NET_OUT_CL, NET_OUT_CM, NET_OUT_CD, NET_OUT_COUNT }; /* "cl" "cm" "cd" */

struct network_def {
    char name[LIMIT_NAME];
    char hash[LIMIT_HASH];
    /* Content hash of the polar the increments are counted from; "": not known. */
    char polar_hash[LIMIT_HASH];
    struct network_frame frame;
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
const char *network_base_name(enum network_base base);
bool network_def_uses(const struct network_def *def, enum network_input input);
/* Frame of a dynamic part: that of its network, or its own model, without lags, where it is none
 * (`net` is not looked at then). */
struct network_frame network_frame_under(enum dynamic_type dynamic, const struct network_def *net);
/* Was it trained on another polar than the one with this hash? False where one is not known. */
bool network_def_is_of_other_polar(const struct network_def *def, const char *polar_hash);

/* Appends what is wrong with the network. */
void network_def_check(const struct network_def *def, const char *pointer,
                       struct failure_list *out);
/* Only what inputs, base and lags say together: what can be asked before there are weights. */
void network_def_check_frame(const struct network_def *def, const char *pointer,
                             struct failure_list *out);
/* Frees the arrays (not the struct). Accepts a zeroed struct. */
void network_def_done(struct network_def *def);

struct network;

MUST_CHECK enum status network_create(const struct network_def *def, struct network **out);
void network_destroy(struct network *net);
const struct network_frame *network_frame_of(const struct network *net);

/* Evaluates n stations. x holds NET_IN_COUNT rows of n values (row i = input i, in the units of the
 * list above); y receives NET_OUT_COUNT rows of n values (absent outputs are set to zero). Returns
 * how many stations were outside the training hull. Allocates nothing. */
int network_eval(const struct network *net, int n, const double *x, double *y);

#endif
