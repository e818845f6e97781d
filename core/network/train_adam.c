#include "core/network/train_adam.h"

#include "core/network/adam.h"
#include "core/num.h"
#include "core/random.h"

#include <stdlib.h>
#include <string.h>

/* One batch of samples, and what the gradient is made of; one block, at x. */
struct batch {
    double *x, *t, *w; /* (n_in, n_out, 1 x samples) */
    double *z;         /* (basis rows x samples) */
    double *ze;        /* (n_out x basis rows) */
    double *g;         /* (count) */
};

static enum status batch_init(const struct perceptron *s, int n, struct batch *b)
{
    const size_t samples = (size_t)n, rows = (size_t)perceptron_basis_rows(s);
    const size_t n_in = (size_t)s->n_in, n_out = (size_t)s->n_out;
    b->x =
        malloc((samples * (n_in + n_out + 1 + rows) + rows * n_out + (size_t)perceptron_count(s)) *
               sizeof *b->x);
    if (b->x == NULL) {
        return ST_NO_MEMORY;
    }
    b->t = b->x + samples * n_in;
    b->w = b->t + samples * n_out;
    b->z = b->w + samples;
    b->ze = b->z + samples * rows;
    b->g = b->ze + rows * n_out;
    return ST_OK;
}

/* Gradient of the mean square error of n samples, whose weights stand in w, into b->g. */
static void gradient(const struct train_problem *t, const double *w, int n, const int *sample,
                     const double *p, struct batch *b)
{
    const struct perceptron *s = &t->shape;
    const int count = perceptron_count(s), rows = perceptron_basis_rows(s);
    const int first = perceptron_residual_row(s);
    const double factor = 2.0 / ((double)n * s->n_out);
    for (int i = 0; i < n; i++) {
        const int k = sample[i];
        memcpy(b->x + num_at(0, i, s->n_in), t->trained.x + num_at(0, k, s->n_in),
               (size_t)s->n_in * sizeof *b->x);
        memcpy(b->t + num_at(0, i, s->n_out), t->trained.t + num_at(0, k, s->n_out),
               (size_t)s->n_out * sizeof *b->t);
        b->w[i] = w[k];
    }
    perceptron_basis(s, p, n, b->x, b->t, b->w, b->z);
    memset(b->ze, 0, (size_t)rows * (size_t)s->n_out * sizeof *b->ze);
    for (int i = 0; i < n; i++) {
        const double *z = b->z + num_at(0, i, rows);
        for (int c = 0; c < first; c++) {
            for (int o = 0; o < s->n_out; o++) {
                b->ze[num_at(o, c, s->n_out)] += z[first + o] * z[c];
            }
        }
    }
    perceptron_slope(s, p, s->n_out, b->ze, b->g);
    for (int i = 0; i < count; i++) {
        b->g[i] *= factor;
    }
}

static enum status run(const struct train_problem *problem, const struct train_def *def,
                       const struct sim_control *control, struct adam *adam, int *order,
                       struct batch *b, double *w, double *p, double *best,
                       struct train_curve *curve)
{
    const struct train_part *part = &problem->trained;
    const int n = part->n;
    double *group_error = w + n;
    uint64_t seed = ~def->seed; /* another sequence than that of the start */
    enum status st = ST_OK;
    bool ended = false;
    for (int epoch = 0; epoch <= def->epochs && !ended && st == ST_OK; epoch++) {
        if (epoch > 0) {
            random_shuffle(n, &seed, order);
        }
        for (int first = 0; first < n && epoch > 0; first += def->batch) {
            gradient(problem, w, n - first < def->batch ? n - first : def->batch, order + first, p,
                     b);
            adam_step(adam, b->g, p);
        }
        train_group_errors(&problem->shape, p, part, 0, part->n_group, group_error);
        train_weights(part, problem->tolerance, group_error, w); /* of the next epoch */
        const double error = train_objective(part, problem->tolerance, group_error);
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
    const int n = problem->trained.n, count = perceptron_count(&problem->shape);
    struct adam adam = {0};
    int *order = malloc((size_t)n * sizeof *order);
    double *w = malloc((size_t)(n + problem->trained.n_group) * sizeof *w);
    struct batch batch = {.x = NULL};
    enum status st =
        order != NULL && w != NULL ? batch_init(&problem->shape, def->batch, &batch) : ST_NO_MEMORY;
    st = st == ST_OK ? adam_init(count, def->rate, def->decay, &adam) : st;
    if (st == ST_OK) {
        for (int i = 0; i < n; i++) {
            order[i] = i;
        }
        st = run(problem, def, control, &adam, order, &batch, w, p, best, curve);
    }
    adam_done(&adam);
    free(order);
    free(w);
    free(batch.x);
    return st;
}
