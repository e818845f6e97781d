/* GET /v1/studies/{id}/map: one value of every cell over the axes, in several forms. */
#include "api/hdf5_out.h"
#include "api/json.h"
#include "api/map_out.h"
#include "api/map_svg.h"
#include "api/reader.h"
#include "api/respond.h"
#include "api/study.h"

#include <cjson/cJSON.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { NAMES_MAX = 32 };

/* A map being filled, and how it fared. */
struct map_read {
    struct study_map *map;
    int seen, absent; /* cells with a summary; those without the value */
    bool composite;   /* the value is an object or an array */
    char names[160];  /* members of a summary, for the answer to a wrong value */
};

static void name_members(const char *text, struct map_read *read)
{
    const char *names[NAMES_MAX + 1] = {NULL};
    int n = 0;
    cJSON *summary = cJSON_Parse(text);
    const cJSON *c = NULL;
    cJSON_ArrayForEach(c, summary)
    {
        if (n < NAMES_MAX) {
            names[n++] = c->string;
        }
    }
    reader_join(names, sizeof read->names, read->names);
    cJSON_Delete(summary);
}

/* study_visit. */
static void enter(void *arg, const struct service_cell *c, cJSON **summary)
{
    struct map_read *read = arg;
    const enum study_value_kind kind = study_map_set(read->map, c->cell, c->state, *summary);
    if (*summary != NULL) {
        read->seen++;
        read->absent += kind == STUDY_VALUE_ABSENT;
        read->composite = read->composite || kind == STUDY_VALUE_NONE;
        if (read->seen == 1) {
            name_members(c->summary, read);
        }
    }
}

/* A parameter with a value that means nothing here. */
static void refuse_query(struct api_response *res, const char *parameter, const char *expected,
                         const char *got, const char *detail)
{
    struct failure_list *errors = calloc(1, sizeof *errors);
    if (errors != NULL) {
        failure_set(failure_add(errors), ST_INVALID, parameter, "unknown_value", expected, got,
                    "%s", detail);
    }
    problem_response(res, PROBLEM_BAD_QUERY, detail, errors, NULL);
    free(errors);
}

static void refuse_value(struct api_response *res, const struct map_read *read)
{
    char detail[200];
    (void)snprintf(detail, sizeof detail,
                   read->composite ? "\"%.80s\" is more than one value"
                                   : "the summary of a cell has no \"%.80s\"",
                   read->map->value_name);
    refuse_query(res, "?value", read->names, read->map->value_name, detail);
}

static void write_json(struct json_out *out, const struct job_record *job,
                       const struct service_study *progress, const struct study_map *m)
{
    json_object_begin(out);
    json_key_string(out, "study", job->id);
    json_key_string(out, "name", job->name);
    json_key_string(out, "state", job_state_name(job->state));
    json_key_integer(out, "pending", progress->n_cell - progress->done - progress->failed);
    study_map_members(out, m);
    json_object_end(out);
}

/* -- a boundary on top ------------------------------------------------------------------ */

/* The boundaries of another study as curves; owns it and its maps. */
struct overlay {
    struct study *study;
    struct study_map map[2]; /* upwards and downwards */
    struct map_curve curve[2];
    int n_curve;
};

static void overlay_done(struct overlay *o)
{
    for (int i = 0; i < 2; i++) {
        study_map_done(&o->map[i]);
    }
    study_destroy(o->study);
}

/* study_visit. */
static void enter_boundary(void *arg, const struct service_cell *c, cJSON **summary)
{
    struct overlay *o = arg;
    for (int i = 0; i < 2; i++) {
        (void)study_map_set(&o->map[i], c->cell, c->state, *summary);
    }
}

static void refuse_overlay(struct api_response *res, const char *id)
{
    static const char detail[] =
        "the drawing needs a study of type \"boundary\" over one of its axes, of the field on "
        "the other one";
    refuse_query(res, "?boundary", "the id of such a study", id, detail);
}

/* Curves in the axes of the drawing; false when the study is not about these. */
static bool place_curves(struct overlay *o, const struct map_plot *plot)
{
    const struct study_axis_view *over = &o->map[0].axis[0];
    const char *field = study_field_pointer(o->study);
    if (plot->y < 0 || field == NULL || o->map[0].n_axis != 1 || over->value == NULL) {
        return false;
    }
    const char *x = plot->map->axis[plot->x].pointer, *y = plot->map->axis[plot->y].pointer;
    const bool upright = strcmp(over->pointer, x) == 0 && strcmp(field, y) == 0;
    if (!upright && !(strcmp(over->pointer, y) == 0 && strcmp(field, x) == 0)) {
        return false;
    }
    for (int i = 0; i < 2; i++) {
        const struct study_map *m = &o->map[i];
        o->curve[i] = (struct map_curve){.name = i == 0 ? "boundary" : "boundary downwards",
                                         .n = m->n_cell,
                                         .x = upright ? over->value : m->value,
                                         .y = upright ? m->value : over->value};
    }
    o->n_curve = 2; /* downwards it is empty without hysteresis */
    return true;
}

/* Reads the study the query names; false when the answer is given. */
static bool overlay_read(const struct api_call *call, struct api_response *res, const char *id,
                         struct map_plot *plot, struct overlay *o)
{
    static const char *const names[] = {"boundary", "down.boundary"};
    struct api_call other = *call;
    struct job_record job;
    struct service_study progress;
    (void)snprintf(other.param, sizeof other.param, "%s", id);
    if (!study_find(&other, res, &job, &progress)) {
        return false;
    }
    o->study = study_of_job(&other, res, job.id);
    if (o->study == NULL) {
        return false;
    }
    bool room = true;
    for (int i = 0; i < 2; i++) {
        o->map[i].value_name = names[i];
        study_map_axes(o->study, &o->map[i]);
        room = room && study_map_init(&o->map[i]);
    }
    const enum service_status st =
        room ? study_each_cell(call->api->service, job.id, 2, names, enter_boundary, o)
             : SERVICE_ERROR;
    if (st != SERVICE_OK) {
        respond_service(res, st, job.id);
        return false;
    }
    if (!place_curves(o, plot)) {
        refuse_overlay(res, id);
        return false;
    }
    plot->n_curve = o->n_curve;
    plot->curve = o->curve;
    return true;
}

/* -- forms ------------------------------------------------------------------------------ */

/* The drawing in *out; false when the answer is given. */
static bool write_svg(const struct api_call *call, struct api_response *res, struct json_out *out,
                      const struct job_record *job, const struct study_map *m)
{
    const char *boundary = api_query_get(call->req, "boundary");
    struct map_plot plot;
    struct overlay overlay = {.study = NULL};
    char title[MAP_TITLE_SIZE], value[MAP_TITLE_SIZE];
    map_plot_defaults(m, &plot);
    if (job->name[0] != '\0') {
        map_title(m->value_name, value);
        (void)snprintf(title, sizeof title, "%.100s: %.90s", job->name, value);
        plot.title = title;
    }
    const bool ok = boundary == NULL || overlay_read(call, res, boundary, &plot, &overlay);
    if (ok) {
        map_svg(out, &plot);
    }
    overlay_done(&overlay);
    return ok;
}

static void fill_map(const struct api_call *call, struct api_response *res,
                     const struct job_record *job, const struct service_study *progress,
                     const struct study_map *m, enum map_format format)
{
    struct json_out out = {0};
    char *body = NULL;
    size_t size = 0;
    if (format == MAP_HDF5) {
        body = hdf5_out_map(m, &size);
    } else {
        if (format == MAP_JSON) {
            write_json(&out, job, progress, m);
        } else if (format != MAP_SVG) {
            (format == MAP_CSV ? map_out_csv : map_out_npy)(&out, m);
        } else if (!write_svg(call, res, &out, job, m)) {
            return;
        }
        body = json_out_take(&out, &size);
    }
    api_response_header(res, "Vary", "Accept");
    /* A map is final with its study, but not what is drawn on it. */
    const bool final = (job->state == JOB_DONE || job->state == JOB_CANCELLED) &&
                       api_query_get(call->req, "boundary") == NULL;
    respond_tagged(call, res, map_format_type(format),
                   final ? respond_immutable : respond_revalidate, body, size);
}

/* By name, else by what the client accepts. MAP_FORMATS when the answer is given. */
static enum map_format format_of(const struct api_call *call, struct api_response *res)
{
    const char *name = api_query_get(call->req, "format");
    const enum map_format format =
        name != NULL ? map_format_of(name) : map_format_accepted(call->req->accept);
    if (format == MAP_FORMATS) {
        refuse_query(res, "?format", "json, csv, npy, hdf5 or svg", name,
                     "there is no such form of a map");
    }
    return format;
}

void handle_map(const struct api_call *call, struct api_response *res)
{
    const char *value = api_query_get(call->req, "value");
    struct job_record job;
    struct service_study progress;
    if (!study_find(call, res, &job, &progress)) {
        return;
    }
    const enum map_format format = format_of(call, res);
    if (format == MAP_FORMATS) {
        return;
    }
    struct study *study = study_of_job(call, res, job.id);
    if (study == NULL) {
        return;
    }
    struct study_map m = {.value_name = value != NULL ? value : study_main_value(study)};
    study_map_axes(study, &m);
    if (!study_map_init(&m)) {
        problem_response(res, PROBLEM_INTERNAL, status_text(ST_NO_MEMORY), NULL, NULL);
        study_destroy(study);
        return;
    }
    struct map_read read = {.map = &m};
    const enum service_status st =
        study_each_cell(call->api->service, job.id, 1, &m.value_name, enter, &read);
    if (st != SERVICE_OK) {
        respond_service(res, st, job.id);
    } else if (read.composite || (read.seen > 0 && read.absent == read.seen)) {
        refuse_value(res, &read);
    } else {
        fill_map(call, res, &job, &progress, &m, format);
    }
    study_map_done(&m);
    study_destroy(study);
}
