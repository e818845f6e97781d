#include "core/network/train_adam.h"

#include "core/network/adam.h"
#include "core/num.h"
#include "core/random.h"

#include <stdlib.h>
#include <string.h>

/* Gradient of the mean square error of n samples into g. */
static void gradient(const struct train_problem *t, int n, const int *sample, const double *p,
                     double *g)
{
    const int count = perceptron_count(&t->shape);
    const double factor = 2.0 / ((double)n * t->shape.n_out);
    memset(g, 0, (size_t)count * sizeof *g);
    for (int i = 0; i < n; i++) {
        perceptron_gradient_add(&t->shape, p, t->trained_x + num_at(0, sample[i], t->shape.n_in),
                                t->trained_t + num_at(0, sample[i], t->shape.n_out),
                                t->trained_w != NULL ? t->trained_w[sample[i]] : 1.0, g);
    }
    for (int i = 0; i < count; i++) {
        g[i] *= factor;
    }
}

static enum status run(const struct train_problem *problem, const struct train_def *def,
                       const struct sim_control *control, struct adam *adam, int *order, double *g,
                       double *p, double *best, struct train_curve *curve)
{
    const int n = problem->n_trained;
    uint64_t seed = ~def->seed; /* another sequence than that of the start */
    enum status st = ST_OK;
    bool ended = false;
    for (int epoch = 0; epoch <= def->epochs && !ended && st == ST_OK; epoch++) {
        if (epoch > 0) {
            random_shuffle(n, &seed, order);
        }
        for (int first = 0; first < n && epoch > 0; first += def->batch) {
            gradient(problem, n - first < def->batch ? n - first : def->batch, order + first, p, g);
            adam_step(adam, g, p);
        }
        const double error = perceptron_error(&problem->shape, p, n, problem->trained_x,
                                              problem->trained_t, problem->trained_w);
        ended = train_note(problem, def, error, p, best, curve);
        st = !isfinite(error)                                  ? ST_NOT_FINITE
             : train_is_cancelled(control, epoch, def->epochs) ? ST_CANCELLED
                                                               : ST_OK;
    }
    return st;
}

enum status train_adam(const struct train_problem *problem, const struct train_def *def,
                       const struct sim_control *control, double *p, double *best,
                       struct train_curve *curve)
{
    const int n = problem->n_trained, count = perceptron_count(&problem->shape);
    struct adam adam = {0};
    int *order = malloc((size_t)n * sizeof *order);
    double *g = malloc((size_t)count * sizeof *g);
    enum status st = order != NULL && g != NULL ? ST_OK : ST_NO_MEMORY;
    st = st == ST_OK ? adam_init(count, def->rate, def->decay, &adam) : st;
    if (st == ST_OK) {
        for (int i = 0; i < n; i++) {
            order[i] = i;
        }
        st = run(problem, def, control, &adam, order, g, p, best, curve);
    }
    adam_done(&adam);
    free(order);
    free(g);
    return st;
}
