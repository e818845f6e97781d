#include "core/network/lstm_records.h"

#include "core/num.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

static const double step_tolerance = 0.01;

int lstm_stride(const struct flow_record *r, double step)
{
    const double samples = step / flow_record_step(r);
    const double whole = nearbyint(samples);
    return whole >= 1.0 && fabs(samples - whole) <= step_tolerance * whole ? (int)whole : 0;
}

void lstm_set_done(struct lstm_set *s)
{
    for (int i = 0; i < s->n; i++) {
        free(s->group[i].x);
    }
    free(s->group);
    *s = (struct lstm_set){0};
}

void lstm_pack_inputs(const struct flow_record *r, const struct network_def *net, const double *in,
                      int first, int stride, double sign, int n, int lane, lanes *x)
{
    for (int k = 0; k < n; k++) {
        const int wanted = first + k * stride, sample = wanted < r->n ? wanted : r->n - 1;
        for (int i = 0; i < net->n_in; i++) {
            const double v = sign * in[num_at((int)net->input[i], sample, NET_IN_COUNT)];
            x[num_at(i, k, net->n_in)][lane] = (v - net->in_offset[i]) / net->in_scale[i];
        }
    }
}

/* One record: where it stands in the order, and how long it is. */
struct item {
    int record, steps;
};

static int shorter(const void *a, const void *b)
{
    const struct item *x = a, *y = b;
    return x->steps != y->steps ? (x->steps > y->steps) - (x->steps < y->steps)
                                : x->record - y->record;
}

static void pack_targets(const struct flow_record *r, const struct network_def *net,
                         const double *y, int stride, double sign, int lane, struct lstm_group *g)
{
    const int steps = (r->n + stride - 1) / stride;
    const int start = (flow_record_first(r) + stride - 1) / stride;
    for (int k = 0; k < steps; k++) {
        for (int o = 0; o < net->n_out; o++) {
            const double mirrored = net->output[o] == NET_OUT_CD ? 1.0 : sign;
            const double v = mirrored * y[num_at((int)net->output[o], k * stride, NET_OUT_COUNT)];
            g->t[num_at(o, k, net->n_out)][lane] = (v - net->out_offset[o]) / net->out_scale[o];
        }
        g->weight[k][lane] = k < start ? 0.0 : 1.0 / (steps - start);
    }
}

static enum status group_init(int n, const struct network_def *net, struct lstm_group *g)
{
    const size_t rows = (size_t)net->n_in + (size_t)net->n_out + 1;
    lanes *block = aligned_alloc(sizeof(lanes), (size_t)n * rows * sizeof *block);
    if (block == NULL) {
        return ST_NO_MEMORY;
    }
    memset(block, 0, (size_t)n * rows * sizeof *block);
    *g = (struct lstm_group){.n = n,
                             .x = block,
                             .t = block + (ptrdiff_t)n * net->n_in,
                             .weight = block + (ptrdiff_t)n * (net->n_in + net->n_out)};
    return ST_OK;
}

/* Half as many records as lanes, each with its mirror image. */
static enum status group_build(const struct dataset_def *def, const struct polar *polar,
                               const struct flow_record *record, double step, int n,
                               const struct item *item, const struct network_def *net,
                               struct lstm_group *g)
{
    enum status st = group_init(item[n - 1].steps, net, g);
    for (int i = 0; i < n && st == ST_OK; i++) {
        const struct flow_record *r = &record[item[i].record];
        double *in = malloc((size_t)r->n * (NET_IN_COUNT + NET_OUT_COUNT) * sizeof *in);
        if (in == NULL) {
            st = ST_NO_MEMORY;
            break;
        }
        double *y = in + (ptrdiff_t)r->n * NET_IN_COUNT;
        flow_record_inputs(r, def->window, in);
        flow_record_steady(r, polar, y);
        const int first = flow_record_first(r);
        for (int k = 0; k < r->n; k++) {
            flow_record_subtract(r, first, k, y + num_at(0, k, NET_OUT_COUNT));
        }
        for (int side = 0; side < 2; side++) {
            const double sign = side == 0 ? 1.0 : -1.0;
            const int stride = lstm_stride(r, step);
            lstm_pack_inputs(r, net, in, 0, stride, sign, g->n, g->sequences, g->x);
            pack_targets(r, net, y, stride, sign, g->sequences, g);
            g->sequences++;
        }
        free(in);
    }
    return st;
}

static enum status select_records(const struct dataset *data, const struct flow_record *record,
                                  bool held, double step, struct failure_list *problems,
                                  struct item *item, int *out_n)
{
    int n = 0;
    enum status st = ST_OK;
    for (int i = 0; i < data->n_record; i++) {
        const int stride = lstm_stride(&record[i], step);
        if (stride == 0) {
            failure_set(failure_add(problems), ST_INVALID, record[i].name, "step",
                        "samples of which the step of the network is a multiple", NULL,
                        "the samples of %s do not fit the step of the network", record[i].name);
            st = ST_INVALID;
        } else if (data->is_held[i] == held) {
            item[n++] = (struct item){.record = i, .steps = (record[i].n + stride - 1) / stride};
        }
    }
    qsort(item, (size_t)n, sizeof *item, shorter);
    *out_n = n;
    return st;
}

enum status lstm_set_build(const struct dataset_def *def, const struct dataset *data,
                           const struct flow_record *record, bool held, double step,
                           const struct network_def *net, struct failure_list *problems,
                           struct lstm_set *out)
{
    enum { TOGETHER = LANES / 2 };
    struct polar *polar = NULL;
    struct item *item = malloc((size_t)data->n_record * sizeof *item);
    struct lstm_set set = {.group = calloc((size_t)data->n_record, sizeof *set.group)};
    int n = 0;
    enum status st = item != NULL && set.group != NULL ? ST_OK : ST_NO_MEMORY;
    st = st == ST_OK ? select_records(data, record, held, step, problems, item, &n) : st;
    st = st == ST_OK ? polar_create(def->polar, &polar) : st;
    for (int first = 0; first < n && st == ST_OK; first += TOGETHER) {
        const int here = n - first < TOGETHER ? n - first : TOGETHER;
        st = group_build(def, polar, record, step, here, item + first, net, &set.group[set.n++]);
    }
    polar_destroy(polar);
    free(item);
    if (st == ST_OK) {
        *out = set;
    } else {
        lstm_set_done(&set);
    }
    return st;
}
