#include "core/network/training.h"

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

static enum status assess_all(const struct training_def *def, const struct flow_record *record,
                              struct training_result *r)
{
    struct polar *polar = NULL;
    struct network *network = NULL;
    r->assessment = calloc((size_t)r->n_record, sizeof *r->assessment);
    enum status st = r->assessment != NULL ? ST_OK : ST_NO_MEMORY;
    st = st == ST_OK ? polar_create(def->data.polar, &polar) : st;
    st = st == ST_OK ? network_create(&r->network, &network) : st;
    for (int i = 0; i < r->n_record && st == ST_OK; i++) {
        st = assess_record(&record[i], def->data.window, polar, network, &r->assessment[i]);
    }
    polar_destroy(polar);
    network_destroy(network);
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
    struct dataset_def data = def->data;
    struct network_def net = def->network;
    data.frame = net.frame;
    memcpy(net.polar_hash, data.polar->hash, sizeof net.polar_hash);
    r->member = calloc((size_t)r->n_member, sizeof *r->member);
    r->is_held = calloc((size_t)r->n_record, sizeof *r->is_held);
    if (r->member == NULL || r->is_held == NULL) {
        return ST_NO_MEMORY;
    }
    const enum status st = ensemble_train(&data, &def->train, r->n_member, r->n_record, record,
                                          control, &net, r->member, problems);
    if (st != ST_OK) {
        return st;
    }
    r->network = net;
    for (int i = 0; i < r->n_record; i++) {
        r->is_held[i] = held_by_all(r, i);
    }
    return assess_all(def, record, r);
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
    *r = (struct training_result){.n_record = 0};
}
