#include "core/network/train.h"

#include "core/network/train_adam.h"
#include "core/network/train_lm.h"
#include "core/num.h"
#include "core/range.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

/* A smaller error counts as better from so much on, relative. */
static const double better = 1e-6;

static const char *const optimiser_name[TRAIN_OPTIMISERS] = {
    [TRAIN_LM] = "lm", [TRAIN_ADAM] = "adam"};

const char *train_optimiser_name(enum train_optimiser o)
{
    assert((unsigned)o < TRAIN_OPTIMISERS);
    return optimiser_name[o];
}

enum train_optimiser train_optimiser_of(const char *name)
{
    int o = 0;
    while (o < TRAIN_OPTIMISERS && strcmp(optimiser_name[o], name) != 0) {
        o++;
    }
    return (enum train_optimiser)o;
}

void train_def_defaults(enum train_optimiser optimiser, struct train_def *def)
{
    *def = (struct train_def){.optimiser = optimiser,
                              .epochs = optimiser == TRAIN_LM ? 300 : 2000,
                              .patience = optimiser == TRAIN_LM ? 30 : 200,
                              .decay = 1e-4,
                              .rate = 1e-3,
                              .batch = 64,
                              .seed = 1};
}

void train_def_check(const struct train_def *def, int n_hidden, struct failure_list *out)
{
    if (n_hidden < 1 || n_hidden > LIMIT_NET_HIDDEN) {
        range_refuse(out, "--hidden", "1..512", n_hidden);
    }
    if (def->epochs < 1 || def->epochs > TRAIN_EPOCHS_MAX) {
        range_refuse(out, "--epochs", "1..100000", def->epochs);
    }
    if (!(def->decay >= 0.0 && def->decay <= 1.0)) {
        range_refuse(out, "--decay", "0..1", def->decay);
    }
    if (!(def->tolerance >= 0.0 && def->tolerance <= 1.0)) {
        range_refuse(out, "--tolerance", "0..1", def->tolerance);
    }
}

enum status train_curve_init(int epochs, struct train_curve *c)
{
    *c = (struct train_curve){.trained = calloc((size_t)epochs + 1, sizeof(double)),
                              .held = calloc((size_t)epochs + 1, sizeof(double))};
    if (c->trained == NULL || c->held == NULL) {
        train_curve_done(c);
        return ST_NO_MEMORY;
    }
    return ST_OK;
}

void train_curve_done(struct train_curve *c)
{
    free(c->trained);
    free(c->held);
    *c = (struct train_curve){0};
}

bool train_curve_add(struct train_curve *c, int patience, double trained, double held)
{
    const int i = c->n++;
    c->trained[i] = trained;
    c->held[i] = held;
    if (i == 0 || held < (1.0 - better) * c->held[c->best]) {
        c->best = i;
    }
    return i - c->best >= patience;
}

bool train_is_cancelled(const struct sim_control *control, int epoch, int epochs)
{
    sim_control_tell(control, (double)epoch / epochs);
    return sim_control_cancelled(control);
}

bool train_note(const struct train_problem *problem, const struct train_def *def, double trained,
                const double *p, double *best, struct train_curve *curve)
{
    const double held = train_objective_at(&problem->shape, p, &problem->held, problem->tolerance);
    const bool ended = train_curve_add(curve, def->patience, trained, held);
    if (curve->best == curve->n - 1) {
        memcpy(best, p, (size_t)perceptron_count(&problem->shape) * sizeof *best);
    }
    return ended;
}

/* Every `stride`-th sample, the rows of the net's inputs and outputs, scaled, into the blocks at
 * *next and *end, which move on. */
static struct train_part scale(const struct sample_set *s, const struct network_def *net,
                               int stride, double **next, int **end)
{
    const int n = s->n / stride;
    double *x = *next, *t = x + (ptrdiff_t)n * net->n_in, *w = t + (ptrdiff_t)n * net->n_out;
    for (int k = 0; k < n; k++) {
        for (int i = 0; i < net->n_in; i++) {
            const double v = s->x[num_at((int)net->input[i], k * stride, NET_IN_COUNT)];
            x[num_at(i, k, net->n_in)] = (v - net->in_offset[i]) / net->in_scale[i];
        }
        for (int o = 0; o < net->n_out; o++) {
            const double v = s->y[num_at((int)net->output[o], k * stride, NET_OUT_COUNT)];
            t[num_at(o, k, net->n_out)] = (v - net->out_offset[o]) / net->out_scale[o];
        }
        w[k] = s->weight[k * stride];
    }
    for (int g = 0; g < s->n_group; g++) {
        (*end)[g] = s->end[g] / stride;
    }
    const struct train_part part = {
        .n = n, .x = x, .t = t, .w = w, .n_group = s->n_group, .end = *end};
    *next = w + n;
    *end += s->n_group;
    return part;
}

/* From a share of the range to the mean square of scaled outputs. */
static double scaled_tolerance(const struct dataset *data, const struct network_def *net,
                               double share)
{
    double sum = 0.0;
    for (int o = 0; o < net->n_out; o++) {
        sum += num_sq(share * data->unit[net->output[o]] / net->out_scale[o]);
    }
    return sum / net->n_out;
}

enum status train_problem_init(const struct dataset *data, const struct network_def *net,
                               const struct train_def *def, struct train_problem *p)
{
    const size_t rows = (size_t)(net->n_in + net->n_out + 1);
    double *block = malloc((size_t)(data->trained.n + data->held.n) * rows * sizeof *block);
    int *ends = malloc((size_t)(data->trained.n_group + data->held.n_group) * sizeof *ends);
    if (block == NULL || ends == NULL) {
        free(block);
        free(ends);
        return ST_NO_MEMORY;
    }
    double *next = block;
    int *end = ends;
    const int stride = def->symmetric ? 2 : 1; /* what is odd anyway needs no mirror images */
    *p = (struct train_problem){.shape = {.n_in = net->n_in,
                                          .n_hidden = net->n_hidden / stride,
                                          .n_out = net->n_out,
                                          .paired = def->symmetric},
                                .trained = scale(&data->trained, net, stride, &next, &end),
                                .held = scale(&data->held, net, stride, &next, &end),
                                .tolerance = scaled_tolerance(data, net, def->tolerance),
                                .block = block,
                                .end = ends};
    return ST_OK;
}

void train_problem_done(struct train_problem *p)
{
    free(p->block);
    free(p->end);
    *p = (struct train_problem){.tolerance = 0.0};
}

/* The neurons of p, a pair as two neurons, into the arrays of the network. */
static void write_neurons(const struct perceptron *shape, const double *p, struct network_def *net)
{
    const int n_in = shape->n_in, n = shape->n_hidden, sides = shape->paired ? 2 : 1;
    const double *b1 = p + num_at(0, n, n_in), *w2 = b1 + n;
    for (int k = 0; k < n * sides; k++) {
        const int j = k / sides;
        memcpy(net->w1 + num_at(0, k, n_in), p + num_at(0, j, n_in),
               (size_t)n_in * sizeof *net->w1);
        net->b1[k] = k % sides == 0 ? b1[j] : -b1[j];
        for (int o = 0; o < shape->n_out; o++) {
            net->w2[num_at(k, o, n * sides)] = w2[num_at(j, o, n)];
        }
    }
    for (int o = 0; o < shape->n_out; o++) {
        net->b2[o] = shape->paired ? 0.0 : w2[num_at(o, shape->n_out, n)];
    }
}

static enum status take_weights(const struct perceptron *shape, const double *p,
                                struct network_def *net)
{
    net->n_hidden = shape->n_hidden * (shape->paired ? 2 : 1);
    const int size[4] = {net->n_in * net->n_hidden, net->n_hidden, net->n_hidden * net->n_out,
                         net->n_out};
    double **const array[4] = {&net->w1, &net->b1, &net->w2, &net->b2};
    for (int k = 0; k < 4; k++) {
        *array[k] = malloc((size_t)size[k] * sizeof *p);
        if (*array[k] == NULL) {
            network_def_done(net);
            return ST_NO_MEMORY;
        }
    }
    write_neurons(shape, p, net);
    return ST_OK;
}

static enum status optimise(const struct train_problem *problem, const struct train_def *def,
                            const struct sim_control *control, struct network_def *net,
                            struct train_curve *curve)
{
    const size_t count = (size_t)perceptron_count(&problem->shape);
    struct train_curve c = {0};
    double *p = malloc(2 * count * sizeof *p);
    enum status st = p != NULL ? train_curve_init(def->epochs, &c) : ST_NO_MEMORY;
    if (st == ST_OK) {
        double *best = p + count;
        perceptron_start(&problem->shape, def->seed, p);
        st = def->optimiser == TRAIN_LM ? train_lm(problem, def, control, p, best, &c)
                                        : train_adam(problem, def, control, p, best, &c);
        if (st == ST_OK) {
            st = num_all_finite((int)count, best) ? take_weights(&problem->shape, best, net)
                                                  : ST_NOT_FINITE;
        }
    }
    if (st == ST_OK) {
        *curve = c;
    } else {
        train_curve_done(&c);
    }
    free(p);
    return st;
}

enum status train_network(const struct dataset *data, const struct train_def *def,
                          const struct sim_control *control, struct network_def *net,
                          struct train_curve *curve, struct failure_list *problems)
{
    const int before = problems->total;
    dataset_scaling(&data->trained, net, problems);
    if (problems->total > before) {
        return ST_INVALID;
    }
    struct train_problem problem;
    enum status st = train_problem_init(data, net, def, &problem);
    if (st == ST_OK) {
        st = optimise(&problem, def, control, net, curve);
        train_problem_done(&problem);
    }
    return st;
}
