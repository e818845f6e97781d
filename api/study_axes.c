#include "api/study_axes.h"

#include "api/json.h"

#include <assert.h>
#include <cjson/cJSON.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* -- pointers --------------------------------------------------------------------------- */

/* One part of a JSON pointer (RFC 6901), decoded; the rest begins at the next '/' or the end. NULL
 * when it does not fit. */
static const char *take_part(const char *at, size_t size, char *part)
{
    size_t n = 0;
    for (; *at != '\0' && *at != '/'; at++) {
        if (n + 1 >= size) {
            return NULL;
        }
        const bool escaped = at[0] == '~' && (at[1] == '0' || at[1] == '1');
        part[n++] = !escaped ? *at : at[1] == '0' ? '~' : '/';
        at += escaped;
    }
    part[n] = '\0';
    return at;
}

static cJSON *child(cJSON *of, const char *part)
{
    if (!cJSON_IsArray(of)) {
        return cJSON_GetObjectItemCaseSensitive(of, part);
    }
    const size_t digits = strspn(part, "0123456789");
    const bool index = digits > 0 && digits < 7 && part[digits] == '\0';
    return index ? cJSON_GetArrayItem(of, (int)strtol(part, NULL, 10)) : NULL;
}

/* Keys of an object, or how many entries an array has, for the answer to a wrong pointer. */
static void describe_children(const cJSON *of, size_t size, char *out)
{
    enum { KEYS_MAX = 32 };
    const char *names[KEYS_MAX + 1] = {NULL};
    int n = 0;
    if (cJSON_IsArray(of)) {
        (void)snprintf(out, size, "an index from 0 to %d", cJSON_GetArraySize(of) - 1);
        return;
    }
    for (const cJSON *c = of->child; c != NULL && n < KEYS_MAX; c = c->next) {
        names[n++] = c->string;
    }
    reader_join(names, size, out);
}

struct cJSON *study_resolve(struct reader *r, struct cJSON *tree, const char *pointer)
{
    char part[64], expected[128];
    cJSON *at = tree;
    if (pointer[0] != '/') {
        reader_problem(r, "not_a_pointer", "a JSON pointer into the case, \"/flow/speed_m_s\"",
                       NULL, "\"%.80s\" does not begin with \"/\"", pointer);
        return NULL;
    }
    for (const char *p = pointer; *p == '/';) {
        const char *rest = take_part(p + 1, sizeof part, part);
        cJSON *next = rest != NULL ? child(at, part) : NULL;
        if (next == NULL) {
            describe_children(at, sizeof expected, expected);
            reader_problem(r, "unknown_pointer", expected, NULL,
                           "the case, with its defaults, has no \"%.140s\": \"%.60s\" is not there",
                           pointer, part);
            return NULL;
        }
        at = next;
        p = rest;
    }
    return at;
}

/* -- checks of one axis ----------------------------------------------------------------- */

bool study_is_structural(const char *pointer)
{
    static const char *const loose[] = {"/flow/",   "/aerodynamics/", "/loads/",
                                        "/output/", "/stability/",    "/solver/"};
    if (strcmp(pointer, "/solver/modes") == 0) {
        return true;
    }
    for (size_t i = 0; i < sizeof loose / sizeof loose[0]; i++) {
        if (strncmp(pointer, loose[i], strlen(loose[i])) == 0) {
            return false;
        }
    }
    return true;
}

static enum status check_leaf(struct reader *r, const struct study *s, struct study_axis *a)
{
    const size_t mark = reader_enter_key(r, "pointer");
    a->leaf = study_resolve(r, s->tree, a->pointer);
    a->structural = study_is_structural(a->pointer);
    const bool texts = a->label != NULL;
    enum status st = ST_OK;
    if (cJSON_IsString(a->leaf)) {
        a->own_label = strdup(a->leaf->valuestring);
        st = a->own_label != NULL ? ST_OK : ST_NO_MEMORY;
    }
    a->own_value = cJSON_IsNumber(a->leaf) ? a->leaf->valuedouble : (double)NAN;
    if (a->leaf != NULL && !(texts ? cJSON_IsString(a->leaf) : cJSON_IsNumber(a->leaf))) {
        const char *what = texts ? "the pointer of a text" : "the pointer of a number";
        reader_problem(r, "wrong_type", what, a->leaf, "the values do not have the type of \"%s\"",
                       a->pointer);
    }
    for (const struct study_axis *b = s->axis; b < a; b++) {
        if (strcmp(a->pointer, b->pointer) == 0) {
            reader_problem(r, "duplicate_value", "distinct pointers", NULL,
                           "\"%s\" is varied twice", a->pointer);
        }
    }
    reader_leave(r, mark);
    return st;
}

/* Range to values. A range of one value is a contradiction unless both ends are that value. */
static enum status fill_range(struct reader *r, struct study_axis *a)
{
    const bool begun = isfinite(a->from) || isfinite(a->to) || a->count > 0;
    if (a->listed) {
        if (begun) {
            reader_problem(r, "contradictory", "\"values\", or \"from\", \"to\" and \"count\"",
                           NULL, "a list and a range are given");
        }
        return ST_OK;
    }
    if (!isfinite(a->from) || !isfinite(a->to) || a->count < 1) {
        reader_problem(r, "required", "\"values\", or \"from\", \"to\" and \"count\"", NULL,
                       begun ? "the range is not complete" : "there are no values");
        return ST_OK;
    }
    if ((a->count == 1) != (a->from == a->to)) { /* given numbers, not computed ones */
        char got[96];
        (void)snprintf(got, sizeof got, "from %.9g to %.9g in %d", a->from, a->to, a->count);
        failure_set(failure_add(r->problems), ST_INVALID, r->pointer, "contradictory",
                    "two ends and a count of at least 2, or one value", got,
                    "a range of %d values from %.9g to %.9g contradicts itself", a->count, a->from,
                    a->to);
        return ST_OK;
    }
    a->value = calloc((size_t)a->count, sizeof *a->value);
    if (a->value == NULL) {
        return ST_NO_MEMORY;
    }
    a->n = a->count;
    for (int i = 0; i < a->n; i++) { /* in this order -90 to 90 in 37 has -35, not its neighbour */
        a->value[i] = i + 1 == a->n ? a->to : a->from + (a->to - a->from) * i / (a->n - 1);
    }
    return ST_OK;
}

/* -- dimensions ------------------------------------------------------------------------- */

/* The axis its zip group began with; itself when it is crossed or begins one. */
static const struct study_axis *leader(const struct study *s, const struct study_axis *a)
{
    for (const struct study_axis *b = s->axis; a->zip[0] != '\0' && b < a; b++) {
        if (strcmp(a->zip, b->zip) == 0) {
            return b;
        }
    }
    return a;
}

static void check_dimensions(struct study *s, struct reader *r)
{
    double cells = 1.0;
    s->n_dimension = 0;
    for (int i = 0; i < s->n_axis; i++) {
        struct study_axis *a = &s->axis[i];
        const struct study_axis *first = leader(s, a);
        if (first == a) {
            a->dimension = s->n_dimension;
            s->shape[s->n_dimension++] = a->n;
            cells *= a->n;
        } else if (a->n == first->n) {
            a->dimension = first->dimension;
        } else {
            const size_t mark = reader_enter_index(r, i);
            reader_problem(r, "wrong_length", "zipped axes of one length", NULL,
                           "%d values are zipped with %d of \"%s\"", a->n, first->n,
                           first->pointer);
            reader_leave(r, mark);
        }
    }
    if (cells > STUDY_CELLS_MAX) {
        reader_problem(r, "too_many_cells", "at most 100000 cells", NULL, "the axes cross to %.15g",
                       cells);
    }
    s->n_cell = cells > STUDY_CELLS_MAX ? 0 : (int)cells;
}

const char *study_axes_key(const struct study *s)
{
    static const char *const key[] = {[STUDY_GRID] = "vary",
                                      [STUDY_BOUNDARY] = "over",
                                      [STUDY_OPTIMUM] = "variables",
                                      [STUDY_UNCERTAINTY] = "tolerances"};
    return key[s->type];
}

enum status study_axes_check(struct study *s, struct reader *r)
{
    const size_t mark = reader_enter_key(r, study_axes_key(s));
    enum status st = ST_OK;
    for (int i = 0; st == ST_OK && i < s->n_axis; i++) {
        struct study_axis *a = &s->axis[i];
        const size_t entry = reader_enter_index(r, i);
        st = fill_range(r, a);
        if (st == ST_OK && a->pointer[0] != '\0' && (a->value != NULL || a->label != NULL)) {
            st = check_leaf(r, s, a);
        }
        reader_leave(r, entry);
    }
    if (st == ST_OK && r->problems->total == 0) {
        check_dimensions(s, r);
    }
    reader_leave(r, mark);
    return st;
}

/* -- values of a cell ------------------------------------------------------------------- */

bool study_axis_set(const struct study_axis *a, int k)
{
    if (a->value != NULL) {
        (void)cJSON_SetNumberHelper(a->leaf, a->value[k]);
        return true;
    }
    return cJSON_SetValuestring(a->leaf, a->label[k]) != NULL;
}

/* Position of a cell along each dimension. */
static void position_of(const struct study *s, int cell, int at[STUDY_AXES_MAX])
{
    for (int d = s->n_dimension - 1; d >= 0; d--) {
        at[d] = cell % s->shape[d];
        cell /= s->shape[d];
    }
}

bool study_axes_set(struct study *s, int cell)
{
    int at[STUDY_AXES_MAX];
    bool ok = true;
    position_of(s, cell, at);
    for (int i = 0; i < s->n_axis; i++) {
        ok = study_axis_set(&s->axis[i], at[s->axis[i].dimension]) && ok;
    }
    return ok;
}

static bool dimension_is_structural(const struct study *s, int dimension)
{
    bool structural = false;
    for (int i = 0; i < s->n_axis; i++) {
        structural = structural || (s->axis[i].dimension == dimension && s->axis[i].structural);
    }
    return structural;
}

bool study_same_structure(const struct study *s, int a, int b)
{
    int at[STUDY_AXES_MAX], other[STUDY_AXES_MAX];
    bool same = true;
    position_of(s, a, at);
    position_of(s, b, other);
    for (int d = 0; d < s->n_dimension; d++) {
        same = same && (at[d] == other[d] || !dimension_is_structural(s, d));
    }
    return same;
}

/* -- order ------------------------------------------------------------------------------ */

int study_cell_at(const struct study *s, int place)
{
    int order[STUDY_AXES_MAX], at[STUDY_AXES_MAX] = {0};
    int n = 0;
    assert(place >= 0);
    assert(place < s->n_cell);
    for (int pass = 0; pass < 2; pass++) { /* structural dimensions are the slow ones */
        for (int d = 0; d < s->n_dimension; d++) {
            if (dimension_is_structural(s, d) == (pass == 0)) {
                order[n++] = d;
            }
        }
    }
    for (int i = n - 1; i >= 0; i--) {
        at[order[i]] = place % s->shape[order[i]];
        place /= s->shape[order[i]];
    }
    int cell = 0;
    for (int d = 0; d < s->n_dimension; d++) {
        cell = cell * s->shape[d] + at[d];
    }
    return cell;
}

struct study_plan study_plan_of(const struct study *s)
{
    enum { UNIT_MAX = 1024, SHARES = 8 };
    static const double unit_s = 1.0;
    struct study_plan plan = {.n_cell = s->n_cell, .run = 1};
    for (int d = 0; d < s->n_dimension; d++) {
        plan.run *= dimension_is_structural(s, d) ? 1 : s->shape[d];
    }
    /* A second of work, but so little that several workers share a small study. */
    const double timely = fmin(unit_s / s->cost_s, UNIT_MAX);
    const double fair = (double)s->n_cell / SHARES;
    const int most = (int)fmax(fmin(timely, fair), 1.0);
    if (plan.run < most) {
        plan.run = s->n_cell; /* structures are cheap beside that: runs need no unit of their own */
    }
    const int pieces = (plan.run + most - 1) / most;
    plan.unit = (plan.run + pieces - 1) / pieces;
    return plan;
}
