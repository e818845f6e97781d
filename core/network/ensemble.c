#include "core/network/ensemble.h"

#include "core/num.h"

#include <assert.h>
#include <stdlib.h>

void ensemble_members_done(int n, struct ensemble_member *member)
{
    for (int k = 0; k < n; k++) {
        train_curve_done(&member[k].curve);
        free(member[k].is_held);
        member[k] = (struct ensemble_member){0};
    }
}

static enum status room(struct network_def *net)
{
    net->w1 = malloc((size_t)(net->n_in * net->n_hidden) * sizeof *net->w1);
    net->b1 = malloc((size_t)net->n_hidden * sizeof *net->b1);
    net->w2 = malloc((size_t)(net->n_hidden * net->n_out) * sizeof *net->w2);
    net->b2 = calloc((size_t)net->n_out, sizeof *net->b2);
    return net->w1 != NULL && net->b1 != NULL && net->w2 != NULL && net->b2 != NULL ? ST_OK
                                                                                    : ST_NO_MEMORY;
}

/* The neurons of a member from neuron `first` on. With x = offset + scale s in the scaling of
 * either network, what a member sees is s_k = (o - o_k)/scale_k + scale/scale_k s. */
static void add_neurons(const struct network_def *from, int first, double weight,
                        struct network_def *to)
{
    for (int j = 0; j < from->n_hidden; j++) {
        const int at = first + j;
        to->b1[at] = from->b1[j];
        for (int i = 0; i < from->n_in; i++) {
            const double w = from->w1[num_at(i, j, from->n_in)];
            to->w1[num_at(i, at, to->n_in)] = w * to->in_scale[i] / from->in_scale[i];
            to->b1[at] += w * (to->in_offset[i] - from->in_offset[i]) / from->in_scale[i];
        }
        for (int o = 0; o < from->n_out; o++) {
            to->w2[num_at(at, o, to->n_hidden)] = weight * from->w2[num_at(j, o, from->n_hidden)] *
                                                  from->out_scale[o] / to->out_scale[o];
        }
    }
    for (int o = 0; o < from->n_out; o++) {
        to->b2[o] += weight *
                     (from->out_scale[o] * from->b2[o] + from->out_offset[o] - to->out_offset[o]) /
                     to->out_scale[o];
    }
    for (int i = 0; i < from->n_in; i++) {
        to->hull_min[i] = fmin(to->hull_min[i], from->hull_min[i]);
        to->hull_max[i] = fmax(to->hull_max[i], from->hull_max[i]);
    }
}

enum status ensemble_merge(int n, const struct network_def *member, struct network_def *out)
{
    assert(n >= 1);
    struct network_def net = member[0];
    net.n_hidden = 0;
    for (int k = 0; k < n; k++) {
        net.n_hidden += member[k].n_hidden;
    }
    if (net.n_hidden > LIMIT_NET_HIDDEN) {
        return ST_LIMIT;
    }
    const enum status st = room(&net);
    if (st != ST_OK) {
        network_def_done(&net);
        return st;
    }
    for (int k = 0, first = 0; k < n; k++) {
        add_neurons(&member[k], first, 1.0 / n, &net);
        first += member[k].n_hidden;
    }
    *out = net;
    return ST_OK;
}

static enum status train_member(const struct dataset_def *data_def, const struct train_def *def,
                                int n_record, const struct flow_record *record,
                                const struct sim_control *control, struct network_def *net,
                                struct ensemble_member *out, struct failure_list *problems)
{
    struct dataset data = {0};
    enum status st = dataset_build(data_def, n_record, record, problems, &data);
    if (st == ST_OK) {
        st = train_network(&data, def, control, net, &out->curve, problems);
    }
    if (st == ST_OK) {
        out->outside_polar = data.outside_polar;
        out->n_trained = data.trained.n;
        out->n_held = data.held.n;
        out->n_held_record = data.n_held;
        out->is_held = data.is_held;
        data.is_held = NULL;
    }
    dataset_done(&data);
    return st;
}

enum status ensemble_train(const struct dataset_def *data_def, const struct train_def *def,
                           int members, int n_record, const struct flow_record *record,
                           const struct sim_control *control, struct network_def *net,
                           struct ensemble_member *member, struct failure_list *problems)
{
    assert(members >= 1 && members <= ENSEMBLE_MEMBERS_MAX);
    struct network_def *trained = calloc((size_t)members, sizeof *trained);
    enum status st = trained != NULL ? ST_OK : ST_NO_MEMORY;
    int n = 0;
    for (int k = 0; k < members; k++) {
        member[k] = (struct ensemble_member){0};
    }
    for (; n < members && st == ST_OK; n++) {
        struct dataset_def own_data = *data_def;
        struct train_def own = *def;
        struct sim_control part = control != NULL ? *control : (struct sim_control){.part = 0};
        part.part = part.part * members + n;
        part.parts = (part.parts > 0 ? part.parts : 1) * members;
        own_data.seed += (uint64_t)n;
        own.seed += (uint64_t)n;
        trained[n] = *net;
        st = train_member(&own_data, &own, n_record, record, control != NULL ? &part : NULL,
                          &trained[n], &member[n], problems);
    }
    if (st == ST_OK) {
        st = ensemble_merge(members, trained, net);
    }
    for (int k = 0; k < n; k++) {
        network_def_done(&trained[k]);
    }
    if (st != ST_OK) {
        ensemble_members_done(members, member);
    }
    free(trained);
    return st;
}
