/* The optimum from one start: objective and constraints of each point by runs of the case. */
#include "api/study_seek.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { CODE_SIZE = 40 };

struct seeking {
    struct study_evaluator *e;
    struct study_boundary *boundary; /* room for the search at a point */
    double speed_to;                 /* end of the range of a case of kind stability [m/s] */
    bool structural;                 /* a variable decides section, beam or modes */
    int n;
    char (*code)[CODE_SIZE]; /* why evaluations failed (evaluations_max) */
    int *runs;               /* of each evaluation */
};

/* The result that is sought, and whether it is to be large. */
static const char *objective_name(const struct study *s, bool *large)
{
    *large = s->search.maximise[0] != '\0';
    return *large ? s->search.maximise : s->search.minimise;
}

static void set_variables(const struct study *s, const double *x)
{
    for (int i = 0; i < s->n_axis; i++) {
        (void)cJSON_SetNumberHelper(s->axis[i].leaf, x[i]);
    }
}

static void fail_point(struct seeking *k, struct optimum_point *p, enum status st, const char *code)
{
    p->status = st;
    (void)snprintf(k->code[k->n], CODE_SIZE, "%s", code);
}

/* A number of the summary; otherwise the point fails. */
static bool number_of(struct seeking *k, const struct study_answer *a, const char *path,
                      struct optimum_point *p, double *out)
{
    if (a->status != ST_OK) {
        fail_point(k, p, a->status, a->code);
        return false;
    }
    if (study_number(a->summary, path, out) != STUDY_VALUE_NUMBER) {
        fail_point(k, p, ST_NOT_CONVERGED, "no_value");
        return false;
    }
    /* An instability above the range of speeds: at its end, at least. */
    *out = isfinite(*out) ? *out : k->speed_to;
    return true;
}

/* Excess over each limit, in the order of study_search_define. */
static void read_constraints(struct seeking *k, const struct study_answer *a,
                             struct optimum_point *p)
{
    const struct study_search *f = &k->e->study->search;
    int n = 0;
    for (int i = 0; i < f->n_constraint && p->status == ST_OK; i++) {
        const struct study_constraint *c = &f->constraint[i];
        double value = 0.0;
        if (!number_of(k, a, c->value, p, &value)) {
            return;
        }
        if (isfinite(c->min)) {
            p->excess[n++] = c->min - value;
        }
        if (isfinite(c->max)) {
            p->excess[n++] = value - c->max;
        }
    }
}

static enum status find_boundary(struct seeking *k, struct optimum_point *p, double *value)
{
    const enum status st = study_seek_boundary(k->e, BOUNDARY_ALONE, k->boundary);
    if (st == ST_OK) {
        *value = study_boundary_value(k->e->study, k->boundary);
        if (!isfinite(*value)) {
            fail_point(k, p, ST_NOT_CONVERGED, boundary_outcome_name(k->boundary->result.outcome));
        }
    }
    return st;
}

/* optimum_evaluate. */
static enum status evaluate_point(void *context, struct optimum_point *p)
{
    struct seeking *k = context;
    const struct study *s = k->e->study;
    bool large = false;
    const char *name = objective_name(s, &large);
    const int before = k->e->runs;
    double value = 0.0;
    enum status st = ST_OK;
    set_variables(s, p->x);
    if (k->structural) {
        study_evaluator_change(k->e);
    }
    const bool bounded = study_seeks_boundary(s);
    if (!bounded || s->search.n_constraint > 0) {
        struct study_answer answer = {.status = ST_OK};
        st = study_evaluate(k->e, NULL, NULL, &answer);
        if (st == ST_OK && (bounded || number_of(k, &answer, name, p, &value))) {
            read_constraints(k, &answer, p);
        }
        study_answer_done(&answer);
    }
    if (st == ST_OK && bounded && p->status == ST_OK) {
        st = find_boundary(k, p, &value);
    }
    p->objective = large ? -value : value;
    k->runs[k->n] = k->e->runs - before;
    k->n += st == ST_OK;
    return st;
}

/* -- document --------------------------------------------------------------------------- */

static void write_point(struct json_out *out, const struct study *s, const struct optimum_point *p)
{
    bool large = false;
    (void)objective_name(s, &large);
    json_key(out, "point");
    json_object_begin(out);
    for (int i = 0; i < s->n_axis; i++) {
        json_key_number(out, s->axis[i].pointer, p->x[i]);
    }
    json_object_end(out);
    const bool known = p->status == ST_OK;
    json_key_number(out, "objective", !known ? (double)NAN : large ? -p->objective : p->objective);
    json_key(out, "feasible");
    json_boolean(out, p->feasible);
    json_key_number(out, "violation", known ? p->violation : (double)NAN);
    json_key_numbers(out, "excess", known ? s->search.optimum.n_constraint : 0, p->excess, 1, 1.0);
}

static void write_search(struct json_out *out, const struct seeking *k,
                         const struct optimum_result *r)
{
    const struct study *s = k->e->study;
    bool large = false;
    json_object_begin(out);
    json_key_string(out, "kind", "optimum");
    json_key_string(out, "result", objective_name(s, &large));
    json_key(out, "maximised");
    json_boolean(out, large);
    json_key_string(out, "outcome", optimum_outcome_name(r->outcome));
    json_key(out, "best");
    if (r->best >= 0) {
        json_object_begin(out);
        write_point(out, s, &r->point[r->best]);
        json_object_end(out);
    } else {
        json_null(out);
    }
    json_key_number(out, "objective",
                    r->best < 0 ? (double)NAN
                    : large     ? -r->point[r->best].objective
                                : r->point[r->best].objective);
    json_key_integer(out, "evaluations", r->n);
    json_key_integer(out, "failed_evaluations", r->n_failed);
    json_key_integer(out, "runs", k->e->runs);
    json_key(out, "history");
    json_array_begin(out);
    for (int i = 0; i < r->n; i++) {
        json_object_begin(out);
        write_point(out, s, &r->point[i]);
        json_key_string(out, "error", k->code[i][0] != '\0' ? k->code[i] : NULL);
        json_key_integer(out, "runs", k->runs[i]);
        json_object_end(out);
    }
    json_array_end(out);
    json_object_end(out);
}

static bool is_structural(const struct study *s)
{
    bool structural = false;
    for (int i = 0; i < s->n_axis; i++) {
        structural = structural || s->axis[i].structural;
    }
    return structural;
}

enum status study_seek_optimum(struct study_evaluator *e, int cell, struct study_cell_result *out)
{
    const struct optimum_def *d = &e->study->search.optimum;
    const size_t n = (size_t)d->evaluations_max;
    struct optimum_result r = {.best = -1};
    struct seeking k = {.e = e, .structural = is_structural(e->study)};
    const cJSON *range = cJSON_GetObjectItemCaseSensitive(e->study->tree, "stability");
    k.speed_to = cJSON_GetNumberValue(cJSON_GetObjectItemCaseSensitive(range, "to_m_s"));
    k.boundary = malloc(sizeof *k.boundary);
    k.code = calloc(n, sizeof *k.code);
    k.runs = calloc(n, sizeof *k.runs);
    enum status st = k.boundary != NULL && k.code != NULL && k.runs != NULL ? ST_OK : ST_NO_MEMORY;
    if (st == ST_OK) {
        st = optimum_search(d, cell, evaluate_point, &k, &r);
    }
    if (st == ST_OK) {
        struct json_out text = {0};
        write_search(&text, &k, &r);
        out->summary = json_out_take(&text, NULL);
        (void)snprintf(out->verdict, sizeof out->verdict, "%s", optimum_outcome_name(r.outcome));
        st = out->summary != NULL ? ST_OK : ST_NO_MEMORY;
    }
    optimum_done(&r);
    free(k.boundary);
    free(k.code);
    free(k.runs);
    return st;
}
