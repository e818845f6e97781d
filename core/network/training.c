#include "core/network/training.h"

#include <stdlib.h>
#include <string.h>

void training_def_defaults(struct training_def *def)
{
    *def =
        (struct training_def){.network = {.n_hidden = 50,
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

static enum status train(const struct training_def *def, const struct dataset *data,
                         const struct flow_record *record, const struct sim_control *control,
                         struct training_result *r, struct failure_list *problems)
{
    r->network = def->network;
    r->network.frame = def->data.frame;
    memcpy(r->network.polar_hash, def->data.polar->hash, sizeof r->network.polar_hash);
    r->is_held = calloc((size_t)r->n_record, sizeof *r->is_held);
    if (r->is_held == NULL) {
        return ST_NO_MEMORY;
    }
    memcpy(r->is_held, data->is_held, (size_t)r->n_record * sizeof *r->is_held);
    r->n_held = data->n_held;
    r->samples_trained = data->trained.n;
    r->samples_held = data->held.n;
    r->outside_polar = data->outside_polar;
    const enum status st =
        train_network(data, &def->train, control, &r->network, &r->curve, problems);
    return st == ST_OK ? assess_all(def, record, r) : st;
}

enum status training_run(const struct training_def *def, int n_record,
                         const struct flow_record *record, const struct sim_control *control,
                         struct training_result *out, struct failure_list *problems)
{
    struct training_result r = {.n_record = n_record};
    struct dataset data;
    enum status st = dataset_build(&def->data, n_record, record, problems, &data);
    if (st == ST_OK) {
        st = train(def, &data, record, control, &r, problems);
        dataset_done(&data);
    }
    if (st != ST_OK) {
        training_result_done(&r);
    }
    *out = r;
    return st;
}

void training_result_done(struct training_result *r)
{
    network_def_done(&r->network);
    train_curve_done(&r->curve);
    free(r->is_held);
    free(r->assessment);
    *r = (struct training_result){.n_record = 0};
}
