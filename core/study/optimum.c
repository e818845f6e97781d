#include "core/study/optimum.h"

#include "core/num.h"
#include "core/range.h"
#include "core/study/sampling.h"

#include <nlopt.h>

#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const method_name[] = {[OPTIMUM_COBYLA] = "cobyla", [OPTIMUM_DIRECT] = "direct"};

const char *optimum_method_name(enum optimum_method m)
{
    return (unsigned)m < OPTIMUM_METHODS ? method_name[m] : "";
}

enum optimum_method optimum_method_of(const char *name)
{
    int m = 0;
    while (m < OPTIMUM_METHODS && strcmp(method_name[m], name) != 0) {
        m++;
    }
    return (enum optimum_method)m;
}

const char *optimum_outcome_name(enum optimum_outcome o)
{
    static const char *const name[] = {[OPTIMUM_FOUND] = "found",
                                       [OPTIMUM_EXHAUSTED] = "exhausted",
                                       [OPTIMUM_INFEASIBLE] = "infeasible",
                                       [OPTIMUM_FAILED] = "failed"};
    return (unsigned)o < OPTIMUM_OUTCOMES ? name[o] : "";
}

void optimum_def_defaults(struct optimum_def *def)
{
    *def = (struct optimum_def){
        .starts = 3, .evaluations_max = 100, .tolerance = 1e-3, .excess_max = 1e-6};
}

static void check_variable(const struct optimum_def *def, int i, struct failure_list *out)
{
    char from[40], to[40], start[40];
    (void)snprintf(from, sizeof from, "/variables/%d/from", i);
    (void)snprintf(to, sizeof to, "/variables/%d/to", i);
    (void)snprintf(start, sizeof start, "/variables/%d/start", i);
    const struct range rules[] = {
        {from, def->lower[i], -HUGE_VAL, HUGE_VAL, false, false},
        {to, def->upper[i], def->lower[i], HUGE_VAL, true, false},
        {start, def->start[i], def->lower[i], def->upper[i], false, false},
    };
    range_check(def->has_start ? 3 : 2, rules, out);
}

void optimum_def_check(const struct optimum_def *def, struct failure_list *out)
{
    const struct range rules[] = {
        {"/variables", def->n, 1.0, OPTIMUM_VARIABLES_MAX, false, false},
        {"/constraints", def->n_constraint, 0.0, OPTIMUM_CONSTRAINTS_MAX, false, false},
        {"/starts", def->starts, 1.0, OPTIMUM_STARTS_MAX, false, false},
        /* COBYLA begins with one evaluation more than there are variables. */
        {"/evaluations_max", def->evaluations_max, def->n + 2.0, OPTIMUM_EVALUATIONS_MAX, false,
         false},
        {"/tolerance", def->tolerance, 1e-8, 0.5, false, false},
    };
    RANGE_CHECK(rules, out);
    for (int i = 0; i < def->n && i < OPTIMUM_VARIABLES_MAX; i++) {
        check_variable(def, i, out);
    }
}

/* The search runs in the unit cube. */
static double to_field(const struct optimum_def *d, int i, double u)
{
    return num_clamp(d->lower[i] + u * (d->upper[i] - d->lower[i]), d->lower[i], d->upper[i]);
}

void optimum_start(const struct optimum_def *def, int index, double *x)
{
    double u[OPTIMUM_VARIABLES_MAX];
    if (index == 0 && def->has_start) {
        memcpy(x, def->start, (size_t)def->n * sizeof *x);
        return;
    }
    sampling_sobol(def->n, (uint32_t)index + 1, u); /* 0 is a corner, 1 the middle */
    for (int i = 0; i < def->n; i++) {
        x[i] = to_field(def, i, u[i]);
    }
}

bool optimum_is_better(const struct optimum_point *a, const struct optimum_point *b)
{
    const bool a_ok = a->status == ST_OK, b_ok = b->status == ST_OK;
    if (!a_ok || !b_ok) {
        return a_ok && !b_ok;
    }
    if (a->feasible != b->feasible) {
        return a->feasible;
    }
    return a->feasible ? a->objective < b->objective : a->violation < b->violation;
}

struct search {
    const struct optimum_def *def;
    optimum_evaluate evaluate;
    void *context;
    struct optimum_result *out;
    nlopt_opt opt;
    enum status ended; /* by an evaluation, other than ST_OK */
    bool exhausted;
    int count_max; /* evaluations that this stage may go up to */
    /* Extremes of the points that could be evaluated, for those that cannot. */
    double worst, best, worst_excess[OPTIMUM_CONSTRAINTS_MAX];
};

static void note(struct search *s, struct optimum_point *p)
{
    const struct optimum_def *d = s->def;
    struct optimum_result *r = s->out;
    if (p->status == ST_OK &&
        !(isfinite(p->objective) && num_all_finite(d->n_constraint, p->excess))) {
        p->status = ST_NOT_FINITE;
    }
    const bool first = r->n == r->n_failed;
    p->violation = 0.0;
    for (int j = 0; j < d->n_constraint && p->status == ST_OK; j++) {
        p->violation = fmax(p->violation, p->excess[j] / d->scale[j]);
        s->worst_excess[j] = first ? p->excess[j] : fmax(s->worst_excess[j], p->excess[j]);
    }
    p->feasible = p->status == ST_OK && p->violation <= d->excess_max;
    if (p->status == ST_OK) {
        s->worst = first ? p->objective : fmax(s->worst, p->objective);
        s->best = first ? p->objective : fmin(s->best, p->objective);
    } else {
        r->n_failed++;
    }
    r->point[r->n] = *p;
    if (r->best < 0 ? p->status == ST_OK : optimum_is_better(p, &r->point[r->best])) {
        r->best = r->n;
    }
    r->n++;
}

/* The point at u, evaluated unless it was the last; NULL once the search is over. */
static const struct optimum_point *point_at(struct search *s, const double *u)
{
    const struct optimum_def *d = s->def;
    struct optimum_result *r = s->out;
    struct optimum_point p = {.status = ST_OK};
    for (int i = 0; i < d->n; i++) {
        p.x[i] = to_field(d, i, u[i]);
    }
    if (r->n > 0 && memcmp(r->point[r->n - 1].x, p.x, sizeof p.x) == 0) {
        return &r->point[r->n - 1];
    }
    if (s->ended != ST_OK || r->n >= s->count_max) {
        s->exhausted = s->exhausted || s->ended == ST_OK;
        (void)nlopt_force_stop(s->opt);
        return NULL;
    }
    s->ended = s->evaluate(s->context, &p);
    if (s->ended != ST_OK) {
        (void)nlopt_force_stop(s->opt);
        return NULL;
    }
    note(s, &p);
    if (r->best < 0 && nlopt_get_algorithm(s->opt) == NLOPT_LN_COBYLA) {
        (void)nlopt_force_stop(s->opt); /* without an answer at the start nothing can be modelled */
    }
    return &r->point[r->n - 1];
}

/* Linear models want a number everywhere: one worse than all that are known. */
static double stand_in(const struct search *s)
{
    return s->worst + (s->worst - s->best) + 1e-3 * fabs(s->worst);
}

/* nlopt_func. */
static double objective_of(unsigned n, const double *u, double *gradient, void *data)
{
    struct search *s = data;
    (void)n;
    (void)gradient;
    const struct optimum_point *p = point_at(s, u);
    if (p != NULL && p->status == ST_OK) {
        return p->objective;
    }
    /* DIRECT takes a value that is not finite for a point outside the domain. */
    return nlopt_get_algorithm(s->opt) == NLOPT_LN_COBYLA ? stand_in(s) : (double)HUGE_VAL;
}

/* nlopt_mfunc: excess in parts of its scale. */
static void constraints_of(unsigned m, double *result, unsigned n, const double *u,
                           double *gradient, void *data)
{
    struct search *s = data;
    (void)n;
    (void)gradient;
    const struct optimum_point *p = point_at(s, u);
    for (unsigned j = 0; j < m; j++) {
        const double excess = p != NULL && p->status == ST_OK ? p->excess[j] : s->worst_excess[j];
        result[j] = excess / s->def->scale[j];
    }
}

static bool prepare(struct search *s, double step)
{
    const struct optimum_def *d = s->def;
    double tolerance[OPTIMUM_CONSTRAINTS_MAX];
    for (int j = 0; j < d->n_constraint; j++) {
        tolerance[j] = d->excess_max;
    }
    bool ok = nlopt_set_lower_bounds1(s->opt, 0.0) > 0 && nlopt_set_upper_bounds1(s->opt, 1.0) > 0;
    ok = ok && nlopt_set_min_objective(s->opt, objective_of, s) > 0;
    ok = ok && nlopt_set_xtol_abs1(s->opt, d->tolerance) > 0;
    ok = ok && nlopt_set_initial_step1(s->opt, step) > 0;
    ok = ok && (d->n_constraint == 0 ||
                nlopt_add_inequality_mconstraint(s->opt, (unsigned)d->n_constraint, constraints_of,
                                                 s, tolerance) > 0);
    return ok;
}

/* One run of an algorithm from x, up to count_max evaluations in all. */
static enum status stage(struct search *s, nlopt_algorithm algorithm, const double *x, double step,
                         int count_max)
{
    const struct optimum_def *d = s->def;
    double u[OPTIMUM_VARIABLES_MAX], least = 0.0;
    for (int i = 0; i < d->n; i++) {
        u[i] = num_clamp((x[i] - d->lower[i]) / (d->upper[i] - d->lower[i]), 0.0, 1.0);
    }
    s->count_max = count_max;
    s->exhausted = false;
    s->opt = nlopt_create(algorithm, (unsigned)d->n);
    if (s->opt == NULL || !prepare(s, step)) {
        nlopt_destroy(s->opt);
        return ST_NO_MEMORY;
    }
    const nlopt_result end = nlopt_optimize(s->opt, u, &least);
    nlopt_destroy(s->opt);
    s->opt = NULL;
    /* Rounding that limits progress is an end like any other; a forced stop is ours. */
    return end == NLOPT_OUT_OF_MEMORY ? ST_NO_MEMORY : s->ended;
}

static enum status run(struct search *s, int index)
{
    const struct optimum_def *d = s->def;
    double x[OPTIMUM_VARIABLES_MAX];
    double step = 0.25;
    optimum_start(d, index, x);
    if (d->method == OPTIMUM_DIRECT) {
        const enum status st =
            stage(s, NLOPT_GN_ORIG_DIRECT_L, x, step, (d->evaluations_max + 1) / 2);
        if (st != ST_OK || s->out->best < 0) {
            return st;
        }
        memcpy(x, s->out->point[s->out->best].x, sizeof x);
        step = 0.05;
    }
    return stage(s, NLOPT_LN_COBYLA, x, step, d->evaluations_max);
}

enum status optimum_search(const struct optimum_def *def, int index, optimum_evaluate evaluate,
                           void *context, struct optimum_result *out)
{
    struct search s = {.def = def, .evaluate = evaluate, .context = context, .out = out};
    assert(def->n >= 1 && def->n <= OPTIMUM_VARIABLES_MAX);
    *out = (struct optimum_result){.outcome = OPTIMUM_FAILED, .best = -1};
    out->point = calloc((size_t)def->evaluations_max, sizeof *out->point);
    if (out->point == NULL) {
        return ST_NO_MEMORY;
    }
    const enum status st = run(&s, index);
    if (out->best >= 0) {
        out->outcome = !out->point[out->best].feasible ? OPTIMUM_INFEASIBLE
                       : s.exhausted                   ? OPTIMUM_EXHAUSTED
                                                       : OPTIMUM_FOUND;
    }
    return st;
}

void optimum_done(struct optimum_result *r)
{
    free(r->point);
    *r = (struct optimum_result){.best = -1};
}
