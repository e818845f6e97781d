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

struct lm {
    const struct train_problem *problem;
    simd_gram_fn gram_add;
    int count;
    double weight; /* of the square of each parameter in the objective */
    double *gram;  /* J'J/m (count x count), lower */
    double *a;     /* the same with the damping, then its factor */
    double *slope; /* half the gradient of the objective (count) */
    double *step;  /* (count) */
    double *trial; /* (count) */
    double *z;     /* basis of one block (rows x BLOCK) */
    double *e;     /* (BLOCK x n_out) */
    double *zz;    /* z z' over all samples (rows x rows), lower */
    double *ze;    /* z e (rows x n_out) */
};

static enum status lm_init(const struct train_problem *problem, const struct train_def *def,
                           struct lm *s)
{
    const int count = perceptron_count(&problem->shape);
    const size_t n = (size_t)count, square = n * n;
    const size_t rows = (size_t)perceptron_basis_rows(&problem->shape);
    const size_t n_out = (size_t)problem->shape.n_out;
    double *block = malloc((2 * square + 3 * n + (rows + n_out) * BLOCK + rows * (rows + n_out)) *
                           sizeof *block);
    if (block == NULL) {
        return ST_NO_MEMORY;
    }
    *s = (struct lm){.problem = problem,
                     .gram_add = simd_gram(simd_level_of_machine()),
                     .count = count,
                     .weight = def->decay / count,
                     .gram = block,
                     .a = block + square,
                     .slope = block + 2 * square,
                     .step = block + 2 * square + n,
                     .trial = block + 2 * square + 2 * n,
                     .z = block + 2 * square + 3 * n};
    s->e = s->z + rows * BLOCK;
    s->zz = s->e + n_out * BLOCK;
    s->ze = s->zz + rows * rows;
    return ST_OK;
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

static struct objective objective_at(const struct lm *s, const double *p)
{
    const struct train_problem *t = s->problem;
    const double error =
        perceptron_error(&t->shape, p, t->n_trained, t->trained_x, t->trained_t, t->trained_w);
    return with_decay(s, error, p);
}

/* J'J and J'e over all samples, divided by the number of residuals. */
static void normal_equations(struct lm *s, const double *p)
{
    const struct train_problem *t = s->problem;
    const int n_out = t->shape.n_out, rows = perceptron_basis_rows(&t->shape);
    const double factor = 1.0 / ((double)t->n_trained * n_out);
    memset(s->zz, 0, (size_t)rows * (size_t)(rows + n_out) * sizeof *s->zz); /* and ze */
    for (int first = 0; first < t->n_trained; first += BLOCK) {
        const int n = t->n_trained - first < BLOCK ? t->n_trained - first : BLOCK;
        perceptron_basis(&t->shape, p, n, t->trained_x + num_at(0, first, t->shape.n_in),
                         t->trained_t + num_at(0, first, n_out),
                         t->trained_w != NULL ? t->trained_w + first : NULL, s->e, s->z);
        s->gram_add(rows, n, s->z, s->zz);
        for (int o = 0; o < n_out; o++) {
            la_multiply_add(rows, n, s->z, s->e + num_at(0, o, n), s->ze + num_at(0, o, rows));
        }
    }
    perceptron_normal(&t->shape, p, s->zz, s->ze, s->gram, s->slope);
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
    enum status st = lm_init(problem, def, &s);
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
