#include "core/aero/network.h"

#include "core/aero/tanh_lanes.h"
#include "core/num.h"

#include <assert.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* One block of LANES stations. x: scaled inputs, (n_in x LANES), lane fastest; y: (n_out x LANES).
 */
typedef void (*network_kernel_fn)(const struct network *net, const lanes *x, lanes *y);

struct network {
    int n_in, n_hidden, n_out;
    enum network_input input[LIMIT_NET_INPUTS];
    enum network_output output[LIMIT_NET_OUTPUTS];
    double in_offset[LIMIT_NET_INPUTS], in_factor[LIMIT_NET_INPUTS]; /* factor = 1/scale */
    double out_offset[LIMIT_NET_OUTPUTS], out_scale[LIMIT_NET_OUTPUTS];
    double hull_min[LIMIT_NET_INPUTS], hull_max[LIMIT_NET_INPUTS];
    network_kernel_fn kernel;
    /* Per neuron: n_in weights, bias, n_out weights; read once from front to back. */
    double *neuron; /* ((n_in + 1 + n_out) x n_hidden) */
    double b2[LIMIT_NET_OUTPUTS];
};

static const char *const input_name[NET_IN_COUNT] = {
#define ROW(code, name, text) [code] = name,
    NETWORK_INPUT_LIST(ROW)
#undef ROW
};

const char *network_input_name(enum network_input input)
{
    assert((unsigned)input < NET_IN_COUNT);
    return input_name[input];
}

void network_def_done(struct network_def *def)
{
    free(def->w1);
    free(def->b1);
    free(def->w2);
    free(def->b2);
    def->w1 = def->b1 = def->w2 = def->b2 = NULL;
}

static void check_numbers(int n, const double *x, bool positive, const char *pointer,
                          const char *field, struct failure_list *out)
{
    for (int i = 0; i < n; i++) {
        if (!isfinite(x[i]) || (positive && !(x[i] > 0.0))) {
            char where[160];
            (void)snprintf(where, sizeof where, "%s/%s/%d", pointer, field, i);
            failure_set(failure_add(out), ST_INVALID, where, "out_of_range",
                        positive ? "a finite number > 0" : "a finite number", NULL,
                        "entry %d of %s is not admissible", i, field);
            return;
        }
    }
}

void network_def_check(const struct network_def *def, const char *pointer, struct failure_list *out)
{
    check_numbers(def->n_in, def->in_offset, false, pointer, "input_offset", out);
    check_numbers(def->n_in, def->in_scale, true, pointer, "input_scale", out);
    check_numbers(def->n_out, def->out_offset, false, pointer, "output_offset", out);
    check_numbers(def->n_out, def->out_scale, true, pointer, "output_scale", out);
    check_numbers(def->n_in * def->n_hidden, def->w1, false, pointer, "w1", out);
    check_numbers(def->n_hidden, def->b1, false, pointer, "b1", out);
    check_numbers(def->n_hidden * def->n_out, def->w2, false, pointer, "w2", out);
    check_numbers(def->n_out, def->b2, false, pointer, "b2", out);
    for (int i = 0; i < def->n_in; i++) {
        if (!(def->hull_min[i] <= def->hull_max[i])) {
            char where[160];
            (void)snprintf(where, sizeof where, "%s/hull_max/%d", pointer, i);
            failure_set(failure_add(out), ST_INVALID, where, "out_of_range", ">= hull_min", NULL,
                        "the training hull of input %d is empty", i);
        }
    }
}

/* One pass over the neurons: hidden = tanh(w1 x + b1), y += w2 hidden. */
static inline __attribute__((always_inline)) void evaluate_block(const struct network *net,
                                                                 const lanes *x, lanes *y)
{
    const int n_in = net->n_in, n_out = net->n_out;
    const double *weight = net->neuron;
    const lanes zero = {0};
    for (int o = 0; o < n_out; o++) {
        y[o] = zero + net->b2[o];
    }
    for (int j = 0; j < net->n_hidden; j++) {
        lanes v = zero + weight[n_in];
        for (int i = 0; i < n_in; i++) {
            v += weight[i] * x[i];
        }
        tanh_lanes(&v);
        for (int o = 0; o < n_out; o++) {
            y[o] += weight[n_in + 1 + o] * v;
        }
        weight += n_in + 1 + n_out;
    }
}

static void kernel_portable(const struct network *net, const lanes *x, lanes *y)
{
    evaluate_block(net, x, y);
}

SIMD_TARGET_AVX2 static void kernel_avx2(const struct network *net, const lanes *x, lanes *y)
{
    evaluate_block(net, x, y);
}

SIMD_TARGET_AVX512 static void kernel_avx512(const struct network *net, const lanes *x, lanes *y)
{
    evaluate_block(net, x, y);
}

static const network_kernel_fn kernel_of_level[SIMD_LEVELS] = {kernel_portable, kernel_avx2,
                                                               kernel_avx512};

enum status network_create(const struct network_def *def, struct network **out)
{
    assert(def->n_in >= 1);
    assert(def->n_in <= LIMIT_NET_INPUTS);
    assert(def->n_out >= 1);
    assert(def->n_out <= LIMIT_NET_OUTPUTS);
    const int per_neuron = def->n_in + 1 + def->n_out;
    struct network *net = calloc(1, sizeof *net);
    if (net == NULL) {
        return ST_NO_MEMORY;
    }
    net->neuron = malloc((size_t)per_neuron * (size_t)def->n_hidden * sizeof *net->neuron);
    if (net->neuron == NULL) {
        free(net);
        return ST_NO_MEMORY;
    }
    net->n_in = def->n_in;
    net->n_hidden = def->n_hidden;
    net->n_out = def->n_out;
    net->kernel = kernel_of_level[simd_level_of_machine()];
    for (int i = 0; i < def->n_in; i++) {
        net->input[i] = def->input[i];
        net->in_offset[i] = def->in_offset[i];
        net->in_factor[i] = 1.0 / def->in_scale[i];
        net->hull_min[i] = def->hull_min[i];
        net->hull_max[i] = def->hull_max[i];
    }
    for (int o = 0; o < def->n_out; o++) {
        net->output[o] = def->output[o];
        net->out_offset[o] = def->out_offset[o];
        net->out_scale[o] = def->out_scale[o];
        net->b2[o] = def->b2[o];
    }
    double *w = net->neuron;
    for (int j = 0; j < def->n_hidden; j++) {
        for (int i = 0; i < def->n_in; i++) {
            *w++ = def->w1[i + def->n_in * j];
        }
        *w++ = def->b1[j];
        for (int o = 0; o < def->n_out; o++) {
            *w++ = def->w2[j + def->n_hidden * o];
        }
    }
    *out = net;
    return ST_OK;
}

void network_destroy(struct network *net)
{
    if (net != NULL) {
        free(net->neuron);
        free(net);
    }
}

int network_eval(const struct network *net, int n, const double *x, double *y)
{
    lanes in[LIMIT_NET_INPUTS], result[LIMIT_NET_OUTPUTS];
    int outside = 0;
    for (int o = 0; o < NET_OUT_COUNT; o++) {
        memset(y + (size_t)o * (size_t)n, 0, (size_t)n * sizeof *y);
    }
    for (int first = 0; first < n; first += LANES) {
        const int used = n - first < LANES ? n - first : LANES;
        bool out_of_hull[LANES] = {false};
        for (int i = 0; i < net->n_in; i++) {
            const double *row = x + (size_t)net->input[i] * (size_t)n + first;
            for (int l = 0; l < LANES; l++) {
                const double value = row[l < used ? l : 0]; /* idle lanes repeat the first */
                in[i][l] = (value - net->in_offset[i]) * net->in_factor[i];
                out_of_hull[l] |= !(value >= net->hull_min[i] && value <= net->hull_max[i]);
            }
        }
        net->kernel(net, in, result);
        for (int o = 0; o < net->n_out; o++) {
            double *row = y + (size_t)net->output[o] * (size_t)n + first;
            for (int l = 0; l < used; l++) {
                row[l] = result[o][l] * net->out_scale[o] + net->out_offset[o];
            }
        }
        for (int l = 0; l < used; l++) {
            outside += out_of_hull[l];
        }
    }
    return outside;
}
