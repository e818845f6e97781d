/* GET /v1/studies/{id}/boundary, /optimum and /uncertainty: what the cells of a study found. */
#include "api/json.h"
#include "api/respond.h"
#include "api/study_fields.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Everything a document is made of; owns study and summaries. */
struct gathered {
    struct study *study;
    struct job_record job;
    struct service_study progress;
    cJSON **summary;      /* (n_cell), NULL where there is none */
    unsigned char *state; /* (n_cell) enum study_cell_state */
};

static void gathered_done(struct gathered *g)
{
    for (int i = 0; g->summary != NULL && i < study_cells(g->study); i++) {
        cJSON_Delete(g->summary[i]);
    }
    free(g->summary);
    free(g->state);
    study_destroy(g->study);
}

/* study_visit. */
static void keep(void *arg, const struct service_cell *c, cJSON **summary)
{
    struct gathered *g = arg;
    g->state[c->cell] = (unsigned char)c->state;
    g->summary[c->cell] = *summary;
    *summary = NULL;
}

/* False when the answer is given. */
static bool gather(const struct api_call *call, struct api_response *res, struct gathered *g)
{
    if (!study_find(call, res, &g->job, &g->progress)) {
        return false;
    }
    g->study = study_of_job(call, res, g->job.id);
    if (g->study == NULL) {
        return false;
    }
    const char *document = call->route->document;
    if (strcmp(study_type_names[g->study->type], document) != 0) {
        char detail[128];
        (void)snprintf(detail, sizeof detail, "a study of type \"%s\" has no %s",
                       study_type_names[g->study->type], document);
        problem_response(res, PROBLEM_NO_DOCUMENT, detail, NULL, NULL);
        return false;
    }
    const size_t cells = (size_t)study_cells(g->study);
    g->summary = calloc(cells, sizeof(cJSON *));
    g->state = calloc(cells, sizeof *g->state);
    const enum service_status st =
        g->summary != NULL && g->state != NULL
            ? study_each_cell(call->api->service, g->job.id, 0, NULL, keep, g)
            : SERVICE_ERROR;
    if (st != SERVICE_OK) {
        respond_service(res, st, g->job.id);
    }
    return st == SERVICE_OK;
}

/* -- shared members --------------------------------------------------------------------- */

static void begin_document(struct json_out *out, const struct gathered *g)
{
    const struct service_study *p = &g->progress;
    json_object_begin(out);
    json_key_string(out, "study", g->job.id);
    json_key_string(out, "name", g->job.name);
    json_key_string(out, "state", job_state_name(g->job.state));
    json_key_integer(out, "pending", p->n_cell - p->done - p->failed);
}

/* A part of a summary as it is; null where there is none. */
static void write_part(struct json_out *out, const char *key, const cJSON *item)
{
    json_key(out, key);
    if (item != NULL) {
        json_value(out, item);
    } else {
        json_null(out);
    }
}

static void copy_members(struct json_out *out, const cJSON *from, const char *const *keys)
{
    for (; *keys != NULL; keys++) {
        write_part(out, *keys, cJSON_GetObjectItemCaseSensitive(from, *keys));
    }
}

static int number_in(const cJSON *of, const char *key)
{
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(of, key);
    return cJSON_IsNumber(item) ? item->valueint : 0;
}

static const char *text_in(const cJSON *of, const char *key)
{
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(of, key);
    return cJSON_IsString(item) ? item->valuestring : "";
}

/* Runs of the case in all cells. */
static int runs_of(const struct gathered *g)
{
    int runs = 0;
    for (int i = 0; i < study_cells(g->study); i++) {
        runs += number_in(g->summary[i], "runs");
    }
    return runs;
}

/* -- boundary --------------------------------------------------------------------------- */

static const char *const boundary_keys[] = {"boundary",    "outcome", "lower",       "upper",
                                            "holds_below", "more",    "evaluations", NULL};

static void write_row(struct json_out *out, const struct gathered *g, int cell)
{
    const cJSON *summary = g->summary[cell];
    const cJSON *down = cJSON_GetObjectItemCaseSensitive(summary, "down");
    json_object_begin(out);
    study_point(out, g->study, cell);
    json_key_string(out, "state", study_cell_state_name((enum study_cell_state)g->state[cell]));
    copy_members(out, summary, boundary_keys);
    if (down != NULL) {
        json_key(out, "down");
        json_object_begin(out);
        copy_members(out, down, boundary_keys);
        json_object_end(out);
    }
    json_object_end(out);
}

static void write_boundary(struct json_out *out, const struct gathered *g)
{
    json_key_string(out, "field", g->study->search.field.pointer);
    json_key_number(out, "tolerance", g->study->search.field.def.tolerance);
    json_key_integer(out, "runs", runs_of(g));
    json_key(out, "rows");
    json_array_begin(out);
    for (int i = 0; i < study_cells(g->study); i++) {
        write_row(out, g, i);
    }
    json_array_end(out);
}

/* -- optimum ---------------------------------------------------------------------------- */

/* The better of two answers to searches: feasible, of better objective; else of less violation. */
static bool is_better(const cJSON *a, const cJSON *b, bool large)
{
    const cJSON *x = cJSON_GetObjectItemCaseSensitive(a, "best");
    const cJSON *y = cJSON_GetObjectItemCaseSensitive(b, "best");
    if (!cJSON_IsObject(x) || !cJSON_IsObject(y)) {
        return cJSON_IsObject(x) && !cJSON_IsObject(y);
    }
    const bool fits = cJSON_IsTrue(cJSON_GetObjectItemCaseSensitive(x, "feasible"));
    if (fits != (bool)cJSON_IsTrue(cJSON_GetObjectItemCaseSensitive(y, "feasible"))) {
        return fits;
    }
    const char *key = fits ? "objective" : "violation";
    const double p = cJSON_GetNumberValue(cJSON_GetObjectItemCaseSensitive(x, key));
    const double q = cJSON_GetNumberValue(cJSON_GetObjectItemCaseSensitive(y, key));
    return fits && large ? p > q : p < q;
}

static void write_start(struct json_out *out, const struct gathered *g, int cell)
{
    static const char *const keys[] = {"outcome", "objective", "evaluations", "failed_evaluations",
                                       "runs",    "best",      "history",     NULL};
    json_object_begin(out);
    study_point(out, g->study, cell);
    json_key_string(out, "state", study_cell_state_name((enum study_cell_state)g->state[cell]));
    copy_members(out, g->summary[cell], keys);
    json_object_end(out);
}

static void write_optimum(struct json_out *out, const struct gathered *g)
{
    const struct study_search *f = &g->study->search;
    const bool large = f->maximise[0] != '\0';
    const cJSON *best = NULL;
    for (int i = 0; i < study_cells(g->study); i++) {
        if (g->summary[i] != NULL && (best == NULL || is_better(g->summary[i], best, large))) {
            best = g->summary[i];
        }
    }
    json_key_string(out, large ? "maximise" : "minimise", large ? f->maximise : f->minimise);
    json_key_string(out, "outcome", best != NULL ? text_in(best, "outcome") : NULL);
    write_part(out, "best", cJSON_GetObjectItemCaseSensitive(best, "best"));
    json_key_integer(out, "runs", runs_of(g));
    json_key(out, "starts");
    json_array_begin(out);
    for (int i = 0; i < study_cells(g->study); i++) {
        write_start(out, g, i);
    }
    json_array_end(out);
}

/* -- uncertainty ------------------------------------------------------------------------ */

struct sample_counts {
    int n, below, above, without; /* with a place in the order; of them beyond the range; without */
};

/* A boundary beyond the range stands as an infinity: the order is all that counts. */
static bool sample_value(const struct gathered *g, int cell, double *out,
                         struct sample_counts *counts)
{
    const struct study_search *f = &g->study->search;
    const cJSON *summary = g->summary[cell];
    if (summary == NULL) {
        return false;
    }
    if (study_number(summary, f->result, out) == STUDY_VALUE_NUMBER) {
        counts->above += isinf(*out);
        return true;
    }
    const cJSON *holds = cJSON_GetObjectItemCaseSensitive(summary, "holds_below");
    if (study_seeks_boundary(g->study) && cJSON_IsBool(holds) &&
        strcmp(text_in(summary, "outcome"), boundary_outcome_name(BOUNDARY_NOT_BRACKETED)) == 0) {
        const bool above = cJSON_IsTrue(holds);
        *out = above ? (double)INFINITY : -(double)INFINITY;
        *(above ? &counts->above : &counts->below) += 1;
        return true;
    }
    counts->without++;
    return false;
}

static int by_size(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Of the finite values; null without two of them. */
static void write_moments(struct json_out *out, int n, const double *x)
{
    double sum = 0.0, square = 0.0;
    int m = 0;
    for (int i = 0; i < n; i++) {
        if (isfinite(x[i])) {
            sum += x[i];
            m++;
        }
    }
    const double mean = m > 0 ? sum / m : (double)NAN;
    for (int i = 0; i < n; i++) {
        square += isfinite(x[i]) ? num_sq(x[i] - mean) : 0.0;
    }
    json_key_number(out, "mean", mean);
    json_key_number(out, "standard_deviation", m > 1 ? sqrt(square / (m - 1)) : (double)NAN);
}

static void write_quantiles(struct json_out *out, const struct study_search *f, int n,
                            const double *sorted)
{
    json_key(out, "quantiles");
    json_array_begin(out);
    for (int i = 0; i < f->n_quantile && n > 0; i++) {
        struct sampling_quantile q;
        sampling_quantile_of(n, sorted, f->quantile[i], f->confidence, &q);
        json_object_begin(out);
        json_key_number(out, "p", q.p);
        json_key_number(out, "value", q.value);
        json_key_number(out, "lower", q.lower);
        json_key_number(out, "upper", q.upper);
        json_object_end(out);
    }
    json_array_end(out);
}

static void write_uncertainty(struct json_out *out, const struct gathered *g)
{
    const struct study_search *f = &g->study->search;
    struct sample_counts counts = {.n = 0};
    double *x = malloc((size_t)study_cells(g->study) * sizeof *x);
    if (x == NULL) {
        out->failed = true;
        return;
    }
    for (int i = 0; i < study_cells(g->study); i++) {
        counts.n += sample_value(g, i, &x[counts.n], &counts);
    }
    qsort(x, (size_t)counts.n, sizeof *x, by_size);
    json_key_string(out, "result", f->result);
    json_key_integer(out, "samples", study_cells(g->study));
    json_key_integer(out, "counted", counts.n);
    json_key_integer(out, "below_range", counts.below);
    json_key_integer(out, "above_range", counts.above);
    json_key_integer(out, "without_value", counts.without + g->progress.failed);
    json_key_number(out, "confidence", f->confidence);
    write_moments(out, counts.n, x);
    write_quantiles(out, f, counts.n, x);
    json_key_integer(out, "runs", study_seeks(g->study) ? runs_of(g) : g->progress.done);
    free(x);
}

void handle_search(const struct api_call *call, struct api_response *res)
{
    static void (*const write[])(struct json_out *, const struct gathered *) = {
        [STUDY_BOUNDARY] = write_boundary,
        [STUDY_OPTIMUM] = write_optimum,
        [STUDY_UNCERTAINTY] = write_uncertainty};
    struct gathered g = {.study = NULL};
    if (gather(call, res, &g)) {
        struct json_out out = {0};
        begin_document(&out, &g);
        write[g.study->type](&out, &g);
        json_object_end(&out);
        respond_json(res, 200, &out);
    }
    gathered_done(&g);
}
