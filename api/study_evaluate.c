#include "api/study_evaluate.h"

#include "api/json.h"
#include "api/result.h"

#include <cjson/cJSON.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void study_evaluator_change(struct study_evaluator *e)
{
    sim_destroy(e->structure);
    e->structure = NULL;
}

void study_evaluator_done(struct study_evaluator *e)
{
    study_evaluator_change(e);
}

void study_answer_done(struct study_answer *a)
{
    json_free(a->summary);
    a->summary = NULL;
}

/* The definition of the run: without series, or with the modal state at the start and the end. */
static void define_run(const struct study_state *from, bool end, struct case_def *def)
{
    def->output.n_channel = 0;
    if (end) {
        def->output.channel[0] = CHANNEL_MODAL_AMPLITUDE;
        def->output.channel[1] = CHANNEL_MODAL_VELOCITY;
        def->output.n_channel = 2;
        def->output.sample_every = case_def_steps(def);
    }
    if (from != NULL && from->modes > 0) {
        def->solver.start = START_AMPLITUDES;
        def->solver.n_amplitude = from->modes;
        memcpy(def->solver.amplitude, from->amplitude, sizeof from->amplitude);
        memcpy(def->solver.velocity, from->velocity, sizeof from->velocity);
    }
}

/* The last sample; a march that was stopped has none to go on from. */
static void read_end(const struct sim *sim, int modes, struct study_state *end)
{
    const struct sim_result *r = sim_result(sim);
    *end = (struct study_state){.modes = 0};
    if (r->stop != STOP_DURATION || r->n_sample < 2) {
        return;
    }
    end->modes = modes;
    for (int j = 0; j < modes; j++) {
        end->amplitude[j] = sim_column(sim, j)[r->n_sample - 1];
        end->velocity[j] = sim_column(sim, modes + j)[r->n_sample - 1];
    }
}

static void read_verdict(struct study_answer *out)
{
    const cJSON *verdict = cJSON_GetObjectItemCaseSensitive(out->summary, "verdict");
    (void)snprintf(out->verdict, sizeof out->verdict, "%s",
                   cJSON_IsString(verdict) ? verdict->valuestring : "");
}

static enum status summarise(const struct study_evaluator *e, double start,
                             const struct api_case *c, const struct sim *sim,
                             struct study_answer *out)
{
    const struct run_timing timing = {.cpu_s = 0.0};
    struct failure fail;
    char *text = result_document("summary", c, sim_result(sim), &timing);
    if (text == NULL) {
        return ST_NO_MEMORY;
    }
    const enum status st = json_parse(text, strlen(text), &out->summary, &fail);
    if (st == ST_OK) {
        read_verdict(out);
        if (e->memory != NULL && out->hash[0] != '\0') {
            e->memory->keep(e->memory->context, out->hash, out->verdict, text,
                            e->cpu_seconds() - start);
        }
    }
    free(text);
    return st;
}

/* The answer of a plain case that is known already. */
static bool recall(const struct study_evaluator *e, struct study_answer *out)
{
    struct failure fail;
    char *text = e->memory != NULL ? e->memory->find(e->memory->context, out->hash) : NULL;
    const bool known =
        text != NULL && json_parse(text, strlen(text), &out->summary, &fail) == ST_OK;
    free(text);
    if (known) {
        read_verdict(out);
    }
    return known;
}

static enum status run_case(struct study_evaluator *e, const struct api_case *c,
                            const struct study_state *from, struct study_state *end,
                            struct study_answer *out)
{
    struct failure fail = {.status = ST_OK};
    struct sim *sim = NULL;
    const double start = e->cpu_seconds();
    struct case_def *def = malloc(sizeof *def);
    if (def == NULL) {
        return ST_NO_MEMORY;
    }
    *def = *api_case_def(c);
    define_run(from, end != NULL, def);
    enum status st = sim_create_like(def, e->structure, &sim, &fail);
    if (st == ST_OK) {
        st = sim_run(sim, e->control, &fail);
    }
    if (st == ST_OK && end != NULL) {
        read_end(sim, def->solver.modes, end);
    }
    free(def);
    if (st == ST_OK) {
        st = summarise(e, start, c, sim, out);
    } else if (st != ST_CANCELLED && st != ST_NO_MEMORY) {
        out->status = st;
        (void)snprintf(out->code, sizeof out->code, "%s",
                       fail.code[0] != '\0' ? fail.code : status_name(st));
        st = ST_OK;
    }
    if (e->structure == NULL) {
        e->structure = sim;
    } else {
        sim_destroy(sim);
    }
    return st;
}

enum status study_evaluate(struct study_evaluator *e, const struct study_state *from,
                           struct study_state *end, struct study_answer *out)
{
    struct study_answer answer = {.status = ST_OK};
    struct api_case *c = NULL;
    struct failure_list *problems = calloc(1, sizeof *problems);
    if (problems == NULL) {
        return ST_NO_MEMORY;
    }
    if (end != NULL) {
        end->modes = 0;
    }
    const double start = e->cpu_seconds();
    enum status st = api_case_from_tree(e->study->library, e->study->tree, "", &c, problems);
    if (st == ST_INVALID) {
        answer.status = st;
        (void)snprintf(answer.code, sizeof answer.code, "%s", problems->item[0].code);
        st = ST_OK;
    } else if (st == ST_OK) {
        const bool plain = from == NULL || from->modes == 0;
        (void)snprintf(answer.hash, sizeof answer.hash, "%s", plain ? api_case_hash(c) : "");
        /* One that others go on from must be run: only its answer is known. */
        if (!plain || end != NULL || !recall(e, &answer)) {
            st = run_case(e, c, from, end, &answer);
        }
    }
    e->runs++;
    e->cpu_s += e->cpu_seconds() - start;
    api_case_destroy(c);
    free(problems);
    if (st == ST_OK) {
        *out = answer;
    } else {
        study_answer_done(&answer);
    }
    return st;
}
