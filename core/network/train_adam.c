#include "core/network/train_adam.h"

#include "core/num.h"

#include <stdlib.h>
#include <string.h>

/* The constants Kingma & Ba recommend: memory of the mean and of the square, and the guard. */
static const double memory_mean = 0.9, memory_square = 0.999, guard = 1e-8;

struct adam {
    const struct train_problem *problem;
    int count;
    double rate, weight; /* weight of the square of each parameter in the objective */
    double *g;           /* (count) */
    double *mean;        /* (count) */
    double *square;      /* (count) */
    int *order;          /* (n_trained) */
    double power_mean, power_square;
};

static enum status adam_init(const struct train_problem *problem, const struct train_def *def,
                             struct adam *s)
{
    const int count = perceptron_count(&problem->shape);
    double *block = calloc(3 * (size_t)count, sizeof *block);
    int *order = malloc((size_t)problem->n_trained * sizeof *order);
    if (block == NULL || order == NULL) {
        free(block);
        free(order);
        return ST_NO_MEMORY;
    }
    for (int i = 0; i < problem->n_trained; i++) {
        order[i] = i;
    }
    *s = (struct adam){.problem = problem,
                       .count = count,
                       .rate = def->rate,
                       .weight = def->decay / count,
                       .g = block,
                       .mean = block + count,
                       .square = block + 2 * (ptrdiff_t)count,
                       .order = order,
                       .power_mean = 1.0,
                       .power_square = 1.0};
    return ST_OK;
}

static void shuffle(int n, uint64_t *seed, int *order)
{
    for (int i = n - 1; i > 0; i--) {
        const int k = (int)(dataset_uniform(seed) * (i + 1));
        const int keep = order[i];
        order[i] = order[k];
        order[k] = keep;
    }
}

/* One step on n samples. */
static void step(struct adam *s, int n, const int *sample, double *p)
{
    const struct train_problem *t = s->problem;
    const double factor = 2.0 / ((double)n * t->shape.n_out);
    memset(s->g, 0, (size_t)s->count * sizeof *s->g);
    for (int i = 0; i < n; i++) {
        perceptron_gradient_add(&t->shape, p, t->trained_x + num_at(0, sample[i], t->shape.n_in),
                                t->trained_t + num_at(0, sample[i], t->shape.n_out), s->g);
    }
    s->power_mean *= memory_mean;
    s->power_square *= memory_square;
    for (int i = 0; i < s->count; i++) {
        const double g = factor * s->g[i] + 2.0 * s->weight * p[i];
        s->mean[i] = memory_mean * s->mean[i] + (1.0 - memory_mean) * g;
        s->square[i] = memory_square * s->square[i] + (1.0 - memory_square) * g * g;
        const double mean = s->mean[i] / (1.0 - s->power_mean);
        const double square = s->square[i] / (1.0 - s->power_square);
        p[i] -= s->rate * mean / (sqrt(square) + guard);
    }
}

enum status train_adam(const struct train_problem *problem, const struct train_def *def,
                       const struct sim_control *control, double *p, double *best,
                       struct train_curve *curve)
{
    const int n = problem->n_trained;
    struct adam s;
    uint64_t seed = ~def->seed; /* another sequence than that of the start */
    enum status st = adam_init(problem, def, &s);
    bool ended = false;
    if (st != ST_OK) {
        return st;
    }
    for (int epoch = 0; epoch <= def->epochs && !ended && st == ST_OK; epoch++) {
        if (epoch > 0) {
            shuffle(n, &seed, s.order);
        }
        for (int first = 0; first < n && epoch > 0; first += def->batch) {
            step(&s, n - first < def->batch ? n - first : def->batch, s.order + first, p);
        }
        const double error =
            perceptron_error(&problem->shape, p, n, problem->trained_x, problem->trained_t);
        ended = train_note(problem, def, error, p, best, curve);
        st = !isfinite(error)                                  ? ST_NOT_FINITE
             : train_is_cancelled(control, epoch, def->epochs) ? ST_CANCELLED
                                                               : ST_OK;
    }
    free(s.g);
    free(s.order);
    return st;
}
