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

/* Half of the samples, by whole groups: what is summed over each is added up at the end, so that
 * two threads give the bits of one. */
struct half {
    struct lm *lm;
    int first, last; /* groups first..last - 1 */
    int begin, end;  /* their samples */
    const double *p; /* parameters of the sum under way */
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
    double *error; /* mean square of each group at the last parameters asked for (n_group) */
    double *w;     /* weights of the samples in the normal equations (n) */
    struct half half[2];
};

/* The group at whose end about half of the samples are. */
static int middle_group(const struct train_part *part)
{
    int g = 1;
    while (g < part->n_group && part->end[g - 1] < part->n / 2) {
        g++;
    }
    return g;
}

static enum status lm_init(const struct train_problem *problem, const struct train_def *def,
                           const struct sim_control *control, struct lm *s)
{
    const struct train_part *part = &problem->trained;
    const int count = perceptron_count(&problem->shape), middle = middle_group(part);
    const size_t n = (size_t)count, square = n * n;
    const size_t rows = (size_t)perceptron_basis_rows(&problem->shape);
    const size_t of_half = 2 * rows * BLOCK + rows * rows;
    const size_t of_samples = (size_t)(part->n_group + part->n);
    double *block = malloc((2 * square + 3 * n + 2 * of_half + of_samples) * sizeof *block);
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
    double *next = block + 2 * square + 3 * n;
    for (int h = 0; h < 2; h++) {
        s->half[h] = (struct half){.lm = s,
                                   .first = h == 0 ? 0 : middle,
                                   .last = h == 0 ? middle : part->n_group,
                                   .begin = h == 0 ? 0 : part->end[middle - 1],
                                   .end = h == 0 ? part->end[middle - 1] : part->n,
                                   .z = next,
                                   .work = next + rows * BLOCK,
                                   .zz = next + 2 * rows * BLOCK};
        next += of_half;
    }
    s->error = next;
    s->w = next + part->n_group;
    return ST_OK;
}

/* Does the work on both halves, with the parameters p. */
static void on_both(struct lm *s, void (*work)(void *), const double *p)
{
    s->half[0].p = s->half[1].p = p;
    sim_control_both(s->control, work, &s->half[0], &s->half[1]);
}

/* What the samples say, and that with what the decay adds to it. */
struct objective {
    double error, total;
};

static void sum_errors(void *half)
{
    const struct half *h = half;
    const struct train_problem *t = h->lm->problem;
    train_group_errors(&t->shape, h->p, &t->trained, h->first, h->last, h->lm->error);
}

static struct objective objective_at(struct lm *s, const double *p)
{
    const struct train_problem *t = s->problem;
    on_both(s, sum_errors, p);
    const double error = train_objective(&t->trained, t->tolerance, s->error);
    double sum = 0.0;
    for (int i = 0; i < s->count; i++) {
        sum += num_sq(p[i]);
    }
    return (struct objective){.error = error, .total = error + s->weight * sum};
}

static void sum_products(void *half)
{
    const struct half *h = half;
    const struct train_problem *t = h->lm->problem;
    const struct train_part *part = &t->trained;
    const simd_gram_fn gram_add = simd_gram(simd_level_of_machine());
    const int rows = perceptron_basis_rows(&t->shape);
    memset(h->zz, 0, (size_t)rows * (size_t)rows * sizeof *h->zz);
    for (int first = h->begin; first < h->end; first += BLOCK) {
        const int n = h->end - first < BLOCK ? h->end - first : BLOCK;
        perceptron_basis(&t->shape, h->p, n, part->x + num_at(0, first, t->shape.n_in),
                         part->t + num_at(0, first, t->shape.n_out), h->lm->w + first, h->z);
        gram_add(rows, n, h->z, h->work, h->zz);
    }
}

/* J'J and J'e over all samples, divided by the number of residuals, with the weights w. */
static void normal_equations(struct lm *s, const double *p)
{
    const struct perceptron *shape = &s->problem->shape;
    const int rows = perceptron_basis_rows(shape);
    const double factor = 1.0 / ((double)s->problem->trained.n * shape->n_out);
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

/* One epoch: raises the damping until the objective falls. False when it does not any more.
 * s->error is that at p, before and, where the objective fell, after. */
static bool descend(struct lm *s, double *damping, double *p, struct objective *now)
{
    train_weights(&s->problem->trained, s->problem->tolerance, s->error, s->w);
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
