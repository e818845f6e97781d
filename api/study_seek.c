#include "api/study_seek.h"

#include "api/json.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void study_seek_identity(const struct study *s, int cell, struct json_out *out)
{
    json_string(out, study_type_names[s->type]);
    field_write(out, study_fields, STUDY_IN_SEARCH, s);
    json_integer(out, s->type == STUDY_OPTIMUM ? cell : 0);
}

/* -- boundary --------------------------------------------------------------------------- */

struct seeking {
    struct study_evaluator *e;
    struct study_boundary *out;
    struct study_state *end; /* of each sample (BOUNDARY_SAMPLES_MAX), NULL unless it is a sweep */
};

/* boundary_evaluate. */
static enum status evaluate_at(void *context, double x, enum boundary_sweep sweep, int before,
                               struct boundary_sample *sample)
{
    struct seeking *k = context;
    const struct study_search *f = &k->e->study->search;
    const int i = k->out->result.n;
    struct study_answer answer = {.status = ST_OK};
    const char *code = "";
    (void)sweep;
    if (f->field.structural) {
        study_evaluator_change(k->e);
    }
    (void)cJSON_SetNumberHelper(f->field.leaf, x);
    enum status st = study_evaluate(k->e, before >= 0 && k->end != NULL ? &k->end[before] : NULL,
                                    k->end != NULL ? &k->end[i] : NULL, &answer);
    if (st != ST_OK) {
        return st;
    }
    sample->status = answer.status;
    if (answer.status == ST_OK) {
        sample->status =
            study_judge(&f->criterion, answer.summary, &sample->side, &sample->value, &code);
    }
    (void)snprintf(k->out->sample[i].hash, sizeof k->out->sample[i].hash, "%s", answer.hash);
    (void)snprintf(k->out->sample[i].verdict, sizeof k->out->sample[i].verdict, "%s",
                   answer.verdict);
    (void)snprintf(k->out->sample[i].code, sizeof k->out->sample[i].code, "%s",
                   answer.status != ST_OK    ? answer.code
                   : sample->status != ST_OK ? code
                                             : "");
    study_answer_done(&answer);
    return ST_OK;
}

enum status study_seek_boundary(struct study_evaluator *e, enum boundary_sweep sweep,
                                struct study_boundary *out)
{
    const struct study_field *f = &e->study->search.field;
    struct seeking k = {.e = e, .out = out};
    if (sweep != BOUNDARY_ALONE) {
        k.end = calloc(BOUNDARY_SAMPLES_MAX, sizeof *k.end);
        if (k.end == NULL) {
            return ST_NO_MEMORY;
        }
    }
    out->sweep = sweep;
    const enum status st = boundary_search(&f->def, sweep, evaluate_at, &k, &out->result);
    (void)cJSON_SetNumberHelper(f->leaf, f->own_value);
    if (f->structural) {
        study_evaluator_change(e);
    }
    free(k.end);
    return st;
}

double study_boundary_value(const struct study *s, const struct study_boundary *b)
{
    const struct boundary_result *r = &b->result;
    if (r->outcome == BOUNDARY_NOT_BRACKETED) {
        return r->side_below > 0 ? s->search.field.def.to : s->search.field.def.from;
    }
    return r->outcome == BOUNDARY_FOUND ? r->x : (double)NAN;
}

static void write_side(struct json_out *out, const char *key, int side)
{
    json_key(out, key);
    if (side == 0) {
        json_null(out);
    } else {
        json_boolean(out, side > 0);
    }
}

static void write_sample(struct json_out *out, const struct study_boundary *b, int i)
{
    const struct boundary_sample *s = &b->result.sample[i];
    json_object_begin(out);
    json_key_number(out, "x", s->x);
    write_side(out, "holds", s->side);
    json_key_number(out, "value", s->value);
    json_key_string(out, "verdict", b->sample[i].verdict[0] != '\0' ? b->sample[i].verdict : NULL);
    json_key_string(out, "error", b->sample[i].code[0] != '\0' ? b->sample[i].code : NULL);
    json_key_string(out, "content_hash", b->sample[i].hash[0] != '\0' ? b->sample[i].hash : NULL);
    json_object_end(out);
}

void study_boundary_members(struct json_out *out, const struct study_boundary *b)
{
    const struct boundary_result *r = &b->result;
    json_key_number(out, "boundary", r->x);
    json_key_string(out, "outcome", boundary_outcome_name(r->outcome));
    json_key_number(out, "lower", r->lower);
    json_key_number(out, "upper", r->upper);
    write_side(out, "holds_below", r->side_below);
    json_key(out, "more");
    json_boolean(out, r->changes > 1);
    json_key_integer(out, "evaluations", r->n);
    json_key_integer(out, "failed_evaluations", r->n_failed);
    json_key(out, "samples");
    json_array_begin(out);
    for (int i = 0; i < r->n; i++) {
        write_sample(out, b, i);
    }
    json_array_end(out);
}

static enum status seek_sweeps(struct study_evaluator *e, struct study_boundary *up,
                               struct study_boundary *down)
{
    const bool sweeps = e->study->search.hysteresis;
    enum status st = study_seek_boundary(e, sweeps ? BOUNDARY_UP : BOUNDARY_ALONE, up);
    if (st == ST_OK && sweeps) {
        st = study_seek_boundary(e, BOUNDARY_DOWN, down);
    }
    return st;
}

/* The document of a cell whose answer is a boundary. */
static enum status answer_boundary(struct study_evaluator *e, struct study_cell_result *out)
{
    struct study_boundary *b = calloc(2, sizeof *b);
    if (b == NULL) {
        return ST_NO_MEMORY;
    }
    enum status st = seek_sweeps(e, &b[0], &b[1]);
    if (st == ST_OK) {
        struct json_out text = {0};
        json_object_begin(&text);
        json_key_string(&text, "kind", "boundary");
        json_key_string(&text, "field", e->study->search.field.pointer);
        study_boundary_members(&text, &b[0]);
        if (e->study->search.hysteresis) {
            json_key(&text, "down");
            json_object_begin(&text);
            study_boundary_members(&text, &b[1]);
            json_object_end(&text);
            json_key_number(&text, "hysteresis_width", b[0].result.x - b[1].result.x);
        }
        json_key_integer(&text, "runs", e->runs);
        json_object_end(&text);
        out->summary = json_out_take(&text, NULL);
        (void)snprintf(out->verdict, sizeof out->verdict, "%s",
                       boundary_outcome_name(b[0].result.outcome));
        st = out->summary != NULL ? ST_OK : ST_NO_MEMORY;
    }
    free(b);
    return st;
}

enum status study_seek(struct study_evaluator *e, int cell, struct study_cell_result *out)
{
    struct study_cell_result result = {.state = STUDY_CELL_DONE};
    e->runs = 0;
    e->cpu_s = 0.0;
    const enum status st = e->study->type == STUDY_OPTIMUM ? study_seek_optimum(e, cell, &result)
                                                           : answer_boundary(e, &result);
    result.cpu_s = e->cpu_s;
    if (st == ST_OK) {
        *out = result;
    } else {
        study_cell_result_done(&result);
    }
    return st;
}
