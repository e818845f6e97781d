#include "core/network/train_lstm.h"

#include "core/network/adam.h"
#include "core/network/lstm_records.h"
#include "core/num.h"
#include "core/random.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

enum { CHUNK = 128 };
/* Size of the gradient above which it is shortened: long products of gates can explode. */
static const double gradient_max = 1.0;
static const double rate_last = 0.1; /* of the first */

/* What one training needs besides the records. */
struct work {
    struct lstm shape;
    int count;
    struct adam adam;
    double *g;      /* (count) */
    int *order;     /* groups */
    lanes *g_lanes; /* (count) */
    lanes *tape;    /* (tape rows x CHUNK + 1) */
    lanes *y, *dy;  /* (n_out x CHUNK) */
};

static enum status work_init(const struct lstm *shape, const struct train_def *def, int groups,
                             struct work *w)
{
    const size_t count = (size_t)lstm_count(shape), out = (size_t)shape->n_out * CHUNK;
    const size_t tape = (size_t)lstm_tape_rows(shape) * (CHUNK + 1);
    *w = (struct work){.shape = *shape,
                       .count = (int)count,
                       .g = malloc(count * sizeof(double)),
                       .order = malloc((size_t)groups * sizeof(int)),
                       .g_lanes =
                           aligned_alloc(sizeof(lanes), (count + tape + 2 * out) * sizeof(lanes))};
    if (w->g == NULL || w->order == NULL || w->g_lanes == NULL) {
        return ST_NO_MEMORY;
    }
    for (int i = 0; i < groups; i++) {
        w->order[i] = i;
    }
    w->tape = w->g_lanes + count;
    w->y = w->tape + tape;
    w->dy = w->y + out;
    return adam_init(w->count, def->rate, def->decay, &w->adam);
}

static void work_done(struct work *w)
{
    adam_done(&w->adam);
    free(w->g);
    free(w->order);
    free(w->g_lanes);
}

static double sum_of(const lanes *v)
{
    double sum = 0.0;
    for (int l = 0; l < LANES; l++) {
        sum += (*v)[l];
    }
    return sum;
}

/* The state before the first step. */
static void forget(struct work *w)
{
    memset(w->tape, 0, (size_t)lstm_tape_rows(&w->shape) * sizeof *w->tape);
}

/* The state behind a chunk of n steps is the one before the next. */
static void carry_on(struct work *w, int n)
{
    const int rows = lstm_tape_rows(&w->shape);
    memcpy(w->tape, w->tape + num_at(0, n, rows), (size_t)rows * sizeof *w->tape);
}

/* Errors of a chunk, weighted: dy = 2 weight (y - t); the sum of the weights is returned, that of
 * the weighted squares added. */
static double residuals(struct work *w, const struct lstm_group *group, int first, int n,
                        double *squares)
{
    lanes total = {0}, square = {0};
    for (int k = 0; k < n; k++) {
        const lanes weight = group->weight[first + k];
        total += weight;
        for (int o = 0; o < w->shape.n_out; o++) {
            const ptrdiff_t at = num_at(o, k, w->shape.n_out);
            const lanes e = w->y[at] - group->t[num_at(o, first + k, w->shape.n_out)];
            square += weight * e * e;
            w->dy[at] = 2.0 * weight * e;
        }
    }
    *squares += sum_of(&square);
    return sum_of(&total);
}

static void learn(struct work *w, const lanes *x, int n, double weight, double *p)
{
    double size = 0.0;
    memset(w->g_lanes, 0, (size_t)w->count * sizeof *w->g_lanes);
    lstm_backward(&w->shape, p, n, x, w->tape, w->dy, w->g_lanes);
    for (int i = 0; i < w->count; i++) {
        w->g[i] = sum_of(&w->g_lanes[i]) / (weight * w->shape.n_out);
        size += num_sq(w->g[i]);
    }
    size = sqrt(size);
    for (int i = 0; i < w->count && size > gradient_max; i++) {
        w->g[i] *= gradient_max / size;
    }
    adam_step(&w->adam, w->g, p);
}

/* One pass over a group, with steps of the optimiser where p is to learn; returns its weighted sum
 * of squares. */
static double pass(struct work *w, const struct lstm_group *group, bool learning, double *p)
{
    double squares = 0.0;
    forget(w);
    for (int first = 0; first < group->n; first += CHUNK) {
        const int n = group->n - first < CHUNK ? group->n - first : CHUNK;
        const lanes *x = group->x + num_at(0, first, w->shape.n_in);
        lstm_forward(&w->shape, p, n, x, w->tape, w->y);
        const double weight = residuals(w, group, first, n, &squares);
        if (learning && weight > 0.0) {
            learn(w, x, n, weight, p);
        }
        carry_on(w, n);
    }
    return squares;
}

static double error_of(struct work *w, const struct lstm_set *set, double *p)
{
    double squares = 0.0;
    int sequences = 0;
    for (int i = 0; i < set->n; i++) {
        squares += pass(w, &set->group[i], false, p);
        sequences += set->group[i].sequences;
    }
    return squares / ((double)sequences * w->shape.n_out);
}

static enum status optimise(struct work *w, const struct lstm_set set[2],
                            const struct train_def *def, const struct sim_control *control,
                            double *p, double *best, struct train_curve *curve)
{
    uint64_t seed = ~def->seed; /* another sequence than that of the start */
    enum status st = ST_OK;
    bool ended = false;
    for (int epoch = 0; epoch <= def->epochs && !ended && st == ST_OK; epoch++) {
        if (epoch > 0) {
            random_shuffle(set[0].n, &seed, w->order);
            w->adam.rate = def->rate * pow(rate_last, (double)epoch / def->epochs);
        }
        for (int i = 0; i < set[0].n && epoch > 0; i++) {
            (void)pass(w, &set[0].group[w->order[i]], true, p);
        }
        const double trained = error_of(w, &set[0], p), held = error_of(w, &set[1], p);
        ended = train_curve_add(curve, def->patience, trained, held);
        if (curve->best == curve->n - 1) {
            memcpy(best, p, (size_t)w->count * sizeof *best);
        }
        st = !isfinite(trained)                                ? ST_NOT_FINITE
             : train_is_cancelled(control, epoch, def->epochs) ? ST_CANCELLED
                                                               : ST_OK;
    }
    return st;
}

static enum status run(const struct lstm_set set[2], const struct train_def *def,
                       const struct sim_control *control, struct lstm_def *out,
                       struct train_curve *curve)
{
    const struct lstm shape = lstm_shape(out);
    const size_t count = (size_t)lstm_count(&shape);
    struct train_curve c = {0};
    struct work w = {0};
    double *p = malloc(count * sizeof *p), *best = malloc(count * sizeof *best);
    enum status st = p != NULL && best != NULL ? ST_OK : ST_NO_MEMORY;
    st = st == ST_OK ? train_curve_init(def->epochs, &c) : st;
    st = st == ST_OK ? work_init(&shape, def, set[0].n, &w) : st;
    if (st == ST_OK) {
        lstm_start(&shape, def->seed, p);
        st = optimise(&w, set, def, control, p, best, &c);
    }
    work_done(&w);
    free(p);
    if (st == ST_OK) {
        out->p = best;
        *curve = c;
    } else {
        free(best);
        train_curve_done(&c);
    }
    return st;
}

void train_lstm_defaults(struct train_def *def)
{
    train_def_defaults(TRAIN_ADAM, def);
    def->epochs = 400;
    def->patience = 60;
    def->rate = 3e-3;
}

enum status train_lstm(const struct dataset_def *data_def, const struct dataset *data,
                       const struct flow_record *record, const struct train_def *def,
                       const struct sim_control *control, struct lstm_def *out,
                       struct train_curve *curve, struct failure_list *problems)
{
    assert(out->net.n_hidden <= LSTM_HIDDEN_MAX);
    const int before = problems->total;
    struct lstm_set set[2] = {{0}, {0}};
    dataset_scaling(&data->trained, &out->net, problems);
    enum status st = problems->total > before ? ST_INVALID : ST_OK;
    for (int part = 0; part < 2 && st == ST_OK; part++) {
        st = lstm_set_build(data_def, data, record, part == 1, out->step, &out->net, problems,
                            &set[part]);
    }
    st = st == ST_OK ? run(set, def, control, out, curve) : st;
    lstm_set_done(&set[0]);
    lstm_set_done(&set[1]);
    return st;
}
