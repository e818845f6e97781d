#include "core/network/training.h"

#include "core/random.h"
#include "core/range.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void training_def_defaults(struct training_def *def)
{
    *def =
        (struct training_def){.members = 1,
                              .network = {.n_hidden = 50,
                                          .n_in = 4,
                                          .input = {NET_IN_MEAN_ALPHA, NET_IN_DELTA_ALPHA,
                                                    NET_IN_ALPHA_RATE, NET_IN_ALPHA_ACCELERATION},
                                          .n_out = 2,
                                          .output = {NET_OUT_CL, NET_OUT_CM}}};
    dataset_def_defaults(&def->data);
    train_def_defaults(TRAIN_LM, &def->train);
}

void training_def_check_parts(const struct training_def *def, const char *pointer,
                              struct failure_list *out)
{
    char where[160];
    if (def->train.symmetric && def->network.n_hidden % 2 != 0) {
        (void)snprintf(where, sizeof where, "%s/hidden", pointer);
        range_refuse(out, where, "an even number of neurons, which are pairs when symmetric",
                     def->network.n_hidden);
    }
    for (int o = 0; def->train.symmetric && o < def->network.n_out; o++) {
        if (def->network.output[o] == NET_OUT_CD) {
            (void)snprintf(where, sizeof where, "%s/symmetric", pointer);
            failure_set(failure_add(out), ST_INVALID, where, "contradiction",
                        "outputs cl and cm alone", "cd",
                        "drag is the same in the mirrored motion: a symmetric network has no cd");
        }
    }
}

/* Errors of a network on the records that are marked; which NULL: on all. */
static enum status assess(const struct training_def *def, const struct network_def *net,
                          int n_record, const struct flow_record *record, const bool *which,
                          struct assessment *out)
{
    struct polar *polar = NULL;
    struct network *network = NULL;
    enum status st = polar_create(def->data.polar, &polar);
    st = st == ST_OK ? network_create(net, &network) : st;
    for (int i = 0; i < n_record && st == ST_OK; i++) {
        if (which == NULL || which[i]) {
            st = assess_record(&record[i], def->data.window, polar, network, &out[i]);
        }
    }
    polar_destroy(polar);
    network_destroy(network);
    return st;
}

/* Trains `net`, whose n_hidden is that of one member, on the records given. */
static enum status train_on(const struct training_def *def, int n_record,
                            const struct flow_record *record, const struct sim_control *control,
                            struct network_def *net, struct ensemble_member *member,
                            struct failure_list *problems)
{
    struct dataset_def data = def->data;
    *net = def->network;
    data.frame = net->frame;
    memcpy(net->polar_hash, data.polar->hash, sizeof net->polar_hash);
    return ensemble_train(&data, &def->train, def->members, n_record, record, control, net, member,
                          problems);
}

void training_deal(uint64_t seed, int folds, int n_record, const struct flow_record *record,
                   int *fold)
{
    int moving = 0;
    for (int i = 0; i < n_record; i++) {
        fold[i] = flow_record_moves(&record[i]) ? moving++ % folds : -1;
    }
    for (int i = n_record - 1; i > 0; i--) {
        const int k = (int)(random_uniform(&seed) * (i + 1));
        if (fold[i] >= 0 && fold[k] >= 0) {
            const int keep = fold[i];
            fold[i] = fold[k];
            fold[k] = keep;
        }
    }
}

/* Memory of a cross-validation, each (n_record). */
struct folding {
    int *fold;
    struct flow_record *rest;
    bool *which;
};

/* Trains on all records but those of a fold, as the network itself is trained, and assesses these.
 */
static enum status train_fold(const struct training_def *def, const struct folding *f, int number,
                              const struct flow_record *record, const struct sim_control *control,
                              struct training_result *r, struct failure_list *problems)
{
    struct network_def net = {.n_in = 0};
    int n = 0;
    for (int i = 0; i < r->n_record; i++) {
        f->which[i] = f->fold[i] == number;
        if (!f->which[i]) {
            f->rest[n++] = record[i];
        }
    }
    enum status st = train_on(def, n, f->rest, control, &net, r->member, problems);
    if (st == ST_OK) {
        ensemble_members_done(r->n_member, r->member);
        st = assess(def, &net, r->n_record, record, f->which, r->fold);
        network_def_done(&net);
    }
    return st;
}

static enum status cross_validate(const struct training_def *def, const struct flow_record *record,
                                  struct sim_control *control, struct training_result *r,
                                  struct failure_list *problems)
{
    const size_t n = (size_t)r->n_record;
    struct folding f = {.fold = malloc(n * sizeof *f.fold),
                        .rest = malloc(n * sizeof *f.rest),
                        .which = malloc(n * sizeof *f.which)};
    r->fold = calloc(n, sizeof *r->fold);
    enum status st = f.fold != NULL && f.rest != NULL && f.which != NULL && r->fold != NULL
                         ? ST_OK
                         : ST_NO_MEMORY;
    if (st == ST_OK) {
        training_deal(def->data.seed, def->folds, r->n_record, record, f.fold);
    }
    for (; control->part < def->folds && st == ST_OK; control->part++) {
        st = train_fold(def, &f, control->part, record, control, r, problems);
    }
    free(f.fold);
    free(f.rest);
    free(f.which);
    return st;
}

static bool held_by_all(const struct training_result *r, int record)
{
    bool held = true;
    for (int k = 0; k < r->n_member; k++) {
        held = held && r->member[k].is_held[record];
    }
    return held;
}

static enum status train(const struct training_def *def, const struct flow_record *record,
                         const struct sim_control *control, struct training_result *r,
                         struct failure_list *problems)
{
    struct sim_control part = control != NULL ? *control : (struct sim_control){.cancel = NULL};
    struct network_def net;
    part.part = 0;
    part.parts = def->folds + 1;
    r->member = calloc((size_t)r->n_member, sizeof *r->member);
    r->is_held = calloc((size_t)r->n_record, sizeof *r->is_held);
    r->assessment = calloc((size_t)r->n_record, sizeof *r->assessment);
    enum status st =
        r->member != NULL && r->is_held != NULL && r->assessment != NULL ? ST_OK : ST_NO_MEMORY;
    if (st == ST_OK && def->folds > 0) {
        st = cross_validate(def, record, &part, r, problems);
    }
    st = st == ST_OK ? train_on(def, r->n_record, record, &part, &net, r->member, problems) : st;
    if (st != ST_OK) {
        return st;
    }
    r->network = net;
    for (int i = 0; i < r->n_record; i++) {
        r->is_held[i] = held_by_all(r, i);
    }
    return assess(def, &net, r->n_record, record, NULL, r->assessment);
}

enum status training_run(const struct training_def *def, int n_record,
                         const struct flow_record *record, const struct sim_control *control,
                         struct training_result *out, struct failure_list *problems)
{
    struct training_result r = {.n_member = def->members, .n_record = n_record};
    const enum status st = train(def, record, control, &r, problems);
    if (st != ST_OK) {
        training_result_done(&r);
    }
    *out = r;
    return st;
}

void training_result_done(struct training_result *r)
{
    network_def_done(&r->network);
    if (r->member != NULL) {
        ensemble_members_done(r->n_member, r->member);
    }
    free(r->member);
    free(r->is_held);
    free(r->assessment);
    free(r->fold);
    *r = (struct training_result){.n_record = 0};
}
