#include "cli/training.h"

#include "cli/report.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool is_word(const char *list, size_t length, const char *name)
{
    return strlen(name) == length && strncmp(list, name, length) == 0;
}

/* Names separated by commas; those of the paper when there are none. */
static bool set_inputs(const char *list, struct network_def *net)
{
    const char *p = list != NULL ? list : "mean_alpha,delta_alpha,alpha_rate,alpha_acceleration";
    net->n_in = 0;
    while (*p != '\0') {
        const size_t length = strcspn(p, ",");
        int k = 0;
        while (k < NET_IN_COUNT && !is_word(p, length, network_input_name((enum network_input)k))) {
            k++;
        }
        if (k < NET_IN_COUNT && network_def_uses(net, (enum network_input)k)) {
            k = NET_IN_COUNT; /* twice is a mistake as well */
        }
        if (k == NET_IN_COUNT || net->n_in == LIMIT_NET_INPUTS) {
            (void)fprintf(stderr, "aerom: --inputs: '%.*s' is no input, or stands twice\n",
                          (int)length, p);
            return false;
        }
        net->input[net->n_in++] = (enum network_input)k;
        p += length + (p[length] == ',');
    }
    if (net->n_in == 0) {
        (void)fprintf(stderr, "aerom: --inputs: a network needs one\n");
    }
    return net->n_in > 0;
}

/* Takes a number, and the character behind it that ends it, off a list. */
static bool take_number(const char **list, char end, double *value)
{
    char *behind = NULL;
    *value = strtod(*list, &behind);
    if (behind == *list || (*behind != end && *behind != '\0')) {
        return false;
    }
    *list = behind + (*behind == end);
    return true;
}

/* Time constants separated by commas. */
static bool set_lags(const char *list, struct network_frame *frame)
{
    const char *p = list != NULL ? list : "";
    while (*p != '\0') {
        double value = 0.0;
        if (!take_number(&p, ',', &value) || frame->n_lag == NETWORK_LAGS) {
            (void)fprintf(stderr, "aerom: --lags: at most %d time constants in c/V: '%s'\n",
                          NETWORK_LAGS, list);
            return false;
        }
        frame->lag[frame->n_lag++] = value;
    }
    return true;
}

/* Frequencies and damping ratios separated by colons, one pair from the next by commas. */
static bool set_oscillators(const char *list, struct network_frame *frame)
{
    const char *p = list != NULL ? list : "";
    while (*p != '\0') {
        struct network_oscillator o = {0};
        if (!take_number(&p, ':', &o.frequency) || !take_number(&p, ',', &o.damping) ||
            frame->n_oscillator == NETWORK_OSCILLATORS) {
            (void)fprintf(stderr, "aerom: --oscillators: at most %d of f c/V:damping ratio: '%s'\n",
                          NETWORK_OSCILLATORS, list);
            return false;
        }
        frame->oscillator[frame->n_oscillator++] = o;
    }
    return true;
}

static bool set_base(const char *name, struct network_frame *frame)
{
    int k = 0;
    while (name != NULL && k < NETWORK_BASES &&
           strcmp(network_base_name((enum network_base)k), name) != 0) {
        k++;
    }
    if (k == NETWORK_BASES) {
        (void)fprintf(stderr, "aerom: --base: '%s' is not one of polar, attached, dynamic_stall\n",
                      name);
        return false;
    }
    frame->base = (enum network_base)k;
    return true;
}

static bool in_range(const char *option, int value, int least, int most)
{
    if (value >= least && value <= most) {
        return true;
    }
    (void)fprintf(stderr, "aerom: %s: a whole number, %d..%d\n", option, least, most);
    return false;
}

static bool set_balance(double value, struct training *t)
{
    t->def.data.balance = options_given(value, t->def.data.balance);
    if (t->def.data.balance >= 0.0 && t->def.data.balance <= 1.0) {
        return true;
    }
    (void)fprintf(stderr, "aerom: --balance: a number, 0..1\n");
    return false;
}

static bool set_counts(const struct options *o, struct training *t)
{
    const int seed = options_whole(o->seed, 1);
    t->def.members = options_whole(o->members, t->def.members);
    t->def.folds = options_whole(o->folds, t->def.folds);
    t->def.data.samples_max = options_whole(o->samples, t->def.data.samples_max);
    t->def.data.anchors = options_whole(o->anchors, t->def.data.anchors);
    t->def.train.symmetric = o->symmetric;
    t->def.train.seed = t->def.data.seed = (uint64_t)(seed < 0 ? 0 : seed);
    return in_range("--seed", seed, 0, 1000000) &&
           in_range("--members", t->def.members, 1, ENSEMBLE_MEMBERS_MAX) &&
           (t->def.folds == 0 || in_range("--folds", t->def.folds, 2, TRAINING_FOLDS_MAX)) &&
           in_range("--samples", t->def.data.samples_max, 1, FLOW_SAMPLES_MAX) &&
           in_range("--anchors", t->def.data.anchors, 0, FLOW_SAMPLES_MAX) &&
           set_balance(o->balance, t);
}

static bool set_name(const char *name, struct network_def *net)
{
    if (name[0] == '\0' || strlen(name) >= LIMIT_NAME) {
        (void)fprintf(stderr, "aerom: --name: 1..63 bytes\n");
        return false;
    }
    memcpy(net->name, name, strlen(name) + 1);
    return true;
}

/* What only shows together: inputs without their lag or base, too many neurons. */
static bool check(struct training *t)
{
    train_def_check(&t->def.train, t->def.network.n_hidden * t->def.members, t->problems);
    network_def_check_frame(&t->def.network, "", t->problems);
    training_def_check_parts(&t->def, "", t->problems);
    if (t->problems->total > 0) {
        report_failures(stderr, "train", t->problems);
    }
    return t->problems->total == 0;
}

bool training_set(const struct options *o, struct training *t)
{
    const char *optimiser = o->optimiser != NULL ? o->optimiser : "lm";
    const enum train_optimiser kind = train_optimiser_of(optimiser);
    struct network_def *net = &t->def.network;
    if (kind == TRAIN_OPTIMISERS) {
        (void)fprintf(stderr, "aerom: --optimiser: '%s' is not one of lm, adam\n", optimiser);
        return false;
    }
    training_def_defaults(&t->def);
    train_def_defaults(kind, &t->def.train);
    net->n_hidden = options_whole(o->hidden, net->n_hidden);
    t->def.train.epochs = options_whole(o->epochs, t->def.train.epochs);
    t->def.train.decay = options_given(o->decay, t->def.train.decay);
    t->def.train.tolerance = options_given(o->tolerance, t->def.train.tolerance);
    if (!set_name(o->name != NULL ? o->name : "trained", net) || !set_counts(o, t) ||
        !set_base(o->base, &net->frame) || !set_lags(o->lags, &net->frame) ||
        !set_oscillators(o->oscillators, &net->frame) || !set_inputs(o->inputs, net)) {
        return false;
    }
    return check(t);
}
