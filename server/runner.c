#include "server/runner.h"

#include "api/case.h"
#include "api/channel.h"
#include "api/result.h"
#include "server/clock.h"

#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void set_failed(struct run_outcome *out, const char *code, const char *pointer,
                       const char *detail)
{
    out->end = RUN_FAILED;
    (void)snprintf(out->code, sizeof out->code, "%s", code);
    (void)snprintf(out->detail, sizeof out->detail, "%s%s%s", pointer,
                   pointer[0] != '\0' ? ": " : "", detail);
}

static void from_failure(struct run_outcome *out, enum status st, const struct failure *fail)
{
    if (st == ST_CANCELLED) {
        out->end = RUN_STOPPED;
        return;
    }
    set_failed(out, fail->code[0] != '\0' ? fail->code : status_name(st), fail->pointer,
               fail->detail[0] != '\0' ? fail->detail : status_text(st));
}

/* -- series ----------------------------------------------------------------------------- */

/* One chunk in presented units, its data in a block of exactly its size. */
static bool encode_chunk(const double *value, int n, double scale, void *buffer,
                         struct series_chunk *chunk, void **block)
{
    double scaled[SERIES_CHUNK];
    for (int i = 0; i < n; i++) {
        scaled[i] = value[i] * scale;
    }
    series_encode(scaled, n, buffer, chunk);
    *block = malloc(chunk->size);
    if (*block == NULL) {
        return false;
    }
    memcpy(*block, buffer, chunk->size);
    chunk->data = *block;
    return true;
}

static bool encode_column(struct run_outcome *out, int j, const double *value, double scale,
                          void *buffer)
{
    const int n = out->series.n;
    const int n_chunk = series_chunks(n);
    struct series_chunk *chunk = &out->chunk[(size_t)j * (size_t)n_chunk];
    void **block = &out->block[(size_t)j * (size_t)n_chunk];
    out->column[j].chunk = chunk;
    for (int i = 0; i < n_chunk; i++) {
        const int first = i * SERIES_CHUNK;
        const int count = n - first < SERIES_CHUNK ? n - first : SERIES_CHUNK;
        if (!encode_chunk(value + first, count, scale, buffer, &chunk[i], &block[i])) {
            return false;
        }
    }
    return true;
}

static bool encode_series(struct run_outcome *out, const struct case_def *def,
                          const struct sim *sim)
{
    const struct sim_result *r = sim_result(sim);
    const size_t n_column = (size_t)r->n_column;
    const size_t n_chunk = n_column * (size_t)series_chunks(r->n_sample);
    out->series = (struct store_series){
        .t0 = 0.0, .step = r->sample_step, .n = r->n_sample, .n_column = r->n_column};
    out->column = calloc(n_column + 1, sizeof *out->column);
    out->chunk = calloc(n_chunk + 1, sizeof *out->chunk);
    out->block = calloc(n_chunk + 1, sizeof *out->block);
    void *buffer = malloc(series_bound());
    bool ok = out->column != NULL && out->chunk != NULL && out->block != NULL && buffer != NULL;
    for (int j = 0; ok && j < r->n_column; j++) {
        double scale = 1.0;
        ok = channel_column(def, j, out->column[j].name, &scale);
        assert(ok); /* the core records exactly the columns the case names */
        ok = encode_column(out, j, sim_column(sim, j), scale, buffer);
    }
    free(buffer);
    out->series.column = out->column;
    out->result.series = &out->series;
    return ok;
}

/* -- one run ---------------------------------------------------------------------------- */

static bool make_documents(struct run_outcome *out, const struct api_case *c,
                           const struct sim_result *r, const struct run_timing *timing)
{
    const char *const *name = result_documents(api_case_def(c)->kind);
    for (int i = 0; name[i] != NULL; i++) {
        assert(i < RUN_DOCUMENTS_MAX);
        out->text[i] = result_document(name[i], c, r, timing);
        if (out->text[i] == NULL) {
            return false;
        }
        out->document[i] = (struct store_document){.name = name[i], .json = out->text[i]};
        out->result.n_document = i + 1;
    }
    return true;
}

static void collect(struct run_outcome *out, const struct api_case *c, const struct sim *sim,
                    double cpu_s)
{
    const struct case_def *def = api_case_def(c);
    const struct sim_result *r = sim_result(sim);
    const struct run_timing timing = {.cpu_s = cpu_s};
    if (case_kind_flows(def->kind)) {
        (void)snprintf(out->verdict, sizeof out->verdict, "%s", verdict_name(r->verdict));
    }
    out->result.verdict = out->verdict;
    out->result.cpu_s = cpu_s;
    out->result.document = out->document;
    bool ok = make_documents(out, c, r, &timing);
    if (ok && r->n_sample > 0 && r->n_column > 0) {
        ok = encode_series(out, def, sim);
    }
    if (!ok) {
        set_failed(out, status_name(ST_NO_MEMORY), "", status_text(ST_NO_MEMORY));
    }
}

static void compute(const struct api_case *c, const struct sim_control *control,
                    struct run_outcome *out)
{
    struct sim *sim = NULL;
    struct failure fail = {.status = ST_OK};
    const double start = clock_thread_cpu_s();
    enum status st = sim_create(api_case_def(c), &sim, &fail);
    if (st == ST_OK) {
        st = sim_run(sim, control, &fail);
    }
    const double cpu_s = clock_thread_cpu_s() - start;
    if (st == ST_OK) {
        collect(out, c, sim, cpu_s);
    } else {
        from_failure(out, st, &fail);
    }
    sim_destroy(sim);
}

static void compute_training(const struct api_case *c, const struct sim_control *control,
                             struct run_outcome *out)
{
    struct failure fail = {.status = ST_OK};
    const double start = clock_thread_cpu_s();
    const enum status st = training_compute(c, control, &out->training, &fail);
    const struct run_timing timing = {.cpu_s = clock_thread_cpu_s() - start};
    if (st != ST_OK) {
        from_failure(out, st, &fail);
        return;
    }
    out->entry = training_item(out->training);
    out->result.entry = &out->entry;
    out->result.verdict = out->verdict;
    out->result.cpu_s = timing.cpu_s;
    out->result.document = out->document;
    const char *const *name = result_documents(CASE_TRAINING);
    for (int i = 0; name[i] != NULL; i++) {
        out->text[i] = training_document(name[i], out->training, &timing);
        if (out->text[i] == NULL) {
            set_failed(out, status_name(ST_NO_MEMORY), "", status_text(ST_NO_MEMORY));
            return;
        }
        out->document[i] = (struct store_document){.name = name[i], .json = out->text[i]};
        out->result.n_document = i + 1;
    }
}

void runner_run(const struct library *lib, const char *case_json, const struct sim_control *control,
                struct run_outcome *out)
{
    *out = (struct run_outcome){.end = RUN_DONE};
    struct api_case *c = NULL;
    struct failure_list *problems = calloc(1, sizeof *problems);
    if (problems == NULL) {
        set_failed(out, status_name(ST_NO_MEMORY), "", status_text(ST_NO_MEMORY));
        return;
    }
    const enum status st = api_case_parse(lib, case_json, strlen(case_json), "", &c, problems);
    if (st == ST_OK) {
        (api_case_def(c)->kind == CASE_TRAINING ? compute_training : compute)(c, control, out);
    } else if (problems->count > 0) {
        /* An accepted case that no longer parses: the library or the rules have changed since. */
        from_failure(out, st, &problems->item[0]);
    } else {
        set_failed(out, status_name(st), "", status_text(st));
    }
    api_case_destroy(c);
    free(problems);
}

void run_outcome_done(struct run_outcome *out)
{
    for (int i = 0; i < out->result.n_document; i++) {
        free(out->text[i]);
    }
    const size_t n_chunk = (size_t)out->series.n_column * (size_t)series_chunks(out->series.n);
    for (size_t i = 0; out->block != NULL && i < n_chunk; i++) {
        free(out->block[i]);
    }
    free(out->block);
    free(out->chunk);
    free(out->column);
    training_out_destroy(out->training);
    *out = (struct run_outcome){.end = RUN_DONE};
}
