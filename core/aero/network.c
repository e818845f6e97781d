#include "core/aero/network.h"

#include "core/num.h"
#include "core/simd.h"

#include <assert.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Time constants of lags [c/V]. */
static const double lag_least = 0.01, lag_most = 1000.0;
/* Frequencies f c/V and damping ratios of oscillators. */
static const double frequency_least = 0.001, frequency_most = 100.0;
static const double damping_least = 0.01, damping_most = 0.99;

/* Neurons evaluated side by side; the last group is filled up with neurons without weights. */
enum { NETWORK_GROUP = 4 };

/* What network_eval promises, but for the outputs that the network does not have. */
typedef int (*network_kernel_fn)(const struct network *net, int n, const double *x, double *y);

struct network {
    struct network_frame frame;
    int n_in, n_out, n_group;
    enum network_input input[LIMIT_NET_INPUTS];
    enum network_output output[LIMIT_NET_OUTPUTS];
    double in_offset[LIMIT_NET_INPUTS], in_factor[LIMIT_NET_INPUTS]; /* factor = 1/scale */
    double out_offset[LIMIT_NET_OUTPUTS], out_scale[LIMIT_NET_OUTPUTS];
    double hull_min[LIMIT_NET_INPUTS], hull_max[LIMIT_NET_INPUTS];
    network_kernel_fn kernel;
    /* Per group: biases, n_in rows of weights, n_out rows of output weights; read once from front
     * to back. What enters the tanh carries its TANH_SCALE. */
    double *neuron; /* (NETWORK_GROUP x (n_in + 1 + n_out) x n_group) */
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

static const char *const base_name[NETWORK_BASES] = {
#define ROW(code, name) [code] = name,
    NETWORK_BASE_LIST(ROW)
#undef ROW
};

const char *network_base_name(enum network_base base)
{
    assert((unsigned)base < NETWORK_BASES);
    return base_name[base];
}

bool network_def_uses(const struct network_def *def, enum network_input input)
{
    for (int i = 0; i < def->n_in; i++) {
        if (def->input[i] == input) {
            return true;
        }
    }
    return false;
}

struct network_frame network_frame_under(enum dynamic_type dynamic, const struct network_def *net)
{
    static const enum network_base base[] = {[DYNAMIC_NONE] = NETWORK_ON_POLAR,
                                             [DYNAMIC_ATTACHED] = NETWORK_ON_ATTACHED,
                                             [DYNAMIC_STALL] = NETWORK_ON_STALL};
    return dynamic == DYNAMIC_NETWORK ? net->frame : (struct network_frame){.base = base[dynamic]};
}

bool network_def_is_of_other_polar(const struct network_def *def, const char *polar_hash)
{
    return def->polar_hash[0] != '\0' && polar_hash[0] != '\0' &&
           strcmp(def->polar_hash, polar_hash) != 0;
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

/* Appends what is wrong with a number of the frame, at pointer/where. */
static void check_frame_number(double value, double least, double most, const char *pointer,
                               const char *where, int k, const char *member, const char *expected,
                               struct failure_list *out)
{
    char at[160], got[32];
    (void)snprintf(at, sizeof at, "%s/%s/%d%s", pointer, where, k, member);
    (void)snprintf(got, sizeof got, "%g", value);
    if (!(value >= least && value <= most)) {
        failure_set(failure_add(out), ST_INVALID, at, "out_of_range", expected, got,
                    "entry %d of %s is not admissible", k, where);
    }
}

/* Inputs that need a lag or an oscillator; `width` of them belong to one. */
static const struct needs {
    int first, count, width;
    const char *field;
} needs[] = {
    {NET_IN_ALPHA_LAG_1, NETWORK_LAGS, 1, "lags_c_v"},
    {NET_IN_PITCH_LAG_1, NETWORK_LAGS, 1, "lags_c_v"},
    {NET_IN_ALPHA_OSCILLATOR_1, 2 * NETWORK_OSCILLATORS, 2, "oscillators"},
    {NET_IN_PITCH_OSCILLATOR_1, 2 * NETWORK_OSCILLATORS, 2, "oscillators"},
};

static void check_frame_input(const struct network_def *def, int i, const char *pointer,
                              struct failure_list *out)
{
    char where[160], expected[64];
    const int in = (int)def->input[i];
    const char *name = input_name[in];
    (void)snprintf(where, sizeof where, "%s/inputs/%d", pointer, i);
    for (size_t k = 0; k < sizeof needs / sizeof needs[0]; k++) {
        const struct needs *need = &needs[k];
        const int there = need->width == 1 ? def->frame.n_lag : 2 * def->frame.n_oscillator;
        const int at = in - need->first;
        if (at >= there && at < need->count) {
            (void)snprintf(expected, sizeof expected, "an input behind one of %s", need->field);
            failure_set(failure_add(out), ST_INVALID, where, "contradiction", expected, name,
                        "%s needs more entries than the %d of %s", name, there / need->width,
                        need->field);
        }
    }
    if (in >= (int)NET_IN_STALL_BUBBLE && def->frame.base != NETWORK_ON_STALL) {
        failure_set(failure_add(out), ST_INVALID, where, "contradiction",
                    "an input that the base has", name, "%s is a state of dynamic_stall", name);
    }
}

void network_def_check_frame(const struct network_def *def, const char *pointer,
                             struct failure_list *out)
{
    const struct network_frame *f = &def->frame;
    for (int k = 0; k < f->n_lag; k++) {
        check_frame_number(f->lag[k], lag_least, lag_most, pointer, "lags_c_v", k, "",
                           "c/V, 0.01..1000", out);
    }
    for (int k = 0; k < f->n_oscillator; k++) {
        check_frame_number(f->oscillator[k].frequency, frequency_least, frequency_most, pointer,
                           "oscillators", k, "/f_c_v", "f c/V, 0.001..100", out);
        check_frame_number(f->oscillator[k].damping, damping_least, damping_most, pointer,
                           "oscillators", k, "/damping", "a damping ratio, 0.01..0.99", out);
    }
    for (int i = 0; i < def->n_in; i++) {
        check_frame_input(def, i, pointer, out);
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
    network_def_check_frame(def, pointer, out);
    for (int i = 0; i < def->n_in; i++) {
        if (!(def->hull_min[i] <= def->hull_max[i])) {
            char where[160];
            (void)snprintf(where, sizeof where, "%s/hull_max/%d", pointer, i);
            failure_set(failure_add(out), ST_INVALID, where, "out_of_range", ">= hull_min", NULL,
                        "the training hull of input %d is empty", i);
        }
    }
}

#define KERNEL_STEM kernel
#define KERNEL_FILE "core/aero/network_kernel.inc"
#include "core/simd_levels.inc"

static const network_kernel_fn kernel_of_level[SIMD_LEVELS] = {kernel_portable, kernel_avx2,
                                                               kernel_avx512};

/* The weights in the order of the kernels. */
static void pack_neurons(const struct network_def *def, struct network *net)
{
    double *w = net->neuron;
    for (int group = 0; group < net->n_group; group++) {
        const int first = group * NETWORK_GROUP;
        for (int row = 0; row <= def->n_in + def->n_out; row++) {
            for (int j = first; j < first + NETWORK_GROUP; j++) {
                const int i = row - 1, o = i - def->n_in;
                *w++ = j >= def->n_hidden ? 0.0
                       : o >= 0           ? def->w2[j + def->n_hidden * o]
                       : i >= 0           ? TANH_SCALE * def->w1[i + def->n_in * j]
                                          : TANH_SCALE * def->b1[j];
            }
        }
    }
}

enum status network_create(const struct network_def *def, struct network **out)
{
    assert(def->n_in >= 1);
    assert(def->n_in <= LIMIT_NET_INPUTS);
    assert(def->n_out >= 1);
    assert(def->n_out <= LIMIT_NET_OUTPUTS);
    const int per_neuron = def->n_in + 1 + def->n_out;
    const int n_group = (def->n_hidden + NETWORK_GROUP - 1) / NETWORK_GROUP;
    struct network *net = calloc(1, sizeof *net);
    if (net == NULL) {
        return ST_NO_MEMORY;
    }
    net->neuron = malloc((size_t)(per_neuron * NETWORK_GROUP * n_group) * sizeof *net->neuron);
    if (net->neuron == NULL) {
        free(net);
        return ST_NO_MEMORY;
    }
    net->frame = def->frame;
    net->n_in = def->n_in;
    net->n_out = def->n_out;
    net->n_group = n_group;
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
    pack_neurons(def, net);
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

const struct network_frame *network_frame_of(const struct network *net)
{
    return &net->frame;
}

int network_eval(const struct network *net, int n, const double *x, double *y)
{
    memset(y, 0, (size_t)(NET_OUT_COUNT * n) * sizeof *y);
    return net->kernel(net, n, x, y);
}
