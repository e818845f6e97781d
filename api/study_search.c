#include "api/study_search.h"

#include "api/study_axes.h"
#include "core/analysis/verdict.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void study_search_defaults(struct study_search *s)
{
    static const double usual[] = {0.05, 0.5, 0.95};
    boundary_def_defaults(&s->field.def);
    optimum_def_defaults(&s->optimum);
    (void)snprintf(s->result, sizeof s->result, "%s", study_boundary_name);
    s->samples = 128;
    s->method = SAMPLING_SOBOL;
    s->seed = 1;
    s->n_quantile = sizeof usual / sizeof usual[0];
    memcpy(s->quantile, usual, sizeof usual);
    s->confidence = 0.9;
}

static bool is_boundary(const char *name)
{
    return strcmp(name, study_boundary_name) == 0;
}

bool study_seeks_boundary(const struct study *s)
{
    const struct study_search *f = &s->search;
    return s->type == STUDY_BOUNDARY || (s->type == STUDY_UNCERTAINTY && is_boundary(f->result)) ||
           (s->type == STUDY_OPTIMUM && (is_boundary(f->maximise) || is_boundary(f->minimise)));
}

bool study_seeks(const struct study *s)
{
    return s->type == STUDY_OPTIMUM || study_seeks_boundary(s);
}

/* -- axes ------------------------------------------------------------------------------- */

/* One axis of n values that goes with the others of its kind. */
static bool add_axis(struct study *s, const char *pointer, int n)
{
    struct study_axis *a = &s->axis[s->n_axis];
    *a = (struct study_axis){.from = (double)NAN, .to = (double)NAN, .listed = true, .n = n};
    (void)snprintf(a->pointer, sizeof a->pointer, "%s", pointer);
    (void)snprintf(a->zip, sizeof a->zip, "together");
    a->value = calloc((size_t)n, sizeof *a->value);
    s->n_axis++;
    return a->value != NULL;
}

bool study_search_axes(struct study *s)
{
    const struct study_search *f = &s->search;
    bool ok = true;
    for (int i = 0; s->type == STUDY_UNCERTAINTY && i < f->n_tolerance; i++) {
        ok = add_axis(s, f->tolerance[i].pointer, f->samples) && ok;
    }
    for (int i = 0; s->type == STUDY_OPTIMUM && i < f->n_variable; i++) {
        ok = add_axis(s, f->variable[i].pointer, f->optimum.starts) && ok;
    }
    return ok;
}

static enum status fill_samples(struct study *s)
{
    const struct study_search *f = &s->search;
    double *u = malloc((size_t)(f->samples * f->n_tolerance) * sizeof *u);
    enum status st = u != NULL ? sampling_points((enum sampling_method)f->method, f->n_tolerance,
                                                 f->samples, (uint64_t)f->seed, u)
                               : ST_NO_MEMORY;
    for (int i = 0; st == ST_OK && i < f->n_tolerance; i++) {
        const struct sampling_tolerance t = {
            .distribution = (enum sampling_distribution)f->tolerance[i].distribution,
            .centre = s->axis[i].own_value,
            .spread = f->tolerance[i].spread};
        for (int k = 0; k < f->samples; k++) {
            s->axis[i].value[k] = sampling_value(&t, u[num_at(i, k, f->n_tolerance)]);
        }
    }
    free(u);
    return st;
}

enum status study_search_fill(struct study *s)
{
    if (s->type == STUDY_UNCERTAINTY) {
        return fill_samples(s);
    }
    for (int k = 0; s->type == STUDY_OPTIMUM && k < s->search.optimum.starts; k++) {
        double x[OPTIMUM_VARIABLES_MAX];
        optimum_start(&s->search.optimum, k, x);
        for (int i = 0; i < s->n_axis; i++) {
            s->axis[i].value[k] = x[i];
        }
    }
    return ST_OK;
}

/* -- checks ----------------------------------------------------------------------------- */

static void refuse(struct reader *r, const char *key, const char *code, const char *expected,
                   const char *detail)
{
    const size_t mark = reader_enter_key(r, key);
    reader_problem(r, code, expected, NULL, "%s", detail);
    reader_leave(r, mark);
}

static void check_criterion(const struct study *s, struct reader *r)
{
    const struct study_criterion *c = &s->search.criterion;
    const char *names[VERDICT_COUNT + 1] = {NULL};
    char expected[128];
    if ((c->value[0] == '\0') == (c->verdict[0] == '\0')) {
        refuse(r, "criterion", "contradictory", "\"value\" or \"verdict\"",
               "a criterion is either a value or a verdict");
        return;
    }
    for (int v = 0; v < VERDICT_COUNT; v++) {
        names[v] = verdict_name((enum verdict)v);
    }
    const size_t mark = reader_enter_key(r, "criterion");
    if (c->verdict[0] != '\0' && field_name_index(names, c->verdict) < 0) {
        reader_join(names, sizeof expected, expected);
        refuse(r, "verdict", "unknown_value", expected, "there is no such verdict");
    }
    if (c->verdict[0] != '\0' && !case_kind_flows(s->case_kind)) {
        refuse(r, "verdict", "unexpected", "a \"value\"", "this kind of case has no verdict");
    }
    reader_leave(r, mark);
}

/* Pointer and range of the field, and whether the case admits its ends. */
static enum status check_field(struct study *s, struct reader *r)
{
    struct study_field *f = &s->search.field;
    const int before = r->problems->total;
    const size_t mark = reader_enter_key(r, "field");
    const size_t inner = reader_enter_key(r, "pointer");
    f->leaf = study_resolve(r, s->tree, f->pointer);
    if (f->leaf != NULL && !cJSON_IsNumber(f->leaf)) {
        reader_problem(r, "wrong_type", "the pointer of a number", f->leaf, "\"%s\" is no number",
                       f->pointer);
    }
    for (int i = 0; i < s->n_axis; i++) {
        if (strcmp(s->axis[i].pointer, f->pointer) == 0) {
            reader_problem(r, "duplicate_value", "distinct pointers", NULL,
                           "\"%s\" is varied as well", f->pointer);
        }
    }
    reader_leave(r, inner);
    reader_leave(r, mark);
    boundary_def_check(&f->def, r->problems);
    if (r->problems->total > before) {
        return ST_OK;
    }
    f->own_value = f->leaf->valuedouble;
    f->structural = study_is_structural(f->pointer);
    return study_try_field(s, r);
}

static void check_objective(const struct study *s, struct reader *r)
{
    const struct study_search *f = &s->search;
    if ((f->maximise[0] == '\0') == (f->minimise[0] == '\0')) {
        refuse(r, "maximise", "contradictory", "\"maximise\" or \"minimise\"",
               "one result is either maximised or minimised");
    }
    const size_t mark = reader_enter_key(r, "constraints");
    for (int i = 0; i < f->n_constraint; i++) {
        const struct study_constraint *c = &f->constraint[i];
        const size_t entry = reader_enter_index(r, i);
        if (!isfinite(c->min) && !isfinite(c->max)) {
            reader_problem(r, "required", "\"min\", \"max\" or both", NULL,
                           "the constraint has no limit");
        } else if (c->min > c->max) {
            reader_problem(r, "contradictory", "min <= max", NULL,
                           "nothing is at least %.9g and at most %.9g", c->min, c->max);
        }
        reader_leave(r, entry);
    }
    reader_leave(r, mark);
}

/* The definition of the search in the core, with one excess for each limit. */
static void define_optimum(struct study *s)
{
    struct study_search *f = &s->search;
    struct optimum_def *d = &f->optimum;
    d->method = (enum optimum_method)f->optimum_method;
    d->starts = d->method == OPTIMUM_DIRECT ? 1 : d->starts;
    d->n = f->n_variable;
    for (int i = 0; i < f->n_variable; i++) {
        const struct study_variable *v = &f->variable[i];
        d->lower[i] = v->from;
        d->upper[i] = v->to;
        d->start[i] = isfinite(v->start) ? v->start : v->from + 0.5 * (v->to - v->from);
        d->has_start = d->has_start || isfinite(v->start);
    }
    d->n_constraint = 0;
    for (int i = 0; i < f->n_constraint; i++) {
        const double limits[] = {f->constraint[i].min, f->constraint[i].max};
        for (int k = 0; k < 2; k++) {
            if (isfinite(limits[k])) {
                d->scale[d->n_constraint++] = fabs(limits[k]) > 0.0 ? fabs(limits[k]) : 1.0;
            }
        }
    }
}

void study_search_define(struct study *s)
{
    if (s->type == STUDY_OPTIMUM) {
        define_optimum(s);
    }
}

/* About how many runs of the case a cell takes. */
static double runs_of(const struct study *s)
{
    const struct study_search *f = &s->search;
    const double boundary = study_seeks_boundary(s) ? f->field.def.scan + 5.0 : 1.0;
    const double points = s->type == STUDY_OPTIMUM ? f->optimum.evaluations_max : 1.0;
    return boundary * points * (f->hysteresis ? 2.0 : 1.0);
}

enum status study_search_check(struct study *s, struct reader *r)
{
    const struct study_search *f = &s->search;
    enum status st = ST_OK;
    if (s->type == STUDY_OPTIMUM) {
        optimum_def_check(&f->optimum, r->problems);
        check_objective(s, r);
    }
    const bool seeks = study_seeks_boundary(s);
    if (seeks && f->field.pointer[0] == '\0') {
        refuse(r, "field", "required", "a value", "a boundary is that of a field");
    } else if (!seeks && f->field.pointer[0] != '\0') {
        refuse(r, "field", "unexpected", "the result \"boundary\"",
               "no boundary is asked for, so it has no field");
    } else if (seeks) {
        st = check_field(s, r);
        check_criterion(s, r);
    }
    s->cost_s *= runs_of(s);
    if (f->hysteresis && s->case_kind != CASE_SIMULATION) {
        refuse(r, "hysteresis", "unexpected", "a case of kind \"simulation\"",
               "only a march can go on from the one before");
    }
    return st;
}

/* -- judgement -------------------------------------------------------------------------- */

enum study_value_kind study_number(const struct cJSON *summary, const char *path, double *out)
{
    const char *text = NULL, *dot = strrchr(path, '.');
    const enum study_value_kind kind = study_value(summary, path, out, &text);
    if (kind == STUDY_VALUE_ABSENT && dot != NULL) {
        char parent[STUDY_PATH_SIZE];
        (void)snprintf(parent, sizeof parent, "%.*s", (int)(dot - path), path);
        if (study_value(summary, parent, out, &text) == STUDY_VALUE_TEXT &&
            strcmp(text, "none_in_range") == 0) {
            *out = (double)INFINITY;
            return STUDY_VALUE_NUMBER;
        }
    }
    return kind;
}

enum status study_judge(const struct study_criterion *c, const struct cJSON *summary, int *side,
                        double *value, const char **code)
{
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(summary, "verdict");
    const char *verdict = cJSON_IsString(item) ? item->valuestring : "";
    double number = 0.0;
    *value = (double)NAN;
    if (c->verdict[0] != '\0') {
        *side = strcmp(verdict, c->verdict) == 0 ? 1 : -1;
        *code = "indeterminate";
        const bool open = *side < 0 && strcmp(verdict, verdict_name(VERDICT_INDETERMINATE)) == 0;
        return open || verdict[0] == '\0' ? ST_NOT_CONVERGED : ST_OK;
    }
    if (study_number(summary, c->value, &number) == STUDY_VALUE_NUMBER) {
        *value = isfinite(number) ? number - c->level : (double)NAN;
        *side = number < c->level ? -1 : 1;
        return ST_OK;
    }
    /* A march that ended early has no damping: what happened tells the side. */
    static const enum verdict growing[] = {VERDICT_DIVERGENCE, VERDICT_FLUTTER,
                                           VERDICT_STALL_FLUTTER};
    const bool damping = strncmp(c->value, "damping", strlen("damping")) == 0;
    for (size_t i = 0; damping && i < sizeof growing / sizeof growing[0]; i++) {
        if (strcmp(verdict, verdict_name(growing[i])) == 0) {
            *side = -1;
            return ST_OK;
        }
    }
    *code = "no_value";
    return ST_NOT_CONVERGED;
}
