#include "api/study_run.h"

#include "api/hash.h"
#include "api/result.h"
#include "api/study_seek.h"

#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct study_runner {
    struct study *study;
    double (*cpu_seconds)(void);
    const struct study_memory *memory;
    int cell;                      /* current one */
    struct api_case *c;            /* its case; NULL when it is not admissible */
    struct failure_list *problems; /* then why */
    struct sim *structure;         /* whose sections, beam and modes are taken over */
    int structure_cell;            /* cell it was made for */
};

struct study_runner *study_runner_create(struct study *s, double (*cpu_seconds)(void))
{
    struct study_runner *r = calloc(1, sizeof *r);
    if (r == NULL) {
        return NULL;
    }
    r->study = s;
    r->cpu_seconds = cpu_seconds;
    r->problems = calloc(1, sizeof *r->problems);
    if (r->problems == NULL) {
        free(r);
        return NULL;
    }
    return r;
}

void study_runner_destroy(struct study_runner *r)
{
    if (r != NULL) {
        sim_destroy(r->structure);
        api_case_destroy(r->c);
        free(r->problems);
        free(r);
    }
}

void study_runner_remember(struct study_runner *r, const struct study_memory *memory)
{
    r->memory = memory;
}

void study_cell_result_done(struct study_cell_result *r)
{
    free(r->summary);
    *r = (struct study_cell_result){.state = STUDY_CELL_PENDING};
}

/* Identity of a cell that is more than the run of its case: equal search, equal answer. */
static enum status identify_search(const struct study_runner *r, char hash[LIMIT_HASH])
{
    struct json_out text = {0};
    study_seek_identity(r->study, r->cell, &text);
    json_string(&text, hash);
    const enum status st = text.failed ? ST_NO_MEMORY : ST_OK;
    if (st == ST_OK) {
        hash_text(text.text, text.size, hash);
    }
    json_out_done(&text);
    return st;
}

/* The search of the current cell, whose values stand in the tree of the study. */
static enum status seek(struct study_runner *r, const struct sim_control *control,
                        struct study_cell_result *out)
{
    struct study_evaluator e = {
        .study = r->study, .control = control, .memory = r->memory, .cpu_seconds = r->cpu_seconds};
    char hash[LIMIT_HASH];
    (void)snprintf(hash, sizeof hash, "%s", api_case_hash(r->c));
    enum status st = identify_search(r, hash);
    if (st == ST_OK) {
        st = study_seek(&e, r->cell, out);
    }
    study_evaluator_done(&e);
    if (st == ST_OK) {
        (void)snprintf(out->hash, sizeof out->hash, "%s", hash);
    }
    return st;
}

enum status study_runner_begin(struct study_runner *r, int cell, char hash[LIMIT_HASH])
{
    api_case_destroy(r->c);
    r->c = NULL;
    r->cell = cell;
    r->problems->count = r->problems->total = 0;
    const enum status st = study_case(r->study, cell, &r->c, r->problems);
    if (st == ST_NO_MEMORY) {
        return st;
    }
    (void)snprintf(hash, LIMIT_HASH, "%s", st == ST_OK ? api_case_hash(r->c) : "");
    return st == ST_OK && study_seeks(r->study) ? identify_search(r, hash) : ST_OK;
}

static void set_failed(struct study_cell_result *out, enum status st, const struct failure *why)
{
    out->state = STUDY_CELL_FAILED;
    (void)snprintf(out->code, sizeof out->code, "%s",
                   why->code[0] != '\0' ? why->code : status_name(st));
    (void)snprintf(out->detail, sizeof out->detail, "%s%s%s", why->pointer,
                   why->pointer[0] != '\0' ? ": " : "",
                   why->detail[0] != '\0' ? why->detail : status_text(st));
}

/* Builds and runs the case on the structure at hand, or on one of its own, which is then at hand.
 */
static enum status compute(struct study_runner *r, const struct case_def *def,
                           const struct sim_control *control, struct sim **out,
                           struct failure *fail)
{
    const bool shared =
        r->structure != NULL && study_same_structure(r->study, r->cell, r->structure_cell);
    struct sim *sim = NULL;
    enum status st = sim_create_like(def, shared ? r->structure : NULL, &sim, fail);
    if (st == ST_OK) {
        st = sim_run(sim, control, fail);
    }
    *out = sim;
    return st;
}

/* The run is kept if later cells may stand on its structure, else freed. */
static void keep(struct study_runner *r, struct sim *sim)
{
    const bool shared =
        r->structure != NULL && study_same_structure(r->study, r->cell, r->structure_cell);
    if (shared || sim == NULL) {
        sim_destroy(sim);
        return;
    }
    sim_destroy(r->structure);
    r->structure = sim;
    r->structure_cell = r->cell;
}

static enum status summarise(const struct study_runner *r, const struct sim *sim,
                             struct study_cell_result *result)
{
    const struct run_timing timing = {.cpu_s = result->cpu_s};
    const struct sim_result *answer = sim_result(sim);
    result->summary = result_document("summary", r->c, answer, &timing);
    if (case_kind_flows(api_case_def(r->c)->kind)) {
        (void)snprintf(result->verdict, sizeof result->verdict, "%s",
                       verdict_name(answer->verdict));
    }
    return result->summary != NULL ? ST_OK : ST_NO_MEMORY;
}

enum status study_runner_compute(struct study_runner *r, const struct sim_control *control,
                                 struct study_cell_result *out)
{
    struct study_cell_result result = {.state = STUDY_CELL_DONE};
    if (r->c == NULL) {
        assert(r->problems->count > 0);
        set_failed(&result, ST_INVALID, &r->problems->item[0]);
        *out = result;
        return ST_OK;
    }
    if (study_seeks(r->study)) {
        return seek(r, control, out);
    }
    struct sim *sim = NULL;
    struct failure fail = {.status = ST_OK};
    struct case_def *def = malloc(sizeof *def);
    if (def == NULL) {
        return ST_NO_MEMORY;
    }
    *def = *api_case_def(r->c);
    def->output.n_channel = 0; /* a cell keeps its summary, no series */
    (void)snprintf(result.hash, sizeof result.hash, "%s", api_case_hash(r->c));
    const double start = r->cpu_seconds();
    enum status st = compute(r, def, control, &sim, &fail);
    result.cpu_s = r->cpu_seconds() - start;
    free(def);
    if (st == ST_OK) {
        st = summarise(r, sim, &result);
    } else if (st != ST_CANCELLED && st != ST_NO_MEMORY) {
        set_failed(&result, st, &fail);
        st = ST_OK;
    }
    keep(r, sim);
    if (st == ST_OK) {
        *out = result;
    } else {
        study_cell_result_done(&result);
    }
    return st;
}
