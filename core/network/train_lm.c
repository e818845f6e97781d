#include "core/network/train_lm.h"

#include "core/la.h"
#include "core/num.h"
#include "core/simd.h"

#include <stdlib.h>
#include <string.h>

enum { BLOCK = 256 }; /* samples of one block: it stays in the cache */

/* Damping, of normal equations whose diagonal is about one. */
static const double damping_start = 1e-2, damping_least = 1e-12, damping_most = 1e10;
static const double damping_factor = 10.0;
/* Without progress from here on, relative to the objective. */
static const double progress_least = 1e-12;

/* Half of the samples: what is summed over each is added up at the end, so that two threads give
 * the bits of one. */
struct half {
    const struct train_problem *problem;
    int first, n;    /* samples */
    const double *p; /* parameters of the sum under way */
    double error;    /* their mean square */
    double *z;       /* basis of one block (rows x BLOCK) */
    double *work;    /* of its products (rows x BLOCK) */
    double *zz;      /* z z' (rows x rows), lower triangle */
};

struct lm {
    const struct train_problem *problem;
    const struct sim_control *control;
    int count;
    double weight; /* of the square of each parameter in the objective */
    double *gram;  /* J'J/m (count x count), lower */
    double *a;     /* the same with the damping, then its factor */
    double *slope; /* half the gradient of the objective (count) */
    double *step;  /* (count) */
    double *trial; /* (count) */
    struct half half[2];
};

static enum status lm_init(const struct train_problem *problem, const struct train_def *def,
                           const struct sim_control *control, struct lm *s)
{
    const int count = perceptron_count(&problem->shape);
    const size_t n = (size_t)count, square = n * n;
    const size_t rows = (size_t)perceptron_basis_rows(&problem->shape);
    const size_t of_half = 2 * rows * BLOCK + rows * rows;
    double *block = malloc((2 * square + 3 * n + 2 * of_half) * sizeof *block);
    if (block == NULL) {
        return ST_NO_MEMORY;
    }
    *s = (struct lm){.problem = problem,
                     .control = control,
                     .count = count,
                     .weight = def->decay / count,
                     .gram = block,
                     .a = block + square,
                     .slope = block + 2 * square,
                     .step = block + 2 * square + n,
                     .trial = block + 2 * square + 2 * n};
    for (int h = 0; h < 2; h++) {
        double *own = block + 2 * square + 3 * n + (size_t)h * of_half;
        const int middle = problem->n_trained / 2;
        s->half[h] = (struct half){.problem = problem,
                                   .first = h == 0 ? 0 : middle,
                                   .n = h == 0 ? middle : problem->n_trained - middle,
                                   .z = own,
                                   .work = own + rows * BLOCK,
                                   .zz = own + 2 * rows * BLOCK};
    }
    return ST_OK;
}

/* Does the work on both halves, with the parameters p. */
static void on_both(struct lm *s, void (*work)(void *), const double *p)
{
    s->half[0].p = s->half[1].p = p;
    sim_control_both(s->control, work, &s->half[0], &s->half[1]);
}

/* The samples from `first` on; NULL: all weigh alike. */
static const double *weights_from(const struct train_problem *t, int first)
{
    return t->trained_w != NULL ? t->trained_w + first : NULL;
}

/* Mean square error of the trained samples and what the decay adds to it. */
struct objective {
    double error, total;
};

static struct objective with_decay(const struct lm *s, double error, const double *p)
{
    double sum = 0.0;
    for (int i = 0; i < s->count; i++) {
        sum += num_sq(p[i]);
    }
    return (struct objective){.error = error, .total = error + s->weight * sum};
}

static void sum_errors(void *half)
{
    struct half *h = half;
    const struct train_problem *t = h->problem;
    h->error = h->n == 0 ? 0.0
                         : perceptron_error(&t->shape, h->p, h->n,
                                            t->trained_x + num_at(0, h->first, t->shape.n_in),
                                            t->trained_t + num_at(0, h->first, t->shape.n_out),
                                            weights_from(t, h->first));
}

static struct objective objective_at(struct lm *s, const double *p)
{
    on_both(s, sum_errors, p);
    double sum = 0.0;
    for (int h = 0; h < 2; h++) {
        sum += s->half[h].error * s->half[h].n;
    }
    return with_decay(s, sum / s->problem->n_trained, p);
}

static void sum_products(void *half)
{
    const struct half *h = half;
    const struct train_problem *t = h->problem;
    const simd_gram_fn gram_add = simd_gram(simd_level_of_machine());
    const int rows = perceptron_basis_rows(&t->shape);
    memset(h->zz, 0, (size_t)rows * (size_t)rows * sizeof *h->zz);
    for (int done = 0; done < h->n; done += BLOCK) {
        const int first = h->first + done, n = h->n - done < BLOCK ? h->n - done : BLOCK;
        perceptron_basis(&t->shape, h->p, n, t->trained_x + num_at(0, first, t->shape.n_in),
                         t->trained_t + num_at(0, first, t->shape.n_out), weights_from(t, first),
                         h->z);
        gram_add(rows, n, h->z, h->work, h->zz);
    }
}

/* J'J and J'e over all samples, divided by the number of residuals. */
static void normal_equations(struct lm *s, const double *p)
{
    const struct perceptron *shape = &s->problem->shape;
    const int rows = perceptron_basis_rows(shape);
    const double factor = 1.0 / ((double)s->problem->n_trained * shape->n_out);
    on_both(s, sum_products, p);
    double *zz = s->half[0].zz;
    for (ptrdiff_t i = 0; i < num_at(0, rows, rows); i++) {
        zz[i] += s->half[1].zz[i];
    }
    perceptron_normal(shape, p, zz, s->gram);
    perceptron_slope(shape, p, rows, zz + perceptron_residual_row(shape), s->slope);
    for (ptrdiff_t i = 0; i < num_at(0, s->count, s->count); i++) {
        s->gram[i] *= factor;
    }
    for (int i = 0; i < s->count; i++) {
        s->slope[i] = factor * s->slope[i] + s->weight * p[i];
    }
}

/* trial = p - (J'J + weight + damping)^-1 slope. */
static enum status solve(struct lm *s, double damping, const double *p)
{
    memcpy(s->a, s->gram, (size_t)s->count * (size_t)s->count * sizeof *s->a);
    for (int i = 0; i < s->count; i++) {
        s->a[num_at(i, i, s->count)] += s->weight + damping;
    }
    const enum status st = la_cholesky(s->count, s->a);
    if (st != ST_OK) {
        return st;
    }
    memcpy(s->step, s->slope, (size_t)s->count * sizeof *s->step);
    la_cholesky_solve(s->count, s->a, 1, s->step);
    for (int i = 0; i < s->count; i++) {
        s->trial[i] = p[i] - s->step[i];
    }
    return ST_OK;
}

/* One epoch: raises the damping until the objective falls. False when it does not any more. */
static bool descend(struct lm *s, double *damping, double *p, struct objective *now)
{
    normal_equations(s, p);
    for (; *damping <= damping_most; *damping *= damping_factor) {
        if (solve(s, *damping, p) != ST_OK) {
            continue;
        }
        const struct objective next = objective_at(s, s->trial);
        if (next.total < now->total) {
            const bool moved = now->total - next.total > progress_least * now->total;
            memcpy(p, s->trial, (size_t)s->count * sizeof *p);
            *now = next;
            *damping = fmax(*damping / damping_factor, damping_least);
            return moved;
        }
    }
    return false;
}

enum status train_lm(const struct train_problem *problem, const struct train_def *def,
                     const struct sim_control *control, double *p, double *best,
                     struct train_curve *curve)
{
    struct lm s;
    double damping = damping_start;
    enum status st = lm_init(problem, def, control, &s);
    if (st != ST_OK) {
        return st;
    }
    struct objective now = objective_at(&s, p);
    bool ended = !isfinite(now.total) || train_note(problem, def, now.error, p, best, curve);
    st = isfinite(now.total) ? ST_OK : ST_NOT_FINITE;
    for (int epoch = 0; epoch < def->epochs && !ended && st == ST_OK; epoch++) {
        if (train_is_cancelled(control, epoch, def->epochs)) {
            st = ST_CANCELLED;
            break;
        }
        const bool moved = descend(&s, &damping, p, &now);
        ended = train_note(problem, def, now.error, p, best, curve) || !moved;
    }
    free(s.gram);
    return st;
}
